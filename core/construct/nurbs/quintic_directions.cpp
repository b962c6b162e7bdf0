// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/nurbs/quintic_directions.h"

#include <array>
#include <cmath>

#include "core/curve/spline_space.h"
#include "core/solve/banded_least_squares.h"
#include "core/solve/gauss_legendre.h"

namespace batten {

namespace {

constexpr int kDegree = 5;       // of the curve
constexpr double kPinned = 1e7;  // weight of a pinned end: what is left of its misfit is smaller by the square, 1e-14

/// x and y of a control point are neighbouring unknowns: the normal rows tie them together.
class System {
 public:
  explicit System(std::size_t stations)
      : space_(splineSpace(kDegree, uniformPlaces(stations, false), false)),
        system_(2 * space_.unknowns, 2 * (kDegree + 1), false) {}

  /// weight * (toward . R^(order)(u) - right) as one row.
  void add(double u, int order, const Vec2& toward, double right, double weight) {
    const BasisRow basisRow = space_.row(u, order);
    std::array<double, 2 * (kDegree + 1)> row{};
    for (std::size_t j = 0; j <= kDegree; ++j) {
      const double value = weight * basisRow.values[order][j];
      row[2 * j] = value * toward.x();
      row[2 * j + 1] = value * toward.y();
    }
    system_.add(2 * basisRow.first, row, Vec2(weight * right, 0.0));
  }

  std::optional<std::vector<Vec2>> solve() const {
    const auto flat = system_.solve();
    if (!flat) return std::nullopt;
    std::vector<Vec2> points;
    for (std::size_t i = 0; i + 1 < flat->size(); i += 2) points.emplace_back((*flat)[i].x(), (*flat)[i + 1].x());
    return points;
  }

 private:
  SplineSpace space_;
  BandedLeastSquares system_;
};

}  // namespace

Result<std::vector<Vec2>> solveQuinticDirections(std::span<const Vec2> points, std::span<const Vec2> directions,
                                                 std::span<const double> magnitudes, const DirectionWeights& weights) {
  const std::size_t m = points.size();
  if (m < 4 || directions.size() != m || magnitudes.size() != m) {
    return fail(ErrorCode::Numerical, "There are too few stations for a quintic curve: choose more segments.");
  }
  System system(m);
  for (std::size_t i = 0; i < m; ++i) {
    const double u = static_cast<double>(i);
    const bool pinned = weights.pinEnds && (i == 0 || i + 1 == m);
    system.add(u, 0, Vec2::UnitX(), points[i].x(), pinned ? kPinned : 1.0);
    system.add(u, 0, Vec2::UnitY(), points[i].y(), pinned ? kPinned : 1.0);
    system.add(u, 1, leftNormal(directions[i]), 0.0, 1.0);
    system.add(u, 1, directions[i], magnitudes[i], weights.along);
  }
  // |R'''|^2 is of degree 4 in every span: three Gauss points are exact.
  static constexpr auto kRule = gaussLegendre<3>(0.0, 1.0);
  for (std::size_t i = 0; i + 1 < m; ++i) {
    for (std::size_t g = 0; g < kRule.node.size(); ++g) {
      const double u = static_cast<double>(i) + kRule.node[g];
      const double weight = std::sqrt(weights.smoothness * kRule.weight[g]);
      system.add(u, 3, Vec2::UnitX(), 0.0, weight);
      system.add(u, 3, Vec2::UnitY(), 0.0, weight);
    }
  }
  auto solution = system.solve();
  if (!solution) return fail(ErrorCode::Numerical, "The equations of the curve have no single solution.");
  return std::move(*solution);
}

}  // namespace batten
