// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_rough_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/construct/typical/typical_path_geometry.h"
#include "core/construct/typical/typical_structure.h"
#include "core/solve/dense_solve.h"

namespace batten {

namespace {

/// A joint bends clearly if its curvature is above this share of the largest and above this sagitta over its segment.
constexpr double kClearShare = 0.06;
constexpr double kClearSagitta = 0.05;  // [px]
/// Turn of a segment at the start.
constexpr double kFirstTurn = 0.7;
/// [rad] Counts as a turn, however straight the span is.
constexpr double kLeastSpanTurn = 1e-6;
/// Joints between two nodes of a stretch without typical curves.
constexpr std::size_t kJointsPerHermite = 12;

class RoughPath {
 public:
  RoughPath(std::span<const Joint> joints, bool closed, std::span<const std::size_t> places)
      : joints_(joints), places_(places) {
    path_.closed = closed;
    path_.states.push_back(state(0, 0.0));
  }

  TypicalPath build() {
    std::size_t at = 0;
    for (const JointRun& run : bendingRuns(joints_)) {
      goTo(at, run.first);
      bend(run);
      at = run.last;
    }
    goTo(at, joints_.size() - 1);
    return std::move(path_);
  }

 private:
  PathState state(std::size_t i, double near) const {
    const double angle = angleBetween(Vec2::UnitX(), joints_[i].tangent);
    return {joints_[i].point, near + std::remainder(angle - near, 2.0 * std::numbers::pi), joints_[i].kappa};
  }
  bool isPlace(std::size_t i) const { return std::binary_search(places_.begin(), places_.end(), i); }

  /// Hermite pieces from joint to joint.
  void goTo(std::size_t from, std::size_t to) {
    if (from >= to) return;
    std::vector<std::size_t> nodes;
    const std::size_t pieces = (to - from + kJointsPerHermite - 1) / kJointsPerHermite;
    for (std::size_t k = 1; k <= pieces; ++k) nodes.push_back(from + k * (to - from) / pieces);
    for (std::size_t i = from + 1; i < to; ++i) {
      if (isPlace(i)) nodes.push_back(i);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const std::size_t node : nodes) {
      PathElement hermite;
      hermite.typical = false;
      path_.elements.push_back(hermite);
      path_.states.push_back(state(node, path_.states.back().angleRad));
    }
  }

  void bend(const JointRun& run) {
    std::vector<double> turned = {0.0};
    for (std::size_t i = run.first; i < run.last; ++i) {
      turned.push_back(turned.back() + std::abs(angleBetween(joints_[i].tangent, joints_[i + 1].tangent)));
    }
    std::vector<std::size_t> nodes;
    const int pieces = static_cast<int>(std::ceil(std::max(1.0, turned.back() / kFirstTurn)));
    if (places_.empty()) {
      for (int k = 1; k < pieces; ++k) {
        const double wanted = turned.back() * k / pieces;
        nodes.push_back(run.first + (std::lower_bound(turned.begin(), turned.end(), wanted) - turned.begin()));
      }
    }
    for (std::size_t i = run.first + 1; i < run.last; ++i) {
      if (isPlace(i)) nodes.push_back(i);
    }
    nodes.push_back(run.last);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.insert(nodes.begin(), run.first);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const std::vector<double> logKappa = evenCurvatures(nodes);
    const double side = joints_[run.first].kappa > 0.0 ? 1.0 : -1.0;
    path_.states.back().kappa = side * std::exp(logKappa[0]);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const double turn = turned[nodes[i + 1] - run.first] - turned[nodes[i] - run.first];
      // More turn than one typical curve can make.
      const int parts = static_cast<int>(std::ceil(std::max(turn, kLeastSpanTurn) / kMostStartTurnRad));
      PathElement element;
      element.side = side;
      element.logTurn = std::log(std::max(0.5 * turn / parts, kLeastStartTurnRad));
      element.shape =
          std::clamp(0.25 * (logKappa[i] - logKappa[i + 1]) / parts, -kMostStartLogRatio, kMostStartLogRatio);
      for (int k = 0; k < parts; ++k) {
        path_.elements.push_back(element);
        path_.states.push_back(state(nodes[i + 1], path_.states.back().angleRad));
      }
    }
  }

  /// Logarithms of the curvature at the nodes of a run, such that every segment is as long as its stretch of the line:
  /// turn over length is the mean curvature. The joints' own curvatures are too noisy for that: their errors would add
  /// up to a path that leaves the line.
  std::vector<double> evenCurvatures(std::span<const std::size_t> nodes) const {
    constexpr double kLength = 10.0, kOwn = 0.3, kEven = 1.0;  // weights: the lengths before all else
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * n);
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const std::size_t at = k;
      a(row, k) = kOwn;
      b(row++) = kOwn * std::log(std::max(std::abs(joints_[nodes[at]].kappa), 1e-9));
      if (k + 1 < n) {
        double length = 0.0, turn = 0.0;
        for (std::size_t i = nodes[at]; i < nodes[at + 1]; ++i) {
          const double part = std::abs(angleBetween(joints_[i].tangent, joints_[i + 1].tangent));
          turn += part;
          length += (joints_[i + 1].point - joints_[i].point).norm() * (1.0 + part * part / 24.0);
        }
        a(row, k) = a(row, k + 1) = 0.5 * kLength;
        b(row++) = kLength * std::log(std::max(turn, 1e-6) / std::max(length, 1e-9));
      }
      if (k > 0 && k + 1 < n) {
        a(row, k - 1) = a(row, k + 1) = kEven;
        a(row++, k) = -2.0 * kEven;
      }
    }
    const Eigen::VectorXd x = leastSquares(a.topRows(row), b.head(row));
    return {x.data(), x.data() + x.size()};
  }

  std::span<const Joint> joints_;
  std::span<const std::size_t> places_;
  TypicalPath path_;
};

}  // namespace

std::vector<JointRun> bendingRuns(std::span<const Joint> joints) {
  double largest = 0.0;
  for (const Joint& j : joints) largest = std::max(largest, std::abs(j.kappa));
  const auto sign = [&](std::size_t i) {
    const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, joints.size() - 1);
    const double reach =
        (joints[b].point - joints[a].point).norm() / static_cast<double>(std::max<std::size_t>(1, b - a));
    const double least = std::max(kClearShare * largest, 8.0 * kClearSagitta / (reach * reach));
    return joints[i].kappa > least ? 1 : joints[i].kappa < -least ? -1 : 0;
  };
  std::vector<JointRun> runs;
  for (std::size_t i = 0; i < joints.size();) {
    std::size_t end = i;
    while (end + 1 < joints.size() && sign(end + 1) == sign(i) &&
           angleBetween(joints[end].tangent, joints[end + 1].tangent) * sign(i) > 0.0) {
      ++end;
    }
    if (sign(i) != 0 && end >= i + 1) runs.push_back({i, end});
    i = end + 1;
  }
  return runs;
}

TypicalPath roughTypicalPath(std::span<const Joint> joints, bool closed, std::span<const std::size_t> places) {
  return RoughPath(joints, closed, places).build();
}

}  // namespace batten
