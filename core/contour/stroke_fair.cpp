// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/stroke_fair.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

constexpr double kNodePx = 4.0;        // between the nodes at which the line is moved
constexpr double kBandShare = 0.9;     // of the band: the line stays between the strokes
constexpr double kFade = 0.12;         // [px/px] how fast the room goes to nothing beyond the end of a stroke
constexpr double kLeastRoomPx = 0.02;  // of single strokes
constexpr double kLeastBandPx = 0.5;   // strokes nearer to each other need no fairing
constexpr double kSmoothRoomPx = 0.5;  // from here on the line is smoothed between the nodes, too
constexpr double kMostStiffer = 100.0;
constexpr int kRounds = 24;
constexpr int kFewestNodes = 8;

// Every value becomes the largest that is left of its neighbours' when they fall by `fall` a step.
void spread(std::vector<double>& v, bool closed, double fall) {
  const int n = static_cast<int>(v.size());
  const int steps = closed ? 2 * n : n;
  for (int k = 1; k < steps; ++k) {
    const auto to = static_cast<std::size_t>(k % n), from = static_cast<std::size_t>((k - 1) % n);
    v[to] = std::max(v[to], v[from] - fall);
  }
  for (int k = steps - 1; k-- > 0;) {
    const auto to = static_cast<std::size_t>(k % n), from = static_cast<std::size_t>((k + 1) % n);
    v[to] = std::max(v[to], v[from] - fall);
  }
}

// Positions at even steps along the line, and the room there.
struct Nodes {
  std::vector<double> s;  // of the points
  double step = 0.0;
  std::vector<Vec2> at;
  std::vector<double> room;
};

Nodes nodesOf(const std::vector<Vec2>& points, bool closed, const std::vector<float>& bandPx) {
  Nodes nodes;
  nodes.s.push_back(0.0);
  for (std::size_t i = 1; i < points.size(); ++i)
    nodes.s.push_back(nodes.s.back() + (points[i] - points[i - 1]).norm());
  const double length = nodes.s.back() + (closed ? (points.front() - points.back()).norm() : 0.0);
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
    nodes.room.push_back(kBandShare * static_cast<double>(std::max(bandPx[i], bandPx[next])));
  }
  spread(nodes.room, closed, kFade * nodes.step);
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
    for (Eigen::Index k = 0; k < n; ++k) out[static_cast<std::size_t>(k)] = x.row(k).transpose();
    return true;
  }

 private:
  Eigen::SparseMatrix<double> roughness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

// How the nodes move: weights grow where the line would leave its room.
std::vector<Vec2> shifts(const Nodes& nodes, bool closed, double longestPx) {
  const std::size_t n = nodes.at.size();
  const double longest = std::max(longestPx, 6.0 * nodes.step);
  std::vector<double> weight(n, std::pow(2.0 * std::numbers::pi * nodes.step / longest, 6));
  std::vector<Vec2> shift(n, Vec2::Zero()), fair;
  ThirdDifferences system(static_cast<int>(n), closed);
  for (int round = 0; round < kRounds; ++round) {
    if (!system.solve(nodes.at, weight, fair)) break;
    bool outside = false;
    for (std::size_t k = 0; k < n; ++k) {
      shift[k] = fair[k] - nodes.at[k];
      const double room = std::max(nodes.room[k], kLeastRoomPx);
      const double over = shift[k].squaredNorm() / (room * room);
      if (over <= 1.02) continue;
      outside = true;
      weight[k] = std::min(1e6, weight[k] * std::min(over, kMostStiffer));
    }
    if (!outside) break;
  }
  for (std::size_t k = 0; k < n; ++k) {
    // Never farther than there is room, whatever the rounds came to; single strokes stay.
    const double room = nodes.room[k], far = shift[k].norm();
    if (!(room > kLeastRoomPx)) {
      shift[k] = Vec2::Zero();
    } else if (far > 1.2 * room) {
      shift[k] *= 1.2 * room / far;
    }
  }
  return shift;
}

// Catmull-Rom between the nodes.
Vec2 between(const std::vector<Vec2>& v, bool closed, double place) {
  const int n = static_cast<int>(v.size());
  const int k = std::clamp(static_cast<int>(std::floor(place)), 0, closed ? n - 1 : n - 2);
  const double t = std::clamp(place - k, 0.0, 1.0);
  const auto get = [&](int i) -> const Vec2& {
    return v[static_cast<std::size_t>(closed ? wrapIndex(i, n) : std::clamp(i, 0, n - 1))];
  };
  const Vec2 &a = get(k - 1), &b = get(k), &c = get(k + 1), &d = get(k + 2);
  return b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

}  // namespace

void fairWithinBand(std::vector<Vec2>& points, bool closed, const std::vector<float>& bandPx, double longestPx) {
  if (points.size() < 2 || bandPx.size() != points.size()) return;
  if (*std::max_element(bandPx.begin(), bandPx.end()) < static_cast<float>(kLeastBandPx)) return;
  const Nodes nodes = nodesOf(points, closed, bandPx);
  if (nodes.at.empty()) return;
  const std::vector<Vec2> shift = shifts(nodes, closed, longestPx);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += between(shift, closed, nodes.s[i] / nodes.step);
  // What is shorter than the nodes are apart.
  const std::vector<Vec2> smooth = smoothPolyline(points, closed, kNodePx);
  const int n = static_cast<int>(nodes.room.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = nodes.s[i] / nodes.step;
    const int k = std::clamp(static_cast<int>(place), 0, n - 1),
              next = closed ? wrapIndex(k + 1, n) : std::min(k + 1, n - 1);
    const double part = std::clamp(place - k, 0.0, 1.0);
    const double room =
        (1.0 - part) * nodes.room[static_cast<std::size_t>(k)] + part * nodes.room[static_cast<std::size_t>(next)];
    points[i] += std::min(1.0, room / kSmoothRoomPx) * (smooth[i] - points[i]);
  }
}

}  // namespace batten
