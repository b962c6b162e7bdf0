// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/packed_rows.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace batten {
namespace {

class RandomRows {
 public:
  explicit RandomRows(std::uint32_t seed) : random_(seed) {}

  Eigen::VectorXd vector(Eigen::Index count) {
    Eigen::VectorXd v(count);
    for (double& x : v) x = normal_(random_);
    return v;
  }
  BandRow row(int first) {
    BandRow row;
    row.first = first;
    for (double& v : row.v) v = normal_(random_);
    return row;
  }
  /// As programs have them: some at each span, most spans one after the other, some left out and some twice.
  std::vector<BandRow> rows(int unknowns, bool cyclic) {
    std::vector<BandRow> rows;
    const int spans = cyclic ? unknowns : unknowns - 5;
    for (int span = 0; span < spans; span += 1 + (random_() % 5 == 0)) {
      for (int i = 0, count = static_cast<int>(random_() % 10); i < count; ++i) rows.push_back(row(span));
      if (random_() % 7 == 0) rows.push_back(row(static_cast<int>(random_() % static_cast<unsigned>(spans))));
    }
    return rows;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

TEST(PackedRows, GivesTheBitsOfOneRowAfterTheOther) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const bool cyclic = seed % 3 == 0;
    const int n = 12 + static_cast<int>(seed % 17);
    RandomRows random(seed);
    const std::vector<BandRow> rows = random.rows(n, cyclic);
    const PackedRows packed(rows, n);
    const Eigen::VectorXd x = random.vector(n), weight = random.vector(std::ssize(rows));
    ASSERT_EQ(packed.count(), std::ssize(rows));

    Eigen::VectorXd products;
    packed.times(x, products);
    Eigen::VectorXd sum = x, expected = x;
    packed.addTransposed(weight, sum);
    BandedMatrix m(n, BandRow::kHalfWidth, cyclic), byRow = m;
    for (int i = 0; i < n; ++i) m.addOuter(random.row(cyclic ? i : i % (n - 5)), 1.0);
    byRow = m;
    packed.addOuter(weight, m);
    for (int i = 0; i < std::ssize(rows); ++i) {
      EXPECT_EQ(products[i], dot(rows[i], x)) << seed << ' ' << i;
      addTo(expected, rows[i], weight[i]);
      byRow.addOuter(rows[i], weight[i]);
    }
    EXPECT_EQ(sum, expected) << seed;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k <= BandRow::kHalfWidth; ++k) EXPECT_EQ(m.entry(i, k), byRow.entry(i, k)) << seed;
  }
}

TEST(PackedRows, NoRowsChangeNothing) {
  const PackedRows packed({}, 9);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(9), products;
  packed.addTransposed(Eigen::VectorXd(), x);
  packed.times(x, products);
  EXPECT_EQ(x, Eigen::VectorXd::Ones(9));
  EXPECT_EQ(products.size(), 0);
}

/// Fours of `rows` as the kernels take them.
struct KernelRows {
  std::vector<double> rows, lanes;
  std::vector<RowFour> fours;
  RowFours view() const { return {fours.data(), static_cast<int>(fours.size()), rows.data(), lanes.data()}; }
};

KernelRows kernelRows(RandomRows& random, int spans) {
  KernelRows made;
  int row = 0;
  for (int span = 0; span < spans; ++span) {
    for (const int count : {4, 4, 1 + span % 4}) {
      made.fours.push_back({span, row, count});
      made.lanes.resize(made.lanes.size() + RowFours::kLaneStride, 0.0);
      for (int i = 0; i < count; ++i, ++row) {
        const BandRow values = random.row(span);
        made.rows.resize(made.rows.size() + RowFours::kRowStride, 0.0);
        for (int k = 0; k < RowFours::kWidth; ++k) {
          made.rows[row * RowFours::kRowStride + k] = values.v[k];
          made.lanes[made.lanes.size() - (RowFours::kLaneStride - RowFours::kLanes * k - i)] = values.v[k];
        }
      }
    }
  }
  return made;
}

TEST(BandKernels, TheFastestGiveTheBitsOfThePlain) {
  RandomRows random(7);
  constexpr int kSpans = 30, kUnknowns = kSpans + 5;
  const KernelRows rows = kernelRows(random, kSpans);
  const Eigen::Index count = std::ssize(rows.rows) / RowFours::kRowStride;
  const Eigen::VectorXd x = random.vector(kUnknowns), weight = random.vector(count),
                        matrix = random.vector(kUnknowns * RowFours::kWidth);
  const auto results = [&](const BandKernels& kernels) {
    Eigen::VectorXd products(count), sum = x, m = matrix;
    kernels.times(rows.view(), x.data(), products.data());
    kernels.addTransposed(rows.view(), weight.data(), sum.data());
    kernels.addOuter(rows.view(), weight.data(), m.data());
    return std::vector<Eigen::VectorXd>{products, sum, m};
  };
  EXPECT_EQ(results(plainBandKernels()), results(bandKernels()));
}

}  // namespace
}  // namespace batten
