// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/end_pairing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/contour/centreline/junction/arc_through.h"
#include "core/contour/centreline/junction/end_rows.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kTangentRadii = 8.0;    // [half stroke widths] over which the direction of an end is taken,
constexpr double kLeastTangentPx = 8.0;  // and of thin strokes
constexpr double kCurvedTangent = 0.5;   // of that: over less, a parabola follows the noise
constexpr double kForkCos = 0.64;        // 50 degrees: two ends side by side
constexpr double kFatRadius = 1.15;      // of the usual half-width of the edge,
constexpr double kFatSlackPx = 0.25;     // and [px] what the grid of pixels changes of a half-width
constexpr double kFatReach = 6.0;        // [half-widths] that two strokes share at most: they part at 20 degrees
// A stroke that goes on aside has to turn there and back. Of the miss so much is noise [px].
constexpr double kAsideTurns = 2.0, kMissNoisePx = 1.0;
constexpr double kMissPerWidthDeg = 20.0;    // what a stroke that goes on a width aside costs, against a bend
constexpr double kWidthPerOctaveDeg = 40.0;  // and one whose width changes to the double
// More than a pair that may go on can cost: at right angles to both courses, one [octaves] as much wider.
constexpr double kWorstAsideDeg = 90.0, kWorstOctaves = 4.0;
// A strip that turns by an angle and, to go aside, leaves its course by another has the bending energy of the sum of
// the square of the one and twelve times that of the other.
constexpr double kAsideEnergy = 12.0;
constexpr double kCrossingDeg = 20.0;  // what it costs that strokes side by side change sides: less bend is no reason,
constexpr double kNoCrossingDeg = 90.0;                    // and in ink that is too wide for it none is
constexpr double kArcWidths = 10.0;                        // [stroke widths] of each end that an arc is laid through,
constexpr double kLeastArcShare = 0.5;                     // and what must be seen of that
constexpr double kArcMissPx = 0.4, kArcMissWidths = 0.05;  // left by a true arc: of the pixels, of the width
constexpr double kOtherArc = 2.5;                          // so many times more is left where the other end goes on
constexpr int kMostEnds = 10;  // of a junction that is looked at as a whole: 9496 ways to pair them

struct PairCost {
  int a = 0, b = 0;
  double gain = 0.0;  // [deg^2] against leaving both alone
};

// The pairs of the greatest sum of gains, tried one end after the other.
class BestPairs {
 public:
  /// @param rows absent: any pairs may cross.
  BestPairs(int ends, const std::vector<PairCost>& costs, std::optional<EndRows> rows,
            std::optional<double> narrowestPx)
      : gain_(ends, std::vector<std::optional<double>>(ends)),
        used_(ends),
        rows_(std::move(rows)),
        narrowestPx_(narrowestPx) {
    for (const PairCost& c : costs) gain_[c.a][c.b] = c.gain;
  }
  std::vector<std::pair<int, int>> find() {
    tryFrom(0, 0.0);
    return best_;
  }

 private:
  void tryFrom(int a, double sum) {
    const int n = static_cast<int>(used_.size());
    while (a < n && used_[a]) ++a;
    if (a == n) {
      if (sum <= bestSum_) return;
      bestSum_ = sum;
      best_ = now_;
      return;
    }
    for (int b = a + 1; b < n; ++b) {
      if (used_[b] || !gain_[a][b] || !(*gain_[a][b] > 0.0)) continue;
      used_[b] = true;
      const double gain = *gain_[a][b] - crossingCost({a, b});
      now_.emplace_back(a, b);
      tryFrom(a + 1, sum + gain);
      now_.pop_back();
      used_[b] = false;
    }
    tryFrom(a + 1, sum);
  }

  // [deg^2] Of a pair with those that are chosen.
  double crossingCost(const std::pair<int, int>& pair) const {
    if (!rows_) return 0.0;
    double sum = 0.0;
    for (const std::pair<int, int>& other : now_) {
      if (!rows_->changeSides(pair, other)) continue;
      const bool mayCross = !narrowestPx_ || rows_->mayCross(pair, other, *narrowestPx_);
      const double deg = mayCross ? kCrossingDeg : kNoCrossingDeg;
      sum += deg * deg;
    }
    return sum;
  }

