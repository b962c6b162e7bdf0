// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the tones that a page may be shaded with are taken: those that leave the least broad ink.
#include "core/image/tones/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/image/tones/without_tones.h"
#include "tests/support/stress_page.h"
#include "tests/support/tones_on.h"

namespace batten {
namespace {

constexpr int kPanelsWidth = 900, kPanelsHeight = 480;
constexpr double kPanelPaper = 235.0, kPanelTone = 105.0, kPanelLine = 40.0, kPanelLinePx = 4.0;

/// How far a place lies inside an upright rectangle, px.
double insidePanel(double x, double y, double left, double right) {
  return std::min({x - left, right - x, y - 100.0, 380.0 - y});
}

/// A page with two shaded panels that a line is drawn around, another across the left one, and a circle on bare paper.
/// @param fromLine of a place in the panel at the right: the distance from the lines on it, px.
GreyImage panels(const std::function<double(double x, double y)>& fromLine) {
  const auto grey = [&](double x, double y) {
    const double left = insidePanel(x, y, 120.0, 360.0), right = insidePanel(x, y, 540.0, 780.0);
    const double tone = std::max(left, right) > 0.0 ? 1.0 : 0.0;
    double from = std::min({std::abs(left), std::abs(right), std::abs(std::hypot(x - 60.0, y - 240.0) - 35.0)});
    if (left > 0.0) from = std::min(from, std::abs(y - 200.0));
    if (right > 0.0) from = std::min(from, fromLine(x, y));
    const double ground = kPanelPaper + (kPanelTone - kPanelPaper) * tone;
    return from < 0.5 * kPanelLinePx ? kPanelLine : ground;
  };
  const std::vector<float> noInk(std::ptrdiff_t{kPanelsWidth} * kPanelsHeight, 0.0f);
  return test::renderStress(noInk, kPanelsWidth, kPanelsHeight, grey, {1.0, 2.0, 0.8}, 3).grey;
}

constexpr auto oneLine = [](double, double y) { return std::abs(y - 200.0); };
constexpr auto denseLines = [](double x, double) { return std::abs(std::remainder(x - 540.0, 9.0)); };
constexpr auto shadingOn = test::tonesOn<findShading>;

/// Mean grey of the panel at the right, where `isPlace` is true.
double meanAt(const GreyImage& page, const std::function<bool(int x, int y)>& isPlace) {
  double sum = 0.0;
  int count = 0;
  for (int y = 140; y < 340; ++y)
    for (int x = 580; x < 740; ++x)
      if (isPlace(x, y)) sum += page.level(x, y), ++count;
  return sum / count;
}

TEST(Shading, OfAPlainPanelIsItsEvenTone) {
  const GreyImage page = panels(oneLine);
  const auto areas = shadingOn(page, {});
  ASSERT_TRUE(areas);
  const auto beside = [](int, int y) { return y > 210; };
  EXPECT_GT(meanAt(withoutTones(page, *areas, {}), beside), 0.9 * kPanelPaper);
}

// Lines drawn close together cover more than a third of the tone; beside an even tone they are lines all the same.
TEST(Shading, MayBeFullOfLinesBesideAnEvenTone) {
  const GreyImage page = panels(denseLines);
  const auto onlyEven = test::tonesOn<findToneAreas>(page, {});
  ASSERT_TRUE(onlyEven) << "the panel at the left";
  const auto between = [&](int x, int) { return denseLines(x + 0.5, 0.0) > 2.5; };
  const auto onLine = [&](int x, int) { return denseLines(x + 0.5, 0.0) < 0.6; };
  EXPECT_LT(meanAt(withoutTones(page, *onlyEven, {}), between), 0.7 * kPanelPaper);
  const auto areas = shadingOn(page, {});
  ASSERT_TRUE(areas);
  const GreyImage without = withoutTones(page, *areas, {});
  EXPECT_GT(meanAt(without, between), 0.8 * kPanelPaper);
  EXPECT_LT(meanAt(without, onLine), 0.5 * kPanelPaper);
}

TEST(Shading, IsNotLookedForAfterACancel) {
  RunContext context;
  context.cancel.cancel();
  EXPECT_FALSE(shadingOn(panels(oneLine), context));
}

TEST(Shading, IsTheSameWithAnyNumberOfThreads) {
  const GreyImage page = panels(denseLines);
  RunContext one, eight;
  one.threads = 1, eight.threads = 8;
  const auto a = shadingOn(page, one), b = shadingOn(page, eight);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(withoutTones(page, *a, one), withoutTones(page, *b, eight));
}

}  // namespace
}  // namespace batten
