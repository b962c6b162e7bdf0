// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/interpolation.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

double plane(int column, int row) { return 3.0 * column - 2.0 * row + 0.5 * column * row + 1.0; }

TEST(BilinearPlace, HasTheValuesOfABilinearFunctionBetweenThem) {
  for (double u = 0.0; u <= 4.0; u += 0.25) {
    for (double v = 0.0; v <= 2.0; v += 0.25) {
      const BilinearPlace place(5, 3, u, v);
      const double expected = 3.0 * u - 2.0 * v + 0.5 * u * v + 1.0;
      EXPECT_NEAR(place.of(plane), expected, 1e-12) << u << ", " << v;
      EXPECT_NEAR(place.of(plane, FastBetween()), expected, 1e-12) << u << ", " << v;
    }
  }
}

TEST(BilinearPlace, OutsideIsTheNearestPlaceInside) {
  const auto at = [](double u, double v) { return BilinearPlace(5, 3, u, v).of(plane); };
  EXPECT_EQ(at(-7.0, 1.5), at(0.0, 1.5));
  EXPECT_EQ(at(99.0, 1.5), at(4.0, 1.5));
  EXPECT_EQ(at(2.25, -1.0), at(2.25, 0.0));
  EXPECT_EQ(at(2.25, 2.5), at(2.25, 2.0));
  EXPECT_EQ(at(99.0, 99.0), plane(4, 2));
}

TEST(BilinearPlace, ReadsOneValueAloneToo) {
  const BilinearPlace place(1, 1, 0.4f, -0.4f);
  EXPECT_EQ(place.of([](int column, int row) { return column == 0 && row == 0 ? 7.0f : -1.0f; }, FastBetween()), 7.0f);
}

TEST(ExactBetween, IsExactAtBothEnds) {
  EXPECT_EQ(ExactBetween()(0.1, 0.7, 0.0), 0.1);
  EXPECT_EQ(ExactBetween()(0.1, 0.7, 1.0), 0.7);
}

TEST(LinearBetween, GoesOnStraightBeyondTheLastValues) {
  const std::vector<double> values{1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(linearBetween(values, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(linearBetween(values, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(linearBetween(values, -1.0), -1.0);
  EXPECT_DOUBLE_EQ(linearBetween(values, 3.0), 1.0);
}

}  // namespace
}  // namespace batten
