// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/profile_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace batten {
namespace {

constexpr double kMoveMm = 0.02;

/// A polynomial of degree 5 with four extrema inside: 0.01 + 0.02 T5(2 f - 1) with Chebyshev's T5.
TargetProfile wavyTarget() {
  TargetProfile target;
  target.degree = 5;
  target.coefficients = {0.01 - 0.02, 0.02 * 50.0, -0.02 * 400.0, 0.02 * 1120.0, -0.02 * 1280.0, 0.02 * 512.0};
  target.valid = true;
  return target;
}

/// Over 300 mm: flat, with one bend of 13 mm radius that turns by 70 degrees.
double roofAt(double f) {
  return 0.002 + 0.075 * std::exp(-std::pow((f - 0.62) / 0.03, 2)) + 0.004 * std::sin(3.0 * f);
}
TargetProfile roofTarget() {
  TargetProfile target;
  constexpr int kNodes = 400;
  constexpr double kStep = 1e-5;
  for (int i = 0; i <= kNodes; ++i) {
    const double f = static_cast<double>(i) / kNodes;
    target.nodes.push_back({f, roofAt(f), (roofAt(f + kStep) - roofAt(f - kStep)) / (2.0 * kStep)});
  }
  target.valid = true;
  return target;
}

/// Places of a curve of this curvature over the share of its length, by the midpoint rule.
std::vector<std::complex<double>> placesOf(const std::function<double(double)>& kappa, double lengthMm) {
  constexpr int kSteps = 20000;
  const double step = lengthMm / kSteps;
  std::vector<std::complex<double>> places{0.0};
  double direction = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = kappa((i + 0.5) / kSteps) * step;
    places.push_back(places.back() + std::polar(step, direction + 0.5 * turn));
    direction += turn;
  }
  return places;
}

/// [mm] Largest distance of two curves of these curvatures, laid with their ends on each other.
double distanceMm(const TargetProfile& target, const std::vector<ProfilePoint>& points, double lengthMm) {
  const TargetProfile drawn = drawnProfile(points, false);
  const auto wanted = placesOf([&](double f) { return target.curvatureAt(f); }, lengthMm);
  const auto made = placesOf([&](double f) { return drawn.curvatureAt(f); }, lengthMm);
  const std::complex<double> turned = wanted.back() / made.back();
  double most = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) most = std::max(most, std::abs(wanted[i] - made[i] * turned));
  return most;
}

/// Largest difference of curvature as a share of the target's largest curvature.
double curvatureOff(const TargetProfile& target, const std::vector<ProfilePoint>& points, bool closed) {
  const TargetProfile drawn = drawnProfile(points, closed);
  double most = 0.0, largest = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double f = i / 9999.0;
    most = std::max(most, std::abs(drawn.curvatureAt(f) - target.curvatureAt(f)));
    largest = std::max(largest, std::abs(target.curvatureAt(f)));
  }
  return most / largest;
}

TEST(ProfilePoints, AWavyTargetStaysWhatItIs) {
  const TargetProfile target = wavyTarget();
  const auto points = pointsAlong(target, {}, false, 100.0, kMoveMm);
  ASSERT_GE(points.size(), 6u) << "its ends and extrema";
  EXPECT_LE(points.size(), 31u);
  EXPECT_FALSE(validateProfile(points));
  EXPECT_EQ(points.front().fraction, 0.0);
  EXPECT_EQ(points.back().fraction, 1.0);
  EXPECT_LT(curvatureOff(target, points, false), 0.0102);
  EXPECT_LT(distanceMm(target, points, 100.0), 1.25 * kMoveMm);
}

TEST(ProfilePoints, ATightBendInAFlatLineIsNotLost) {
  const TargetProfile target = roofTarget();
  const std::vector<double> splits = {0.62};
  const auto points = pointsAlong(target, splits, false, 300.0, kMoveMm);
  EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const ProfilePoint& p) { return p.fraction == 0.62; }));
  EXPECT_LE(points.size(), 31u);
  EXPECT_LT(curvatureOff(target, points, false), 0.0102);
  EXPECT_LT(distanceMm(target, points, 300.0), 1.25 * kMoveMm);
}

TEST(ProfilePoints, OfAClosedCurveMeetAtTheSeam) {
  TargetProfile target;
  constexpr int kNodes = 400;
  for (int i = 0; i <= kNodes; ++i) {
    const double f = static_cast<double>(i) / kNodes, angle = 4.0 * std::numbers::pi * (f + 0.07);
    target.nodes.push_back(
        {f, 0.012 * (1.0 + 0.6 * std::cos(angle)), -0.012 * 0.6 * 4.0 * std::numbers::pi * std::sin(angle)});
  }
  target.valid = true;
  const auto points = pointsAlong(target, std::vector<double>{0.18, 0.43, 0.68, 0.93}, true, 500.0, kMoveMm);
  ASSERT_FALSE(points.empty());
  EXPECT_FALSE(validateProfile(points));
  EXPECT_LT(points.back().fraction, 1.0) << "the place at the seam is the first";
  EXPECT_LT(curvatureOff(target, points, true), 0.0102);
}

TEST(ProfilePoints, AConstantTargetNeedsTwoPoints) {
  TargetProfile target;
  // Rounding makes it turn back everywhere.
  for (int i = 0; i <= 300; ++i) target.nodes.push_back({i / 300.0, 0.02 + (i % 2 == 0 ? 1e-17 : -1e-17), 0.0});
  target.valid = true;
  for (const bool closed : {false, true}) {
    const auto points = pointsAlong(target, {}, closed, 200.0, kMoveMm);
    ASSERT_EQ(points.size(), 2u);
    for (const ProfilePoint& point : points) EXPECT_NEAR(point.kappa, 0.02, 1e-15);
  }
}

TEST(ProfilePoints, OfManySplitsAreStillAProfile) {
  std::vector<double> splits;
  for (int i = 1; i < 390; ++i) splits.push_back(i / 390.0);
  const auto points = pointsAlong(wavyTarget(), splits, false, 100.0, kMoveMm);
  EXPECT_FALSE(validateProfile(points));
  EXPECT_GE(points.size(), 100u);
}

TEST(ProfilePoints, OfATargetThatIsNotValidAreNone) {
  EXPECT_TRUE(pointsAlong(TargetProfile{}, {}, false, 100.0, kMoveMm).empty());
}

}  // namespace
}  // namespace batten
