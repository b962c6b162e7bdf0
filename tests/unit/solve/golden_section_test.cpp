// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/golden_section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

TEST(GoldenSection, FindsTheLeastValueOfFunctionsWithOneMinimum) {
  const ValueAt bowl = goldenSection([](double x) { return (x - 1.3) * (x - 1.3) + 2.0; }, 0.0, 4.0, 30);
  EXPECT_NEAR(bowl.at, 1.3, 4.0 * std::pow(0.6181, 30));
  EXPECT_NEAR(bowl.value, 2.0, 1e-9);
  const ValueAt kink =
      goldenSection([](double x) { return std::abs(x + 0.25); }, -1.0, 1.0, 30);  // no derivative there
  EXPECT_NEAR(kink.at, -0.25, 2.0 * std::pow(0.6181, 30));
}

TEST(GoldenSection, GoesToTheLowerEndWhereThereIsNoMinimumInside) {
  EXPECT_NEAR(goldenSection([](double x) { return x; }, 2.0, 5.0, 30).at, 2.0, 3.0 * std::pow(0.6181, 30));
  EXPECT_NEAR(goldenSection([](double x) { return -x; }, 2.0, 5.0, 30).at, 5.0, 3.0 * std::pow(0.6181, 30));
}

TEST(GoldenSection, LooksAtTwoPlacesAndOneMoreAStep) {
  int looks = 0;
  const auto counted = [&](double x) {
    ++looks;
    return x * x;
  };
  goldenSection(counted, -1.0, 1.0, 20);
  EXPECT_EQ(looks, 22);
  EXPECT_EQ(goldenSection(counted, 3.0, 3.0, 5).at, 3.0);
}

}  // namespace
}  // namespace batten
