// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "core/solve/banded_cholesky.h"
#include "core/solve/banded_matrix.h"
#include "core/solve/column_cholesky.h"

namespace batten {
namespace {

struct Both {
  BandedMatrix band;
  Eigen::MatrixXd dense;
};

Both randomSystem(int n, bool cyclic, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Both m{BandedMatrix(n, BandRow::kHalfWidth, cyclic), Eigen::MatrixXd::Zero(n, n)};
  for (int i = 0; i < n; ++i) m.dense(i, i) = m.band.entry(i, 0) = 0.5;
  for (int first = 0; first < (cyclic ? n : n - 5); ++first) {
    for (int repeat = 0; repeat < 3; ++repeat) {
      BandRow row;
      row.first = first;
      Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
      for (int k = 0; k < 6; ++k) {
        row.v[k] = normal(random);
        full[(first + k) % n] += row.v[k];
      }
      m.band.addOuter(row, 0.7);
      m.dense += 0.7 * full * full.transpose();
    }
  }
  return m;
}

class Banded : public testing::TestWithParam<std::pair<int, bool>> {};

TEST_P(Banded, AgreesWithTheDenseMatrix) {
  const auto [n, cyclic] = GetParam();
  const Both m = randomSystem(n, cyclic, 7);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0).array().sin();
  EXPECT_LT((m.band * x - m.dense * x).norm(), 1e-12 * m.dense.norm());
  BandedCholesky cholesky;
  ASSERT_TRUE(cholesky.factor(m.band));
  const Eigen::VectorXd solved = cholesky.solve(x);
  const Eigen::VectorXd reference = m.dense.ldlt().solve(x);
  EXPECT_LT((solved - reference).norm(), 1e-9 * reference.norm());
}

/// Without small cyclic matrices, whose places in the band coincide.
class BandedInverse : public Banded {};

TEST_P(BandedInverse, WithinTheBandEqualsTheDenseInverse) {
  const auto [n, cyclic] = GetParam();
  const Both m = randomSystem(n, cyclic, 8);
  BandedCholesky cholesky;
  ASSERT_TRUE(cholesky.factor(m.band));
  const BandedMatrix inverse = cholesky.inverseBand();
  const Eigen::MatrixXd reference = m.dense.inverse();
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k <= 5 && (cyclic || i + k < n); ++k) {
      EXPECT_NEAR(inverse.entry(i, k), reference(i, (i + k) % n), 1e-9 * reference.norm()) << i << " " << k;
    }
  }
  BandRow row{cyclic ? n - 2 : n - 6, {1.0, -2.0, 0.5, 3.0, -1.0, 0.25}};
  Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
  addTo(full, row, 1.0);
  EXPECT_NEAR(BandedCholesky::quadratic(inverse, row), full.dot(reference * full), 1e-8 * reference.norm());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Banded,
                         testing::Values(std::pair{6, false}, std::pair{7, false}, std::pair{40, false},
                                         std::pair{7, true}, std::pair{11, true}, std::pair{12, true},
                                         std::pair{41, true}));

INSTANTIATE_TEST_SUITE_P(Sizes, BandedInverse,
                         testing::Values(std::pair{6, false}, std::pair{7, false}, std::pair{40, false},
                                         std::pair{11, true}, std::pair{12, true}, std::pair{41, true}));

TEST(ColumnCholesky, AgreesWithTheDenseMatrix) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int halfWidth : {0, 1, 2, 3, 4, 6, 11, 13, 25}) {
    for (const int n : {halfWidth + 1, halfWidth + 2, 2 * halfWidth + 1, 60, 61}) {
      Both m{BandedMatrix(n, halfWidth, false), Eigen::MatrixXd::Zero(n, n)};
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k <= halfWidth && i + k < n; ++k) {
          const double value = k == 0 ? 4.0 * halfWidth + 1.0 + std::abs(normal(random)) : normal(random);
          m.band.entry(i, k) = m.dense(i, i + k) = m.dense(i + k, i) = value;
        }
      }
      ColumnCholesky cholesky;
      ASSERT_TRUE(cholesky.factor(m.band, 1e-15)) << halfWidth << " of " << n;
      Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0).array().sin();
      const Eigen::VectorXd reference = m.dense.ldlt().solve(x);
      cholesky.solveInPlace(x);
      EXPECT_LT((x - reference).norm(), 1e-12 * reference.norm()) << halfWidth << " of " << n;
      for (const int bad : {n - 1, n / 2, 0}) {
        BandedMatrix wrong = m.band;
        wrong.entry(bad, 0) = -1.0;
        EXPECT_FALSE(ColumnCholesky().factor(wrong, 0.0)) << halfWidth << " of " << n << " at " << bad;
      }
    }
  }
}

TEST(BandedMatrix, RefusesWhatIsNotPositiveDefinite) {
  BandedMatrix m(8, BandRow::kHalfWidth, false);
  for (int i = 0; i < 8; ++i) m.entry(i, 0) = i == 5 ? -1.0 : 1.0;
  EXPECT_FALSE(BandedCholesky().factor(m));
}

TEST(BandedMatrix, BlockIsTheOpenPartOfACyclicMatrix) {
  const Both m = randomSystem(30, true, 9);
  const BandedMatrix part = m.band.block(24, 12);
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k <= 5 && i + k < 12; ++k) {
      EXPECT_DOUBLE_EQ(part.entry(i, k), m.band.entry((24 + i) % 30, k));
    }
  }
}

}  // namespace
}  // namespace batten
