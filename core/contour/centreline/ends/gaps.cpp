// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/gaps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>

#include "core/base/angle.h"
#include "core/contour/centreline/profile/grey_across.h"

namespace batten {
namespace {

// A skeleton ends before its ink does, by up to a width and a pixel; there are two of them to a gap.
constexpr double kSkeletonShort = 2.0;      // [stroke widths]
constexpr double kSkeletonShortPx = 2.0;    // and a pixel at each of the two
constexpr double kFacingDeg = 30.0;         // between the direction of an end and the way to the other
constexpr double kShortGapWidths = 1.5;     // [stroke widths] below this gap its direction is unreliable:
constexpr double kShortGapTurnDeg = 60.0;   // the directions of the two ends decide,
constexpr double kShortGapBack = 0.5;       // [stroke widths] and they may lie a little beside each other
constexpr double kLeastRingWidths = 6.0;    // [stroke widths] round a ring that one stroke path makes
constexpr double kDirectionWidths = 3.0;    // [stroke widths] over which the direction of an end is taken,
constexpr double kLeastDirectionPx = 4.0;   // and of thin strokes
constexpr double kMostOfPath = 0.3;         // of its points: what of a short one is left out at its end
constexpr double kLeastStrokeWidths = 3.0;  // [stroke widths] a shorter stroke has no direction, and is not joined
constexpr double kBridgedWidthRatio = 1.5;  // of two strokes that may be one; and a pixel more
constexpr double kOctaveCost = 2.0;         // of twice the width, as of so many widths of gap
constexpr double kGreyCost = 0.02;          // [1/grey] of ends that differ in darkness
constexpr double kAcrossRadii = 4.0;        // [radii] and [px] to one side of a middle: beyond two widths the ink is
constexpr double kAcrossPx = 4.0;  // that of others, which a mean over the middle half of the chords leaves out
// Ends in shared ink: [widths] apart at most, [degrees] by which each looks past the other, and [px] more.
constexpr double kSharedWidths = 15.0, kSharedFacingDeg = 8.0, kSharedMissPx = 1.0;
constexpr double kSharedTurnDeg = 12.0;  // between the directions of the two
constexpr double kSharedLength = 4.0;    // [widths] of a stroke: a shorter one has no direction
constexpr double kChosenWidths = 2.0;    // beyond a junction that the user paired: its ends stay as they are
constexpr int kBridgeRounds = 4;         // an end whose best partner is taken may find another
constexpr int kEndsPerLook = 256;        // between polls of the cancel token

struct OpenEnd {
  int path = 0, side = 0;  ///< side 0: the start.
  Vec2 at = Vec2::Zero();
  Vec2 out = Vec2::Zero();  ///< Unit direction in which the stroke would go on.
  double width = 1.0;       ///< [px] of the skeleton's discs, which are half a pixel and more too small.
  double inkWidth = 1.0;    ///< [px] across the ink.
  double level = 0.0;       ///< [grey] mean of the stroke near its end.
  bool isPencil = false;
  std::optional<int> best = {};  ///< The free end that it costs least to join.
  double bestCost = 0.0;
};

// Direction of a free end; the last pixels of a skeleton turn to a corner of the pen's end and are left out.
Vec2 endDirection(const StrokePath& s, int side, double width) {
  const int n = static_cast<int>(s.points.size());
  const auto at = [&](double k) {
    const int i = static_cast<int>(std::clamp(k, 0.0, n - 1.0));
    return s.points[side == 0 ? i : n - 1 - i].at;
  };
  const double near = std::min(0.5 * width + 1.0, kMostOfPath * n);
  const double far = near + std::max(kLeastDirectionPx, kDirectionWidths * width);
  const Vec2 d = at(near) - at(far);
  return d.norm() > 0.0 ? Vec2(d / d.norm()) : Vec2::Zero();
}

// [px] of ink on one side of a place.
double inkTowards(const BitImage& ink, const Vec2& from, const Vec2& direction, double most) {
  constexpr double kStepPx = 0.125;  // of a chord; many are averaged
  double reach = 0.0;
  for (; reach < most; reach += kStepPx) {
    const Vec2 p = from + reach * direction;
    if (!ink.at(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())))) break;
  }
  return reach;
}

