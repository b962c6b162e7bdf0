// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/extremum_indices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace batten {
namespace {

TEST(ExtremumIndices, AreTheMaximaAndMinimaOfAWave) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(std::sin(0.004 * std::numbers::pi * i));  // two periods
  const auto found = extremumIndices(values, 0.1, SequenceStart::AtEnd);
  ASSERT_EQ(found.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(found[k].index, 125 + 250 * k);
    EXPECT_EQ(found[k].maximum, k % 2 == 0);
  }
}

TEST(ExtremumIndices, RipplesBelowTheProminenceAreNone) {
  const std::vector<double> values = {0, 1, 0.95, 2, 1.95, 3, 1, 1.04, 0};
  const auto found = extremumIndices(values, 0.06, SequenceStart::AtEnd);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].index, 5);
  EXPECT_EQ(extremumIndices(values, 0.045, SequenceStart::AtEnd).size(), 5u);
  EXPECT_TRUE(extremumIndices(values, 5.0, SequenceStart::AtEnd).empty());
  EXPECT_TRUE(extremumIndices({}, 0.1, SequenceStart::AtEnd).empty());
}

TEST(ExtremumIndices, AClosedSequenceBeginsOnAMaximumThatCounts) {
  const std::vector<double> values = {3, 0, 2, 1, 3};
  const auto closed = extremumIndices(values, 0.5, SequenceStart::OnMaximum);
  ASSERT_EQ(closed.size(), 4u);
  EXPECT_EQ(closed[0].index, 0);
  EXPECT_EQ(extremumIndices(values, 0.5, SequenceStart::AtEnd).size(), 3u);
}

TEST(ExtremumIndices, AreCountedBeyondTheProminence) {
  const std::vector<double> values = {0.0, 1.0, 0.95, 2.0, 1.0, 1.5, 1.45, 3.0};
  EXPECT_EQ(countExtrema(values, 0.1, false), 2);
  EXPECT_EQ(countExtrema(values, 0.01, false), 6);
  EXPECT_EQ(countExtrema(values, 5.0, false), 0);
  EXPECT_EQ(countExtrema({}, 0.1, false), 0);
  EXPECT_EQ(countExtrema({}, 0.1, true), 0);
  EXPECT_EQ(countExtrema(std::vector<double>{1.0}, 0.1, true), 0);
}

// Of a closed sequence the count is the same from wherever one begins, and even.
TEST(ExtremumIndices, OfAClosedSequenceDoNotDependOnItsBegin) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> values(1 + trial);
    for (double& value : values) value = any(random);
    for (const double prominence : {0.0, 0.3, 1.0, 1.9}) {
      // Twice around: what the second time adds is what one time has, wherever the walk found its direction.
      std::vector<double> laps;
      for (int lap = 0; lap < 3; ++lap) laps.insert(laps.end(), values.begin(), values.end());
      const std::span<const double> twice(laps.data(), 2 * values.size());
      const int added = countExtrema(laps, prominence, false) - countExtrema(twice, prominence, false);
      for (std::size_t k = 0; k < values.size(); ++k) {
        EXPECT_EQ(countExtrema(values, prominence, true), added) << trial << " " << prominence;
        std::rotate(values.begin(), values.begin() + 1, values.end());
      }
    }
  }
}

}  // namespace
}  // namespace batten
