// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/width_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "core/curve/width_fit.h"

namespace batten {
namespace {

constexpr double kLength = 600.0;

std::vector<WidthSample> widths(const std::function<double(double)>& truth, double noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<WidthSample> all;
  for (double s = 0.5; s < kLength; s += 1.0) all.push_back({s, truth(s) + noise * normal(random)});
  return all;
}

double worst(const WidthProfile& profile, const std::function<double(double)>& truth) {
  double off = 0.0;
  for (double s = 0.0; s <= kLength; s += 1.0) off = std::max(off, std::abs(profile.at(s) - truth(s)));
  return off;
}

TEST(WidthProfile, NoiseOfAnEvenWidthDoesNotShow) {
  const auto even = [](double) { return 6.0; };
  for (const double noise : {0.0, 0.1, 0.5}) {
    const WidthProfile profile = fittedWidths(widths(even, noise), kLength, false, 1.0);
    EXPECT_LE(profile.samples.size(), 3u) << noise;
    EXPECT_LT(worst(profile, even), 0.02 + 0.5 * noise) << noise;
    EXPECT_LE(profile.tolerance, 0.02 + noise) << noise;
  }
}

TEST(WidthProfile, TapersGoOnToTheTip) {
  const auto taper = [](double s) { return std::min({6.0, 0.06 * s, 0.06 * (kLength - s)}); };
  const WidthProfile profile = fittedWidths(widths(taper, 0.1), kLength, false, 1.0);
  EXPECT_EQ(profile.samples.front().width, 0.0);
  EXPECT_EQ(profile.samples.back().width, 0.0);
  EXPECT_LE(profile.samples.size(), 7u);
  EXPECT_LT(worst(profile, taper), 0.25);
}

TEST(WidthProfile, BlobsAreNotTheStroke) {
  const auto even = [](double) { return 6.0; };
  std::vector<WidthSample> measured = widths(even, 0.05);
  for (WidthSample& sample : measured)
    if (std::abs(sample.s - 300.0) < 4.0) sample.width = 11.0;
  EXPECT_LT(worst(fittedWidths(measured, kLength, false, 1.0), even), 0.3);
}

TEST(WidthProfile, ALoopHasOneWidthAtItsSeam) {
  const auto ring = [](double s) { return 6.0 + 2.0 * std::cos(2.0 * std::numbers::pi * s / kLength); };
  const WidthProfile profile = fittedWidths(widths(ring, 0.1), kLength, true, 1.0);
  EXPECT_EQ(profile.samples.front().width, profile.samples.back().width);
  EXPECT_LT(worst(profile, ring), 0.2);
}

TEST(WidthProfile, AFewWidthsGiveAnEvenOne) {
  const std::vector<WidthSample> one = {{0.2, 3.0}};
  const WidthProfile profile = fittedWidths(one, 2.0, false, 1.0);
  EXPECT_TRUE(isValid(profile));
  EXPECT_EQ(profile.at(1.0), 3.0);
}

TEST(WidthProfile, FollowsItsCurveWhenItIsTurnedBegunElsewhereOrScaled) {
  const WidthProfile profile{{{0, 1}, {4, 3}, {10, 1}}, 0.1};
  const WidthProfile back = reversed(profile), moved = startedAt(profile, 6.0), large = scaled(profile, 2.0);
  for (double s = 0.0; s <= 10.0; s += 0.125) {
    EXPECT_NEAR(back.at(10.0 - s), profile.at(s), 1e-12);
    EXPECT_NEAR(moved.at(s < 6.0 ? s + 4.0 : s - 6.0), profile.at(s), 1e-12);
    EXPECT_NEAR(large.at(2.0 * s), 2.0 * profile.at(s), 1e-12);
  }
  for (const WidthProfile& one : {back, moved, large}) EXPECT_TRUE(isValid(one));
  EXPECT_EQ(startedAt(profile, 0.0), profile);
  EXPECT_EQ(startedAt(profile, 10.0), profile);
  EXPECT_TRUE(isValid(startedAt(profile, 4.0)));
  const WidthFigures figures = figuresOf(profile);
  EXPECT_EQ(figures.least, 1.0);
  EXPECT_EQ(figures.largest, 3.0);
  EXPECT_NEAR(figures.mean, 2.0, 1e-12);
}

TEST(WidthProfile, KnowsWhatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isValid({}));
  EXPECT_FALSE(isValid({{{0, 1}}, 0}));
  EXPECT_FALSE(isValid({{{0, 1}, {0, 1}}, 0}));
  EXPECT_FALSE(isValid({{{1, 1}, {2, 1}}, 0}));
  EXPECT_FALSE(isValid({{{0, 1}, {2, -1}}, 0}));
  EXPECT_FALSE(isValid({{{0, 1}, {2, nan}}, 0}));
  EXPECT_FALSE(isValid({{{0, 1}, {2, 1}}, nan}));
}

}  // namespace
}  // namespace batten