// [px] width of the ink across a stroke: the mean over the middle half of its chords, since each is whole pixels.
double inkWidthOf(const StrokePath& s, const BitImage& ink) {
  constexpr int kChords = 64;       // at most, spread over the stroke
  constexpr int kReach = 4;         // points to either side, for the direction
  constexpr int kFewestChords = 4;  // of which half are averaged
  const int n = static_cast<int>(s.points.size());
  std::vector<double> chords;
  for (int k = 0; k < kChords && n > 2 * kReach; ++k) {
    const int i = kReach + static_cast<int>(static_cast<std::int64_t>(k) * (n - 2 * kReach) / kChords);
    if (s.points[i].part != StrokePart::Ink) continue;
    const Vec2 along = s.points[i + kReach].at - s.points[i - kReach].at;
    if (!(along.norm() > 0.0)) continue;
    const Vec2 across = leftNormal(along.normalized());
    const double most = kAcrossRadii * static_cast<double>(s.points[i].radius) + kAcrossPx;
    chords.push_back(inkTowards(ink, s.points[i].at, across, most) + inkTowards(ink, s.points[i].at, -across, most));
  }
  if (std::ssize(chords) < kFewestChords) return s.widthPx();
  std::sort(chords.begin(), chords.end());
  const auto quarter = std::ssize(chords) / 4;
  const double sum = std::accumulate(chords.begin() + quarter, chords.end() - quarter, 0.0);
  return std::max(1.0, sum / static_cast<double>(std::ssize(chords) - 2 * quarter));
}

// [grey] mean along the middle of a stroke, over a few widths from its end.
double levelAt(const StrokePath& s, int side, double width, const GreyImage& grey) {
  const int n = static_cast<int>(s.points.size());
  const int count = std::clamp(static_cast<int>(kDirectionWidths * width), 1, n);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    sum += levelOfPixel(grey, s.points[side == 0 ? k : n - 1 - k].at);
  }
  return sum / count;
}

// Free ends of the ink, or those that end in the ink of another stroke.
enum class EndKind { Free, InInk };

std::vector<OpenEnd> openEnds(const std::vector<StrokePath>& paths, const FollowedInk& followed, EndKind kind) {
  std::vector<OpenEnd> ends;
  for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
    const StrokePath& s = paths[i];
    if (s.closed || s.points.size() < 3) continue;
    const double width = s.widthPx();
    const bool isPencil = followed.pencil[i];
    if (!isPencil && s.length() < kLeastStrokeWidths * width) continue;
    const auto isAsked = [&](int side) { return s.tip[side] == (kind == EndKind::Free); };
    const double inkWidth = isAsked(0) || isAsked(1) ? inkWidthOf(s, followed.ink) : width;
    for (int side = 0; side < 2; ++side) {
      if (!isAsked(side)) continue;
      const Vec2 at = side == 0 ? s.points.front().at : s.points.back().at;
      const double level = levelAt(s, side, width, followed.grey);
      ends.push_back({i, side, at, endDirection(s, side, width), width, inkWidth, level, isPencil});
    }
  }
  std::sort(ends.begin(), ends.end(), [](const OpenEnd& a, const OpenEnd& b) {
    return a.at.x() != b.at.x() ? a.at.x() < b.at.x() : (a.at.y() != b.at.y() ? a.at.y() < b.at.y() : a.side < b.side);
  });
  return ends;
}

// [px] of the straight way from one end to the other that is paper, between the last ink here and the first ink there:
// the gap as it is seen. Skeletons end inside the ink, by an amount that depends on the shape of the pen tip.
double paperBetween(const OpenEnd& a, const OpenEnd& b, const BitImage& ink) {
  constexpr double kStepPx = 0.25;  // passes over no more than the corner of a pixel
  const double length = (b.at - a.at).norm();
  const int steps = static_cast<int>(length / kStepPx) + 1;
  std::optional<int> first;
  int last = 0;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = a.at + (b.at - a.at) * (static_cast<double>(i) / steps);
    if (ink.at(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())))) continue;
    if (!first) first = i;
    last = i;
  }
  return first ? length * (last - *first + 1) / steps : 0.0;
}

