// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/uneven_ink.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/outline/crack_contours.h"
#include "tests/support/brush_ink.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

constexpr double kBarHeight = 240.0;  // px

// Bars of 30 x 240 px, one beside the other.
GreyImage bars(int count, double noise, double blurPx = 0.8) {
  test::RenderSettings s;
  s.width = 60 * count;
  s.height = 280;
  s.blurPx = blurPx;
  s.noise = noise;
  return test::renderShape(
      [](double x, double y) {
        return std::fmod(x, 60.0) >= 15.0 && std::fmod(x, 60.0) < 45.0 && std::fabs(y - 140) < kBarHeight / 2;
      },
      s);
}

ContourSet bordersOn(const GreyImage& grey) {
  const BitImage ink = test::thresholdMask(grey, 150.0);
  ContourSet set = *crackContours(ink, false, 40.0, {});
  noteUnevenInk(set, ink, grey, {});
  return set;
}

TEST(UnevenInk, SolidInkIsEvenWhateverTheScanAddsToIt) {
  for (const double blurPx : {0.8, 2.0, 3.0}) {
    for (const double noise : {0.0, 4.0, 10.0}) {
      const ContourSet set = bordersOn(bars(1, noise, blurPx));
      ASSERT_EQ(set.contours.size(), 1u);
      EXPECT_FALSE(set.contours[0].isUneven) << "noise " << noise << ", blur " << blurPx;
    }
  }
}

TEST(UnevenInk, ADryBrushIsUneven) {
  GreyImage grey = bars(1, 2.0);
  test::dryInk(grey, test::thresholdMask(grey, 150.0), 40.0);
  const ContourSet set = bordersOn(grey);
  ASSERT_EQ(set.contours.size(), 1u);
  EXPECT_TRUE(set.contours[0].isUneven);
}

// What dried less than the others is of the same brush.
TEST(UnevenInk, LessTellsWhereMostBordersAreUneven) {
  const auto page = [](double driest) {
    GreyImage grey = bars(3, 2.0);
    const BitImage ink = test::thresholdMask(grey, 150.0);
    BitImage first = ink, others = ink;
    for (int y = 0; y < ink.height; ++y)
      for (int x = 0; x < ink.width; ++x) (x < 60 ? others : first).set(x, y, false);
    test::dryInk(grey, first, 20.0);
    test::dryInk(grey, others, driest);
    return bordersOn(grey);
  };
  for (const double driest : {0.0, 40.0}) {
    const ContourSet set = page(driest);
    ASSERT_EQ(set.contours.size(), 3u);
    for (const Contour& c : set.contours) {
      const bool isFirst = c.points.front().at.x() < 60.0;
      EXPECT_EQ(c.isUneven, driest > 0.0) << (isFirst ? "the first bar" : "another bar") << ", driest " << driest;
    }
  }
}

TEST(UnevenInk, BordersAtTheEdgeOfThePageAndOfTooFewPixelsAreEven) {
  GreyImage grey(40, 40, 0);
  EXPECT_FALSE(bordersOn(grey).contours.at(0).isUneven);
  ContourSet none;
  noteUnevenInk(none, BitImage(), GreyImage(), {});
  EXPECT_TRUE(none.contours.empty());
}

}  // namespace
}  // namespace batten
