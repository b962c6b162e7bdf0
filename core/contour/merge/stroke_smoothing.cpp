// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_smoothing.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kNodePx = 4.0;        // between the nodes at which the line is moved
constexpr double kBandShare = 0.9;     // of the band: the line stays between the strokes
constexpr double kBeyond = 0.45;       // of the spread: the room just beyond the end of a stroke
constexpr double kFade = 0.12;         // [px/px] how fast it goes to nothing from there
constexpr double kLeastRoomPx = 0.02;  // of single strokes
constexpr double kLeastBandPx = 0.5;   // strokes nearer to each other need no fairing
constexpr double kSmoothRoomPx = 0.5;  // from here on the line is smoothed between the nodes, too
constexpr double kOver = 0.01;         // of the room: so little beyond it is cut off
constexpr double kLeastStiffer = 2.0, kMostStiffer = 100.0;
constexpr int kRounds = 24;
constexpr int kFewestNodes = 8;

// Every value becomes the largest that is left of its neighbours' when they fall by `fall` a step.
void spread(std::vector<double>& v, bool closed, double fall) {
  const int n = static_cast<int>(v.size()), steps = closed ? 2 * n : n;
  const auto pass = [&](int i, int neighbour) {
    const auto to = static_cast<std::size_t>(i % n), from = static_cast<std::size_t>(neighbour % n);
    v[to] = std::max(v[to], v[from] - fall);
  };
  for (int k = 1; k < steps; ++k) pass(k, k - 1);
  for (int k = steps - 1; k-- > 0;) pass(k, k + 1);
}

// How far a place of the line may move to its left and to its right.
struct Room {
  double left = 0.0, right = 0.0;
  double larger() const { return std::max(left, right); }
};

// As much of a move as there is room for: not beyond the strokes on either side, and nowhere farther than they are.
Vec2 within(const Vec2& move, const Vec2& normal, const Room& room) {
  if (!(room.larger() > kLeastRoomPx)) return Vec2::Zero();  // single strokes stay
  const double wanted = move.dot(normal), across = std::clamp(wanted, -room.right, room.left);
  Vec2 along = move - wanted * normal;
  const double most = std::sqrt(std::max(0.0, room.larger() * room.larger() - across * across));
  if (along.norm() > most) along *= most / along.norm();
  return across * normal + along;
}

// Positions at even steps along the line, and the room there.
struct Nodes {
  std::vector<double> s;  // of the points
  double step = 0.0;
  std::vector<Vec2> at, normal;
  std::vector<double> left, right;
  Room room(std::size_t k) const { return {left[k], right[k]}; }
};

// Beyond the end of a stroke there is room still, and less the farther away: the line need not turn to it at once.
void addRoomBeyond(Nodes& nodes, bool closed) {
  std::vector<double> left = nodes.left, right = nodes.right;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const double most = kBeyond * (left[k] + right[k]);
    left[k] = std::min(left[k], most);
    right[k] = std::min(right[k], most);
  }
  spread(left, closed, kFade * nodes.step);
  spread(right, closed, kFade * nodes.step);
  for (std::size_t k = 0; k < left.size(); ++k) {
    nodes.left[k] = std::max(nodes.left[k], left[k]);
    nodes.right[k] = std::max(nodes.right[k], right[k]);
  }
}

Nodes nodesOf(const std::vector<Vec2>& points, bool closed, const std::vector<StrokeBand>& band,
              const std::vector<Vec2>& tangent) {
  Nodes nodes;
  nodes.s = cumulativeLength(points);
  const double length = polylineLength(points, closed);
  const int spans = static_cast<int>(std::lround(length / kNodePx));
  if (spans < kFewestNodes) return nodes;
  nodes.step = length / spans;
  std::size_t i = 0;
  for (int k = 0; k < spans + (closed ? 0 : 1); ++k) {
    const double s = k * nodes.step;
    while (i + 1 < points.size() && nodes.s[i + 1] <= s) ++i;
    const std::size_t next = i + 1 < points.size() ? i + 1 : (closed ? 0 : i);
    const double gap = (points[next] - points[i]).norm();
    const double part = gap > 0.0 ? std::clamp((s - nodes.s[i]) / gap, 0.0, 1.0) : 0.0;
    nodes.at.push_back(points[i] + part * (points[next] - points[i]));
    nodes.normal.push_back(leftNormal(tangent[i]));
    nodes.left.push_back(kBandShare * static_cast<double>(std::max(band[i].left, band[next].left)));
    nodes.right.push_back(kBandShare * static_cast<double>(std::max(band[i].right, band[next].right)));
  }
  addRoomBeyond(nodes, closed);
  return nodes;
}