// Cost of joining two ends; nothing where they do not belong together. They must face each other unless the gap is no
// longer than the pen is wide.
std::optional<double> joinCost(const OpenEnd& a, const OpenEnd& b, const BitImage& ink, double gapFactor) {
  const double width = 0.5 * (a.width + b.width), thinner = std::min(a.inkWidth, b.inkWidth);
  const double octaves = std::abs(std::log2(a.inkWidth / b.inkWidth));
  const bool isPencil = a.isPencil && b.isPencil;
  if (!isPencil && octaves > std::log2(kBridgedWidthRatio) + 1.0 / thinner) return std::nullopt;
  const Vec2 d = b.at - a.at;
  const double gap = d.norm(), longest = gapFactor * 0.5 * (a.inkWidth + b.inkWidth);
  if (gap > longest + kSkeletonShort * width + kSkeletonShortPx) return std::nullopt;
  const double turn = std::acos(std::clamp(-a.out.dot(b.out), -1.0, 1.0));
  const double limit = std::cos(kFacingDeg * kRadPerDeg) * gap;
  const bool isFacing = gap <= kShortGapWidths * width
                            ? turn <= kShortGapTurnDeg * kRadPerDeg && d.dot(a.out) >= -kShortGapBack * width
                            : d.dot(a.out) >= limit && -d.dot(b.out) >= limit;
  // Half a pixel for the mask, whose pixels are whole.
  if (!isFacing || paperBetween(a, b, ink) > longest + 0.5) return std::nullopt;
  if (isPencil) return gap + width * turn;
  return gap + width * (turn + kOctaveCost * octaves + kGreyCost * std::abs(a.level - b.level));
}

// Cost of one stroke that runs on through the ink of others, as under a bundle of lines that it crosses at a shallow
// angle: its ends look straight at each other, with nothing but ink between.
std::optional<double> sharedCost(const OpenEnd& a, const OpenEnd& b, const BitImage& ink, double maxBendDeg) {
  const double width = 0.5 * (a.inkWidth + b.inkWidth), thinner = std::min(a.inkWidth, b.inkWidth);
  const Vec2 d = b.at - a.at;
  const double gap = d.norm();
  if (!(gap > 0.0) || gap > kSharedWidths * width) return std::nullopt;
  const double octaves = std::abs(std::log2(a.inkWidth / b.inkWidth));
  if (octaves > std::log2(kBridgedWidthRatio) + 1.0 / thinner) return std::nullopt;
  const double turn = std::acos(std::clamp(-a.out.dot(b.out), -1.0, 1.0));
  const double miss = gap * std::sin(kSharedFacingDeg * kRadPerDeg) + kSharedMissPx;
  const bool isFacing = d.dot(a.out) > 0.0 && d.dot(b.out) < 0.0 && std::abs(cross(a.out, d)) <= miss &&
                        std::abs(cross(b.out, d)) <= miss && turn <= std::min(kSharedTurnDeg, maxBendDeg) * kRadPerDeg;
  if (!isFacing || paperBetween(a, b, ink) > 0.0) return std::nullopt;
  return gap + width * (turn + kOctaveCost * octaves + kGreyCost * std::abs(a.level - b.level));
}

void join(std::vector<StrokePath>& paths, const OpenEnd& a, const OpenEnd& b, StrokePart part) {
  StrokePath& first = paths[a.path];
  StrokePath& second = paths[b.path];
  const auto radius = static_cast<float>(0.25 * (a.width + b.width));
  std::vector<StrokePathPoint> bridge;
  for (const Vec2& at : cubicBetween(a.at, a.out, b.at, -b.out)) bridge.push_back({at, radius, part});
  if (a.path == b.path) {
    if (a.side == 0) std::reverse(bridge.begin(), bridge.end());
    first.points.insert(first.points.end(), bridge.begin(), bridge.end());
    first.closed = true;
    return;
  }
  if (a.side == 0) {
    std::reverse(first.points.begin(), first.points.end());
    std::swap(first.tip[0], first.tip[1]);
  }
  if (b.side == 1) {
    std::reverse(second.points.begin(), second.points.end());
    std::swap(second.tip[0], second.tip[1]);
  }
  first.points.insert(first.points.end(), bridge.begin(), bridge.end());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  first.tip[1] = second.tip[1];
  second = StrokePath{};
}

