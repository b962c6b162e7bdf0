// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_smoothing.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kNodePx = 4.0;                              // between the nodes at which the line is moved
constexpr double kBundleShare = 0.9;                         // of the bundle: the line stays between the strokes
constexpr double kBeyond = 0.45;                             // of the spread: the room just beyond the end of a stroke
constexpr double kFade = 0.12;                               // [px/px] how fast it goes to nothing from there
constexpr double kLeastRoomPx = 0.02;                        // of single strokes
constexpr double kLeastBundlePx = 0.5;                       // strokes nearer to each other need no fairing
constexpr double kSmoothRoomPx = 0.5;                        // from here on the line is smoothed between the nodes, too
constexpr double kOver = 0.01;                               // of the room: so little beyond it is cut off
constexpr double kLeastStiffer = 2.0, kMostStiffer = 100.0;  // times: by which the weight of a node may grow in a round
constexpr double kFirmest = 1e6;                             // weight of a node that is held, against third differences
constexpr double kShortestWaveSteps = 6.0;                   // nodes: shorter waves cannot be told
constexpr int kNormalReach = 3;                              // points to either side
constexpr int kFairingRounds = 24;                           // fewer once every node lies in its room
constexpr int kFewestNodes = 8;                              // a shorter line is hardly longer than the shortest wave

// Every value becomes the largest that is left of its neighbours' when they fall by `fall` a step.
void spread(std::vector<double>& v, bool closed, double fall) {
  const int n = static_cast<int>(v.size()), steps = closed ? 2 * n : n;
  const auto pass = [&](int i, int neighbour) { v[i % n] = std::max(v[i % n], v[neighbour % n] - fall); };
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
  const double offset = move.dot(normal), across = std::clamp(offset, -room.right, room.left);
  Vec2 along = move - offset * normal;
  const double most = std::sqrt(std::max(0.0, room.larger() * room.larger() - across * across));
  if (along.norm() > most) along *= most / along.norm();
  return across * normal + along;
}

// A position at even steps along the line, and the room there.
struct Node {
  Vec2 at = Vec2::Zero(), normal = Vec2::Zero();
  Room room;
};
struct Nodes {
  double step = 0.0;  // [px]
  std::vector<Node> nodes;
  int count() const { return static_cast<int>(nodes.size()); }
};

// Beyond the end of a stroke there is room still, and less the farther away: the line need not turn to it at once.
void addRoomBeyond(Nodes& line, bool closed) {
  std::vector<double> left, right;  // apart, since each is spread by itself
  for (const Node& node : line.nodes) {
    const double most = kBeyond * (node.room.left + node.room.right);
    left.push_back(std::min(node.room.left, most));
    right.push_back(std::min(node.room.right, most));
  }
  spread(left, closed, kFade * line.step);
  spread(right, closed, kFade * line.step);
  for (int k = 0; k < line.count(); ++k) {
    Room& room = line.nodes[k].room;
    room = {std::max(room.left, left[k]), std::max(room.right, right[k])};
  }
}

// @param s arc length of the points.
Nodes nodesOf(const std::vector<Vec2>& points, bool closed, const std::vector<BundleWidths>& bundle,
              const std::vector<Vec2>& tangent, const std::vector<double>& s) {
  Nodes made;
  const double length = polylineLength(points, closed);
  const int spans = static_cast<int>(std::lround(length / kNodePx));
  if (spans < kFewestNodes) return made;
  made.step = length / spans;
  const int n = static_cast<int>(points.size());
  int i = 0;
  for (int k = 0; k < spans + (closed ? 0 : 1); ++k) {
    const double arc = k * made.step;
    while (i + 1 < n && s[i + 1] <= arc) ++i;
    const int next = i + 1 < n ? i + 1 : (closed ? 0 : i);
    const double gap = (points[next] - points[i]).norm();
    const double part = gap > 0.0 ? std::clamp((arc - s[i]) / gap, 0.0, 1.0) : 0.0;
    const Room room{kBundleShare * static_cast<double>(std::max(bundle[i].left, bundle[next].left)),
                    kBundleShare * static_cast<double>(std::max(bundle[i].right, bundle[next].right))};
    made.nodes.push_back({points[i] + part * (points[next] - points[i]), leftNormal(tangent[i]), room});
  }
  addRoomBeyond(made, closed);
  return made;
}

