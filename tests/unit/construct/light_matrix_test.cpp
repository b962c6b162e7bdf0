// SPDX-License-Identifier: GPL-3.0-or-later
// The band of a long curve's normal equations against the whole matrix, solved by Eigen.
#include "core/construct/light/light_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/construct/light/span_system.h"

namespace batten {
namespace {

constexpr int kDegree = 5;
constexpr double kDamping = 0.25;

LightShape shapeOf(int spans, bool closed) {
  LightShape shape;
  shape.degree = kDegree;
  shape.closed = closed;
  shape.logLengths.assign(spans, 0.0);
  shape.points.assign(closed ? spans : spans + kDegree, Vec2::Zero());
  return shape;
}

/// What a span depends on: x and y of its control points, and the lengths within reach.
std::vector<int> unknownsOf(const LightShape& shape, int span) {
  std::vector<int> unknowns;
  const int spans = shape.spans(), points = static_cast<int>(shape.points.size());
  for (int j = 0; j <= kDegree; ++j) {
    const int point = static_cast<int>(shape.pointOf(span, j));
    unknowns.push_back(2 * point);
    unknowns.push_back(2 * point + 1);
  }
  for (int k = -kLengthReach; k <= kLengthReach; ++k) {
    const int other = shape.closed ? (span + k + spans) % spans : span + k;
    if (other >= 0 && other < spans) unknowns.push_back(2 * points + other);
  }
  return unknowns;
}

void expectSolvesAsDense(const LightShape& shape) {
  LightMatrix matrix(shape, true);
  const Eigen::Index n = matrix.unknowns();
  ASSERT_EQ(n, 2 * std::ssize(shape.points) + shape.spans());
  Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(n, n);
  matrix.setZero();
  for (Eigen::Index i = 0; i < n; ++i) matrix.add(i, i, 1.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int span = 0; span < shape.spans(); ++span) {
    const std::vector<int> at = unknownsOf(shape, span);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    for (const int i : at) row[i] = any(random);
    for (std::size_t a = 0; a < at.size(); ++a) {
      for (const int other : at) whole(at[a], other) += row[at[a]] * row[other];
      for (std::size_t b = 0; b <= a; ++b) matrix.add(at[a], at[b], row[at[a]] * row[at[b]]);
    }
  }
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) right[i] = any(random);
  const auto solution = matrix.solveDamped(kDamping, right);
  ASSERT_TRUE(solution);
  whole.diagonal() *= 1.0 + kDamping;
  const Eigen::VectorXd expected = whole.ldlt().solve(right);
  EXPECT_LT((*solution - expected).norm(), 1e-10 * expected.norm());
}

TEST(LightMatrix, OfALongCurveIsSolvedAsTheWholeMatrix) {
  expectSolvesAsDense(shapeOf(180, false));
  expectSolvesAsDense(shapeOf(180, true));
}

TEST(LightMatrix, OfAShortCurveToo) {
  expectSolvesAsDense(shapeOf(40, false));
  expectSolvesAsDense(shapeOf(40, true));
}

TEST(LightMatrix, ThatIsNotPositiveDefiniteIsNotSolved) {
  for (const int spans : {40, 180}) {
    const LightShape shape = shapeOf(spans, false);
    LightMatrix matrix(shape, true);
    matrix.setZero();
    for (Eigen::Index i = 0; i < matrix.unknowns(); ++i) matrix.add(i, i, i == 30 ? -1.0 : 1.0);
    EXPECT_FALSE(matrix.solveDamped(kDamping, Eigen::VectorXd::Ones(matrix.unknowns())));
  }
}

}  // namespace
}  // namespace batten
