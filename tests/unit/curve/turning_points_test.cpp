// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/turning_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

TEST(TurningPoints, AreTheMaximaAndMinimaOfAWave) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(std::sin(0.004 * std::numbers::pi * i));  // two periods
  const auto found = turningPoints(values, 0.1, TurningStart::AtEnd);
  ASSERT_EQ(found.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(found[k].index, 125 + 250 * k);
    EXPECT_EQ(found[k].maximum, k % 2 == 0);
  }
}

TEST(TurningPoints, RipplesBelowTheProminenceAreNone) {
  const std::vector<double> values = {0, 1, 0.95, 2, 1.95, 3, 1, 1.04, 0};
  const auto found = turningPoints(values, 0.06, TurningStart::AtEnd);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].index, 5);
  EXPECT_EQ(turningPoints(values, 0.045, TurningStart::AtEnd).size(), 5u);
  EXPECT_TRUE(turningPoints(values, 5.0, TurningStart::AtEnd).empty());
  EXPECT_TRUE(turningPoints({}, 0.1, TurningStart::AtEnd).empty());
}

TEST(TurningPoints, AClosedSequenceBeginsOnAMaximumThatCounts) {
  const std::vector<double> values = {3, 0, 2, 1, 3};
  const auto closed = turningPoints(values, 0.5, TurningStart::OnMaximum);
  ASSERT_EQ(closed.size(), 4u);
  EXPECT_EQ(closed[0].index, 0);
  EXPECT_EQ(turningPoints(values, 0.5, TurningStart::AtEnd).size(), 3u);
}

}  // namespace
}  // namespace batten
