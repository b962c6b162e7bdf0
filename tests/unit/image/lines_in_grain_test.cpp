// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/lines_in_grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/image/bits/bit_steps.h"
#include "core/image/plane.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

using Picture = std::function<double(double, double)>;  ///< [grey] at a place in px.

constexpr double kGrain = 10.0;  ///< [grey] Standard deviation of a pixel of rough paper.

/// Darkness of one stroke of `width` px along a distance function.
double strokeAt(double distance, double width, double dark) {
  return dark * 0.5 * std::erfc((std::fabs(distance) - 0.5 * width) / std::sqrt(2.0));
}

double darkRing(double x, double y) { return strokeAt(std::hypot(x - 200.0, y - 300.0) - 120.0, 7.0, 90.0); }
double paleArc(double x, double y) { return std::hypot(x - 560.0, y - 900.0) - 640.0; }
double paleStroke(double x, double y) { return x > 380.0 && x < 760.0 ? paleArc(x, y) : 1000.0; }

/// A page of 800 x 600 px, in whose paper lies as much grain as is given.
GreyImage pageOf(const Picture& dark, const Picture& grainAt) {
  constexpr double kVariance = 1.5;  // [px^2] of the Gaussian that the grain is smoothed by
  Plane noise(800, 600);
  std::mt19937 random(11);
  std::normal_distribution<float> any(0.0f, 1.0f);
  for (int y = 0; y < noise.height; ++y)
    for (int x = 0; x < noise.width; ++x) noise.row(y)[x] = any(random);
  const Plane grain = smooth(noise, gaussianKernel(kVariance), {});
  const double gain = std::sqrt(4.0 * std::numbers::pi * kVariance);  // the variance of each pixel is 1 again
  GreyImage image(noise.width, noise.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double here = gain * grainAt(x + 0.5, y + 0.5) * static_cast<double>(grain.row(y)[x]);
      image.row(y)[x] = static_cast<std::uint16_t>(
          std::lround(std::clamp(150.0 - dark(x + 0.5, y + 0.5) + here, 0.0, 255.0) * 257.0));
    }
  }
  return image;
}
double grainEverywhere(double /*x*/, double /*y*/) { return kGrain; }

double paleLine(double x, double y) { return strokeAt(paleStroke(x, y), 9.0, 32.0); }

struct PageInk {
  BitImage byLevel, all;
};
PageInk inkOf(const GreyImage& page, const ThresholdParams& params = {}) {
  const RegionThresholds thresholds = *findThresholds(page, {}, params, {});
  return {*binarize(page, thresholds, params, {}), *binarizePage(page, thresholds, params, {})};
}

/// Of the places along the pale stroke, the share that has ink within 2 px.
double foundOfStroke(const BitImage& ink) {
  int places = 0, found = 0;
  for (int x = 390; x < 750; ++x) {
    const int y = static_cast<int>(900.0 - std::sqrt(640.0 * 640.0 - (x - 560.0) * (x - 560.0)));
    ++places;
    bool isFound = false;
    for (int dy = -2; dy <= 2; ++dy) isFound |= ink.at(x, y + dy);
    found += isFound ? 1 : 0;
  }
  return static_cast<double>(found) / places;
}

TEST(LinesInGrain, AreFoundWhereNoPixelStandsOutOfThePaper) {
  const GreyImage page = pageOf([](double x, double y) { return darkRing(x, y) + paleLine(x, y); }, grainEverywhere);
  const PageInk ink = inkOf(page);
  EXPECT_LT(foundOfStroke(ink.byLevel), 0.4);  // else there is nothing to find
  EXPECT_GT(foundOfStroke(ink.all), 0.85);
  const BitImage added = without(ink.all, ink.byLevel);
  std::int64_t stray = 0;
  for (int y = 0; y < added.height; ++y)
    for (int x = 0; x < added.width; ++x)
      stray += added.at(x, y) && std::fabs(paleStroke(x + 0.5, y + 0.5)) > 8.0 && darkRing(x, y) < 1.0 ? 1 : 0;
  EXPECT_LT(stray, added.count() / 20);
}

TEST(LinesInGrain, GrainAloneHoldsNone) {
  const PageInk ink = inkOf(pageOf(darkRing, grainEverywhere));
  EXPECT_EQ(ink.all, ink.byLevel);
}

// Means along lines see a speck from far along.
TEST(LinesInGrain, SpecksHaveHardlyAnyAround) {
  const auto specks = [](double x, double y) {
    const double dx = std::fmod(x, 90.0) - 45.0, dy = std::fmod(y, 90.0) - 45.0;
    return std::max(darkRing(x, y), 90.0 * (std::hypot(dx, dy) < 3.5 ? 1.0 : 0.0));
  };
  const PageInk ink = inkOf(pageOf(specks, grainEverywhere));
  EXPECT_LT(ink.all.count() - ink.byLevel.count(), ink.byLevel.count() / 20);
}

// What looks like grain on a part of the page was drawn: shading, in which no lines are sought.
TEST(LinesInGrain, AreNotSoughtWhereAPartOfThePaperIsCalm) {
  const auto onTheRight = [](double x, double /*y*/) { return x > 250.0 ? kGrain : 2.0; };
  const PageInk ink = inkOf(pageOf([](double x, double y) { return darkRing(x, y) + paleLine(x, y); }, onTheRight));
  EXPECT_EQ(ink.all, ink.byLevel);
}

TEST(LinesInGrain, CleanPagesAndLevelsOfTheUserStayAsTheyAre) {
  const auto dark = [](double x, double y) { return darkRing(x, y) + paleLine(x, y); };
  const PageInk clean = inkOf(pageOf(dark, [](double, double) { return 3.0; }));
  EXPECT_EQ(clean.all, clean.byLevel);
  ThresholdParams manual;
  manual.mode = ThresholdMode::Manual;
  manual.manualLevel = 90.0;
  const PageInk own = inkOf(pageOf(dark, grainEverywhere), manual);
  EXPECT_EQ(own.all, own.byLevel);
  ThresholdParams inkAsItIs;
  inkAsItIs.reach = 1.0;
  const PageInk only = inkOf(pageOf(dark, grainEverywhere), inkAsItIs);
  EXPECT_EQ(only.all, only.byLevel);
}

}  // namespace
}  // namespace batten