// Nodes of least third differences with these weights on where they were.
class ThirdDifferences {
 public:
  ThirdDifferences(int count, bool closed) {
    std::vector<Eigen::Triplet<double>> entries;
    static constexpr double kRow[4] = {-1.0, 3.0, -3.0, 1.0};  // of a third difference
    for (int k = 0; k < (closed ? count : count - 3); ++k)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) entries.emplace_back((k + i) % count, (k + j) % count, kRow[i] * kRow[j]);
    roughness_.resize(count, count);
    roughness_.setFromTriplets(entries.begin(), entries.end());
  }
  // Nothing where the system cannot be solved.
  std::optional<std::vector<Vec2>> solve(const std::vector<Vec2>& target, const std::vector<double>& weight) {
    const Eigen::Index n = std::ssize(target);
    Eigen::SparseMatrix<double> a = roughness_;
    Eigen::MatrixX2d right(n, 2);
    for (Eigen::Index k = 0; k < n; ++k) {
      a.coeffRef(k, k) += weight[k];
      right.row(k) = weight[k] * target[k].transpose();
    }
    if (!analysed_) solver_.analyzePattern(a);
    analysed_ = true;
    solver_.factorize(a);
    if (solver_.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixX2d x = solver_.solve(right);
    if (!x.allFinite()) return std::nullopt;
    std::vector<Vec2> solution(target.size());
    for (Eigen::Index k = 0; k < n; ++k) solution[k] = x.row(k).transpose();
    return solution;
  }

 private:
  Eigen::SparseMatrix<double> roughness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

// How the nodes move: they are held ever more firmly where the line would leave its room.
std::vector<Vec2> shifts(const Nodes& line, bool closed, double longestPx) {
  const int n = line.count();
  const double longest = std::max(longestPx, kShortestWaveSteps * line.step);
  std::vector<double> weight(n, std::pow(2.0 * std::numbers::pi * line.step / longest, 6));
  std::vector<Vec2> shift(n, Vec2::Zero()), held;
  for (const Node& node : line.nodes) held.push_back(node.at);
  ThirdDifferences system(n, closed);
  for (int round = 0; round < kFairingRounds; ++round) {
    const auto fair = system.solve(held, weight);
    if (!fair) break;
    bool outside = false;
    for (int k = 0; k < n; ++k) {
      const Node& node = line.nodes[k];
      const Vec2 unbounded = (*fair)[k] - node.at;
      shift[k] = within(unbounded, node.normal, node.room);
      const double room = std::max(node.room.larger(), kLeastRoomPx);
      const double beyond = (unbounded - shift[k]).norm(), over = beyond / room;
      if (beyond <= std::max(kLeastRoomPx, kOver * room)) continue;
      outside = true;
      held[k] = node.at + shift[k];
      weight[k] = std::min(kFirmest, weight[k] * std::clamp((1.0 + over) * (1.0 + over), kLeastStiffer, kMostStiffer));
    }
    if (!outside) break;
  }
  return shift;
}

}  // namespace

std::vector<Vec2> fairWithinBundle(const std::vector<Vec2>& before, bool closed,
                                   const std::vector<BundleWidths>& bundle, double longestPx) {
  const int n = static_cast<int>(before.size());
  if (n < 2 || std::ssize(bundle) != n) return before;
  float widest = 0.0f;
  for (const BundleWidths& b : bundle) widest = std::max(widest, 0.5f * (b.left + b.right));
  if (widest < static_cast<float>(kLeastBundlePx)) return before;
  std::vector<Vec2> points = before;
  const std::vector<Vec2> tangent = directions(points, closed, kNormalReach);
  const std::vector<double> s = cumulativeLength(points);
  const Nodes line = nodesOf(points, closed, bundle, tangent, s);
  if (line.nodes.empty()) return before;
  const std::vector<Vec2> shift = shifts(line, closed, longestPx);
  for (int i = 0; i < n; ++i) points[i] += pointBetween(shift, closed, s[i] / line.step);
  // What is shorter than the nodes are apart.
  const std::vector<Vec2> smooth = smoothPolyline(points, closed, kNodePx);
  const int last = line.count() - 1;
  for (int i = 0; i < n; ++i) {
    const double place = s[i] / line.step;
    const int k = std::clamp(static_cast<int>(place), 0, last);
    const int after = closed ? wrapIndex(k + 1, last + 1) : std::min(k + 1, last);
    const Room &here = line.nodes[k].room, &next = line.nodes[after].room;
    const double part = std::clamp(place - k, 0.0, 1.0);
    const Room room{std::lerp(here.left, next.left, part), std::lerp(here.right, next.right, part)};
    points[i] += std::min(1.0, room.larger() / kSmoothRoomPx) * (smooth[i] - points[i]);
    points[i] = before[i] + within(points[i] - before[i], leftNormal(tangent[i]), room);
  }
  return points;
}

}  // namespace batten