// Nodes of least third differences with these weights on where they were.
class ThirdDifferences {
 public:
  ThirdDifferences(int count, bool closed) {
    std::vector<Eigen::Triplet<double>> entries;
    static constexpr double kRow[4] = {-1.0, 3.0, -3.0, 1.0};
    for (int k = 0; k < (closed ? count : count - 3); ++k)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) entries.emplace_back((k + i) % count, (k + j) % count, kRow[i] * kRow[j]);
    roughness_.resize(count, count);
    roughness_.setFromTriplets(entries.begin(), entries.end());
  }
  bool solve(const std::vector<Vec2>& target, const std::vector<double>& weight, std::vector<Vec2>& out) {
    const auto n = static_cast<Eigen::Index>(target.size());
    Eigen::SparseMatrix<double> a = roughness_;
    Eigen::MatrixX2d right(n, 2);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      a.coeffRef(k, k) += weight[at];
      right.row(k) = weight[at] * target[at].transpose();
    }
    if (!analysed_) solver_.analyzePattern(a);
    analysed_ = true;
    solver_.factorize(a);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::MatrixX2d x = solver_.solve(right);
    if (!x.allFinite()) return false;
    out.resize(target.size());
    for (Eigen::Index k = 0; k < n; ++k) out[k] = x.row(k).transpose();
    return true;
  }

 private:
  Eigen::SparseMatrix<double> roughness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

// How the nodes move: they are held ever more firmly where the line would leave its room.
std::vector<Vec2> shifts(const Nodes& nodes, bool closed, double longestPx) {
  const std::size_t n = nodes.at.size();
  const double longest = std::max(longestPx, 6.0 * nodes.step);
  std::vector<double> weight(n, std::pow(2.0 * std::numbers::pi * nodes.step / longest, 6));
  std::vector<Vec2> shift(n, Vec2::Zero()), held = nodes.at, fair;
  ThirdDifferences system(static_cast<int>(n), closed);
  for (int round = 0; round < kRounds; ++round) {
    if (!system.solve(held, weight, fair)) break;
    bool outside = false;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 wanted = fair[k] - nodes.at[k];
      shift[k] = within(wanted, nodes.normal[k], nodes.room(k));
      const double room = std::max(nodes.room(k).larger(), kLeastRoomPx);
      const double beyond = (wanted - shift[k]).norm(), over = beyond / room;
      if (beyond <= std::max(kLeastRoomPx, kOver * room)) continue;
      outside = true;
      held[k] = nodes.at[k] + shift[k];
      weight[k] = std::min(1e6, weight[k] * std::clamp((1.0 + over) * (1.0 + over), kLeastStiffer, kMostStiffer));
    }
    if (!outside) break;
  }
  return shift;
}

}  // namespace

std::vector<Vec2> fairWithinBand(const std::vector<Vec2>& before, bool closed, const std::vector<StrokeBand>& band,
                                 double longestPx) {
  const std::size_t n = before.size();
  if (n < 2 || band.size() != n) return before;
  float widest = 0.0f;
  for (const StrokeBand& b : band) widest = std::max(widest, 0.5f * (b.left + b.right));
  if (widest < static_cast<float>(kLeastBandPx)) return before;
  std::vector<Vec2> points = before;
  const std::vector<Vec2> tangent = directions(points, closed, 3);
  const Nodes nodes = nodesOf(points, closed, band, tangent);
  if (nodes.at.empty()) return before;
  const std::vector<Vec2> shift = shifts(nodes, closed, longestPx);
  for (std::size_t i = 0; i < n; ++i) points[i] += pointBetween(shift, closed, nodes.s[i] / nodes.step);
  // What is shorter than the nodes are apart.
  const std::vector<Vec2> smooth = smoothPolyline(points, closed, kNodePx);
  const int last = static_cast<int>(nodes.at.size()) - 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double place = nodes.s[i] / nodes.step;
    const int k = std::clamp(static_cast<int>(place), 0, last);
    const int after = closed ? wrapIndex(k + 1, last + 1) : std::min(k + 1, last);
    const Room here = nodes.room(static_cast<std::size_t>(k)), next = nodes.room(static_cast<std::size_t>(after));
    const double part = std::clamp(place - k, 0.0, 1.0);
    const Room room{std::lerp(here.left, next.left, part), std::lerp(here.right, next.right, part)};
    points[i] += std::min(1.0, room.larger() / kSmoothRoomPx) * (smooth[i] - points[i]);
    points[i] = before[i] + within(points[i] - before[i], leftNormal(tangent[i]), room);
  }
  return points;
}

}  // namespace batten