// Joins mutually cheapest ends, round by round.
// @param farthestPx of an end of the largest width [px]; costOf(a, b) is absent for ends that do not belong together.
template <class FarthestPx, class EndsOf, class CostOf>
void joinCheapest(std::vector<StrokePath>& paths, StrokePart part, const EndsOf& endsOf, const FarthestPx& farthestPx,
                  const CostOf& costOf, const RunContext& context) {
  const auto offer = [](OpenEnd& e, int other, double cost) {
    if (!e.best || cost < e.bestCost) {
      e.best = other;
      e.bestCost = cost;
    }
  };
  for (int round = 0; round < kBridgeRounds; ++round) {
    std::vector<OpenEnd> ends = endsOf();
    double widest = 1.0;
    for (const OpenEnd& e : ends) widest = std::max(widest, std::max(e.width, e.inkWidth));
    const double farthest = farthestPx(widest);
    for (int i = 0; i < std::ssize(ends); ++i) {
      if (i % kEndsPerLook == 0 && context.isCancelled()) return;
      for (int j = i + 1; j < std::ssize(ends) && ends[j].at.x() - ends[i].at.x() <= farthest; ++j) {
        OpenEnd &a = ends[i], &b = ends[j];
        const bool tooShort =
            a.path == b.path && paths[a.path].length() < kLeastRingWidths * a.width + (a.at - b.at).norm();
        const auto cost = tooShort ? std::nullopt : costOf(a, b);
        if (!cost) continue;
        offer(a, j, *cost);
        offer(b, i, *cost);
      }
    }
    bool joined = false;
    std::vector<bool> moved(paths.size(), false);
    for (int i = 0; i < std::ssize(ends); ++i) {
      const OpenEnd& a = ends[i];
      if (!a.best || *a.best <= i || ends[*a.best].best != i) continue;
      const OpenEnd& b = ends[*a.best];
      // A stroke path is reversed at most once a round, so that the sides noted above stay true.
      if (moved[a.path] || moved[b.path]) {
        joined = true;
        continue;
      }
      moved[a.path] = moved[b.path] = joined = true;
      join(paths, a, b, part);
    }
    if (!joined) break;
  }
}

}  // namespace

void joinThroughInk(std::vector<StrokePath>& paths, const FollowedInk& followed,
                    std::span<const StrokeJunction> junctions, const EdgeParams& params, const RunContext& context) {
  std::vector<StrokeJunction> chosen;
  std::ranges::copy_if(junctions, std::back_inserter(chosen),
                       [](const StrokeJunction& j) { return j.choice.has_value(); });
  const auto isChosen = [&](const OpenEnd& e) {
    return std::ranges::any_of(chosen, [&](const StrokeJunction& j) {
      return (j.positionPx - e.at).norm() <= j.radiusPx + kChosenWidths * e.inkWidth;
    });
  };
  const auto endsOf = [&] {
    std::vector<OpenEnd> ends = openEnds(paths, followed, EndKind::InInk);
    std::erase_if(ends,
                  [&](const OpenEnd& e) { return paths[e.path].length() < kSharedLength * e.inkWidth || isChosen(e); });
    return ends;
  };
  joinCheapest(
      paths, StrokePart::Junction, endsOf, [](double widest) { return kSharedWidths * widest; },
      [&](const OpenEnd& a, const OpenEnd& b) { return sharedCost(a, b, followed.ink, params.maxBendDeg); }, context);
}

void bridgeGaps(std::vector<StrokePath>& paths, const FollowedInk& followed, const EdgeParams& params,
                const RunContext& context) {
  if (params.gapFactor > 0.0) {
    joinCheapest(
        paths, StrokePart::Bridge, [&] { return openEnds(paths, followed, EndKind::Free); },
        [&](double widest) { return (params.gapFactor + kSkeletonShort) * widest + kSkeletonShortPx; },
        [&](const OpenEnd& a, const OpenEnd& b) { return joinCost(a, b, followed.ink, params.gapFactor); }, context);
  }
  std::erase_if(paths, [](const StrokePath& s) { return s.points.empty(); });
}

}  // namespace batten
