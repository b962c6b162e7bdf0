// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace batten;

std::vector<double> shuffled(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 2.0);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(normal(random));
  return values;
}

TEST(Statistics, RanksAreThoseOfTheSortedValues) {
  for (const int count : {1, 2, 5, 6, 101}) {
    const std::vector<double> values = shuffled(count, 7u);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (int rank = 0; rank < count; ++rank) EXPECT_EQ(elementOfRank(std::vector<double>(values), rank), sorted[rank]);
  }
}

TEST(Statistics, TheMedianOfAnEvenNumberIsTheUpperOfTheTwoInTheMiddle) {
  EXPECT_EQ(upperMedian(std::vector<int>{4, 1, 3, 2}), 3);
  EXPECT_EQ(upperMedian(std::array<float, 3>{9.0f, -1.0f, 2.0f}), 2.0f);
  EXPECT_EQ(upperMedian(std::vector<double>{8.5}), 8.5);
}

TEST(Statistics, QuantilesGoFromTheLeastToTheGreatest) {
  const std::vector<int> values = {50, 10, 40, 20, 30};
  EXPECT_EQ(lowerQuantile(std::vector<int>(values), 0.0), 10);
  EXPECT_EQ(lowerQuantile(std::vector<int>(values), 0.49), 20);
  EXPECT_EQ(lowerQuantile(std::vector<int>(values), 0.5), 30);
  EXPECT_EQ(lowerQuantile(std::vector<int>(values), 1.0), 50);
  EXPECT_EQ(lowerQuantile(std::vector<int>{2, 1}, 0.5), 1);
}

TEST(Statistics, TheRobustSigmaIsThatOfANormalVariableAndIgnoresStrays) {
  std::vector<double> values = shuffled(20001, 3u);
  EXPECT_NEAR(robustSigma(std::vector<double>(values)), 2.0, 0.05);
  for (int i = 0; i < 1000; ++i) values.push_back(1e6);
  EXPECT_NEAR(robustSigma(values), 2.0, 0.2);
  EXPECT_EQ(robustSigma(std::vector<double>{}), 0.0);
}

}  // namespace
