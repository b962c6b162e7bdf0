// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/dense_solve.h"

#include <gtest/gtest.h>

#include <random>

namespace batten {
namespace {

Eigen::MatrixXd randomMatrix(int rows, int columns, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = normal(random);
  return m;
}

TEST(DenseSolve, LeastSquaresLeavesAResidualAtRightAnglesToTheColumns) {
  for (const int columns : {1, 4, 9}) {
    const Eigen::MatrixXd a = randomMatrix(12, columns, 3);
    const Eigen::VectorXd b = randomMatrix(12, 1, 4);
    const Eigen::VectorXd x = leastSquares(a, b);
    ASSERT_EQ(x.size(), columns);
    EXPECT_LT((a.transpose() * (a * x - b)).norm(), 1e-12 * a.norm() * b.norm());
  }
}

TEST(DenseSolve, LeastSquaresTakesColumnsThatDependOnEachOther) {
  Eigen::MatrixXd a = randomMatrix(8, 3, 5);
  a.col(2) = 2.0 * a.col(0) - a.col(1);
  const Eigen::VectorXd b = randomMatrix(8, 1, 6);
  const Eigen::VectorXd x = leastSquares(a, b);
  EXPECT_LT((a.transpose() * (a * x - b)).norm(), 1e-10);
}

TEST(DenseSolve, NullSpaceIsOrthonormalAndMeetsEveryCondition) {
  for (const int rows : {1, 3, 6}) {
    const Eigen::MatrixXd conditions = randomMatrix(rows, 7, 7);
    const Eigen::MatrixXd z = nullSpace(conditions);
    ASSERT_EQ(z.rows(), 7);
    ASSERT_EQ(z.cols(), 7 - rows);
    EXPECT_LT((conditions * z).norm(), 1e-12);
    EXPECT_LT((z.transpose() * z - Eigen::MatrixXd::Identity(7 - rows, 7 - rows)).norm(), 1e-12);
  }
}

TEST(DenseSolve, AConditionSaidTwiceCountsOnce) {
  Eigen::MatrixXd conditions = randomMatrix(2, 5, 8);
  conditions.row(1) = -3.0 * conditions.row(0);
  const Eigen::MatrixXd z = nullSpace(conditions);
  EXPECT_EQ(z.cols(), 4);
  EXPECT_LT((conditions * z).norm(), 1e-12);
}

TEST(DenseSolve, SymmetricSystemsAreSolvedColumnByColumn) {
  const Eigen::MatrixXd half = randomMatrix(6, 6, 9), b = randomMatrix(6, 3, 10);
  const Eigen::MatrixXd a = half * half.transpose();
  EXPECT_LT((a * solveSymmetric(a, b) - b).norm(), 1e-8 * b.norm());
}

}  // namespace
}  // namespace batten
