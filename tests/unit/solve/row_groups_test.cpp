// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/row_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace batten {
namespace {

constexpr int kUnknowns = 40;

/// Rows over 12 unknowns, as those of a quintic's knot span, over fewer and over more, and a dense matrix of the same.
struct Rows {
  RowGroups groups;
  Eigen::MatrixXd dense;

  explicit Rows(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Eigen::VectorXd> all;
    for (const int size : {12, 12, 5, 12, 17, 1, 12}) {
      std::vector<int> index(kUnknowns);
      for (int i = 0; i < kUnknowns; ++i) index[i] = i;
      std::shuffle(index.begin(), index.end(), random);
      index.resize(size);
      std::sort(index.begin(), index.end());
      for (int repeat = 0; repeat < 1 + size % 5; ++repeat) {
        std::vector<double> values;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(kUnknowns);
        for (const int i : index) row[i] = -3.0 * values.emplace_back(normal(random));
        groups.add(index, values, -3.0);
        all.push_back(row);
      }
    }
    dense.resize(std::ssize(all), kUnknowns);
    for (Eigen::Index i = 0; i < dense.rows(); ++i) dense.row(i) = all[i].transpose();
  }
};

Eigen::VectorXd numbers(Eigen::Index count) {
  Eigen::VectorXd v(count);
  for (Eigen::Index i = 0; i < count; ++i) v[i] = std::sin(1.0 + 2.0 * static_cast<double>(i));
  return v;
}

TEST(RowGroups, MultiplyAsADenseMatrixDoes) {
  const Rows rows(7);
  ASSERT_EQ(rows.groups.count(), rows.dense.rows());
  const Eigen::VectorXd x = numbers(kUnknowns), w = numbers(rows.dense.rows());
  EXPECT_LT((rows.groups.times(x) - rows.dense * x).norm(), 1e-13);
  Eigen::VectorXd sum = x;
  rows.groups.addTransposed(w, sum);
  EXPECT_LT((sum - x - rows.dense.transpose() * w).norm(), 1e-13);
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    EXPECT_NEAR(rows.groups.dot(i, x), rows.dense.row(i).dot(x), 1e-13) << i;
    Eigen::VectorXd one = x;
    rows.groups.addTo(one, i, 0.5);
    EXPECT_LT((one - x - 0.5 * rows.dense.row(i).transpose()).norm(), 1e-13) << i;
  }
}

TEST(RowGroups, AddTheirOuterProductsWithinTheirWidth) {
  const Rows rows(8);
  const Eigen::VectorXd w = numbers(rows.dense.rows());
  const Eigen::MatrixXd expected = rows.dense.transpose() * w.asDiagonal() * rows.dense;
  BandedMatrix m(kUnknowns, rows.groups.width(), false);
  rows.groups.addOuter(w, m);
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = i; j < kUnknowns; ++j) {
      const double entry = j - i <= m.halfWidth() ? m.entry(i, j - i) : 0.0;
      EXPECT_NEAR(entry, expected(i, j), 1e-12) << i << ", " << j;
    }
  }
}

TEST(RowGroups, AreScaledRowByRow) {
  Rows rows(9);
  const Eigen::VectorXd x = numbers(kUnknowns), before = rows.groups.times(x);
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(before.size());
  rows.groups.scale([](std::span<const int> index, std::span<const double> values) { return index[0] + values[0]; },
                    [&](Eigen::Index row, double factor) { factors[row] = factor; });
  EXPECT_LT((rows.groups.times(x) - factors.cwiseProduct(before)).norm(), 1e-12);
  for (Eigen::Index i = 0; i < factors.size(); ++i) {
    Eigen::Index first = 0;
    while (rows.dense(i, first) == 0.0) ++first;
    EXPECT_DOUBLE_EQ(factors[i], static_cast<double>(first) + rows.dense(i, first)) << i;
  }
}

}  // namespace
}  // namespace batten