  std::vector<std::vector<std::optional<double>>> gain_;  // [a][b], a < b; absent: no stroke goes that way
  std::vector<bool> used_;
  std::optional<EndRows> rows_;
  std::optional<double> narrowestPx_;
  std::vector<std::pair<int, int>> now_, best_;
  double bestSum_ = 0.0;
};

std::vector<std::pair<int, int>> greedyPairs(int ends, std::vector<PairCost> costs) {
  std::stable_sort(costs.begin(), costs.end(), [](const PairCost& x, const PairCost& y) { return x.gain > y.gain; });
  std::vector<bool> used(ends, false);
  std::vector<std::pair<int, int>> pairs;
  for (const PairCost& c : costs) {
    if (used[c.a] || used[c.b]) continue;
    used[c.a] = used[c.b] = true;
    pairs.emplace_back(std::min(c.a, c.b), std::max(c.a, c.b));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The first point from `first` on where the stroke is as wide as usual; `first`, where it is nowhere.
int withoutFatInk(const EdgeFromEnd& points, int first) {
  std::vector<float> radii;
  for (int k = first; k < points.size(); ++k) radii.push_back(points[k].radius);
  const double usual = static_cast<double>(upperMedian(radii));
  double arc = 0.0;
  for (int k = first; k < points.size() && arc <= kFatReach * usual; ++k) {
    if (static_cast<double>(points[k].radius) <= kFatRadius * usual + kFatSlackPx) return k;
    if (k + 1 < points.size()) arc += (points[k + 1].at - points[k].at).norm();
  }
  return first;
}

MeetingEnd measureFrom(int first, const EdgeFromEnd& points, const SkeletonNode& node, double usualRadius) {
  MeetingEnd e;
  const int n = points.size();
  // An edge that hardly leaves the disc keeps its far half.
  e.first = first == n - 1 ? n / 2 : first;
  const double reach = std::max(kLeastTangentPx, kTangentRadii * usualRadius);
  std::vector<double> s;
  std::vector<Vec2> at;
  std::vector<float> radii;
  double arc = 0.0;
  for (int k = e.first; k < n && arc <= reach; ++k) {
    if (k > e.first) arc += (points[k].at - points[k - 1].at).norm();
    s.push_back(arc);
    at.push_back(points[k].at);
    radii.push_back(points[k].radius);
  }
  if (!radii.empty()) e.radius = std::max(0.5, static_cast<double>(upperMedian(radii)));
  const LocalQuadratic fit = fitLocalQuadratic(s, at, {}, arc >= kCurvedTangent * reach ? 2 : 1);
  Vec2 out = fit.order >= 1 ? fit.r1 : Vec2(points[e.first].at - node.centre);
  if (!(out.norm() > 0.0)) out = Vec2::UnitX();
  e.out = out / out.norm();
  e.at = fit.order >= 1 ? fit.r0 : points[e.first].at;
  return e;
}

// The beginning of an edge beyond the junction, in the frame.
std::vector<Vec2> beginning(const EdgeFromEnd& points, const MeetingEnd& end, double reach, const LocalFrame& frame) {
  std::vector<Vec2> found;
  double arc = 0.0;
  for (int k = end.first; k < points.size() && arc <= reach; ++k) {
    if (k > end.first) arc += (points[k].at - points[k - 1].at).norm();
    found.push_back(frame.local(points[k].at));
  }
  if (arc < kLeastArcShare * reach) found.clear();
  return found;
}

}  // namespace

std::vector<MeetingEnd> measureEnds(std::span<const EdgeFromEnd> edges, const SkeletonNode& node, double usualRadius) {
  std::vector<MeetingEnd> ends;
  for (const EdgeFromEnd& p : edges) {
    const JunctionDisc disc = node.discOf(static_cast<int>(ends.size()));
    int first = 0;
    while (first < p.size() - 1 && (p[first].at - disc.centre).norm() < kTrimRadii * disc.radius) ++first;
    ends.push_back(measureFrom(first, p, node, usualRadius));
  }
  if (node.leading() != nullptr) {
    for (int i = 0; i < std::ssize(ends); ++i)
      ends[i] = measureFrom(withoutFatInk(edges[i], ends[i].first), edges[i], node, usualRadius);
  }
  if (ends.size() != 3) return ends;
  const std::array<Vec2, 3> out = {ends[0].out, ends[1].out, ends[2].out};
  for (int i = 0; i < 3; ++i) {
    if (out[(i + 1) % 3].dot(out[(i + 2) % 3]) > kForkCos)
      ends[i] = measureFrom(withoutFatInk(edges[i], ends[i].first), edges[i], node, usualRadius);
  }
  return ends;
}

double pairCostDeg(const MeetingEnd& p, const MeetingEnd& q, const PairingScale& scale, double freePx) {
  const Vec2 d = q.at - p.at;
  const double miss = 0.5 * (std::abs(cross(p.out, d)) + std::abs(cross(q.out, d)));
  const auto asideDeg = [&](double free) {
    return std::atan2(std::max(0.0, miss - free), d.norm()) * 180.0 / std::numbers::pi;
  };
  if (scale.areInRows) {
    const double aside = asideDeg(kMissNoisePx + freePx), turn = turnDeg(-p.out, q.out);
    return std::sqrt(turn * turn + kAsideEnergy * aside * aside);
  }
  // A pixel more or less says nothing about a width.
  const double octaves = std::max(0.0, std::abs(std::log2(p.radius / q.radius)) - 0.5 / std::min(p.radius, q.radius));
  const double missDeg =
      std::max(kMissPerWidthDeg * miss / std::max({2.0 * scale.usualRadius, 2.0 * scale.nodeRadius, 1.0}),
               scale.ofBundles ? 0.0 : kAsideTurns * asideDeg(kMissNoisePx));
  return turnDeg(-p.out, q.out) + missDeg + kWidthPerOctaveDeg * octaves;
}

std::vector<std::pair<int, int>> pairEnds(std::span<const MeetingEnd> ends, const PairingScale& scale) {
  const int n = static_cast<int>(ends.size());
  std::vector<PairCost> costs;
  const auto rows = scale.areInRows ? std::optional<EndRows>(ends) : std::nullopt;
  // Whatever may go on does: the worst two pairs are better than one good one.
  const double worst = scale.maxBendDeg + kAsideTurns * kWorstAsideDeg + kWorstOctaves * kWidthPerOctaveDeg;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (turnDeg(-ends[a].out, ends[b].out) > scale.maxBendDeg) continue;
      const double cost = pairCostDeg(ends[a], ends[b], scale, rows ? rows->freePx(a, b) : 0.0);
      costs.push_back({a, b, std::max(1.0, worst * worst - cost * cost)});
    }
  }
  if (n > kMostEnds) return greedyPairs(n, std::move(costs));
  return BestPairs(n, costs, rows, scale.narrowestPx).find();
}

std::optional<std::pair<int, int>> pairAlongArc(std::span<const EdgeFromEnd> edges, std::span<const MeetingEnd> ends,
                                                const PairingScale& scale) {
  if (ends.size() != 3 || scale.ofBundles) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    const std::array<int, 2> others = {(i + 1) % 3, (i + 2) % 3};
    if (ends[others[0]].out.dot(ends[others[1]].out) <= kForkCos) continue;
    const double width = 2.0 * ends[i].radius, reach = kArcWidths * width;
    const LocalFrame frame{ends[i].at, ends[i].out};
    const std::vector<Vec2> from = beginning(edges[i], ends[i], reach, frame);
    std::array<double, 2> left;
    for (const int k : {0, 1}) {
      const MeetingEnd& other = ends[others[k]];
      const std::vector<Vec2> to = beginning(edges[others[k]], other, reach, frame);
      if (from.empty() || to.empty() || turnDeg(-ends[i].out, other.out) > scale.maxBendDeg) return std::nullopt;
      const std::optional<LocalArc> arc = arcThrough(from, to);
      if (!arc) return std::nullopt;
      left[k] = std::sqrt(0.5 * (squaresLeft(*arc, from) + squaresLeft(*arc, to)));
    }
    const int best = left[0] <= left[1] ? 0 : 1;
    const double most = kArcMissPx + kArcMissWidths * width;
    if (!(left[best] <= most) || !(left[1 - best] >= std::max(most, kOtherArc * left[best]))) return std::nullopt;
    return std::pair(std::min(i, others[best]), std::max(i, others[best]));
  }
  return std::nullopt;
}

}  // namespace batten
