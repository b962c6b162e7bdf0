// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/curve/arc_length.h"
#include "core/curve/curvature_structure.h"
#include "core/curve/extremum_indices.h"
#include "core/fairing/fairing.h"
#include "core/fairing/target/low_pass.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

TEST(DrawnProfile, GoesThroughItsPointsAndTurnsBackOnlyThere) {
  const std::vector<ProfilePoint> points = {{0.0, 0.01}, {0.2, 0.012}, {0.25, 0.05}, {0.7, 0.05}, {1.0, -0.02}};
  const TargetProfile profile = drawnProfile(points, false);
  ASSERT_TRUE(profile.valid);
  for (const ProfilePoint& p : points) EXPECT_NEAR(profile.curvatureAt(p.fraction), p.kappa, 1e-15);
  double before = profile.curvatureAt(0.0);
  for (int i = 1; i <= 1000; ++i) {
    const double f = i / 1000.0, now = profile.curvatureAt(f);
    if (f <= 0.25) {
      EXPECT_GE(now, before - 1e-15);
    } else {
      EXPECT_LE(now, before + 1e-15);
    }
    // Continuous slope: no step larger than its neighbours allow.
    EXPECT_LT(std::abs(now - before), 0.003);
    before = now;
  }
}

TEST(DrawnProfile, TwoPointsAreALineAndMissingEndsStayConstant) {
  const TargetProfile line = drawnProfile(std::vector<ProfilePoint>{{0.0, 0.1}, {1.0, 0.3}}, false);
  EXPECT_NEAR(line.curvatureAt(0.4), 0.18, 1e-15);
  EXPECT_TRUE(line.isMonotone);
  const TargetProfile inner = drawnProfile(std::vector<ProfilePoint>{{0.3, 0.1}, {0.6, 0.2}}, false);
  EXPECT_NEAR(inner.curvatureAt(0.0), 0.1, 1e-15);
  EXPECT_NEAR(inner.curvatureAt(1.0), 0.2, 1e-15);
}

TEST(DrawnProfile, ClosedOnesMeetAtTheSeam) {
  for (const auto& points : {std::vector<ProfilePoint>{{0.1, 0.02}, {0.5, 0.05}, {0.8, 0.03}},
                             std::vector<ProfilePoint>{{0.0, 0.02}, {0.4, 0.05}, {1.0, 0.04}}}) {
    const TargetProfile profile = drawnProfile(points, true);
    EXPECT_NEAR(profile.curvatureAt(0.0), profile.curvatureAt(1.0), 1e-15);
    EXPECT_NEAR(profile.nodes.front().slope, profile.nodes.back().slope, 1e-15);
  }
}

TEST(DrawnProfile, RefusesWhatIsNone) {
  EXPECT_FALSE(validateProfile({}));
  EXPECT_TRUE(validateProfile(std::vector<ProfilePoint>{{0.5, 1.0}}));
  EXPECT_TRUE(validateProfile(std::vector<ProfilePoint>{{0.5, 1.0}, {0.5, 2.0}}));
  EXPECT_TRUE(validateProfile(std::vector<ProfilePoint>{{0.5, 1.0}, {1.5, 2.0}}));
  EXPECT_TRUE(validateProfile(std::vector<ProfilePoint>{{0.5, NAN}, {0.6, 2.0}}));
  EXPECT_FALSE(drawnProfile({}, false).valid);
}

TEST(DrawnProfile, TheCurveFollowsIt) {
  // A clothoid's curvature, drawn by hand for an arc: within a wide tolerance the arc becomes the clothoid.
  const NurbsCurve start = test::arc(100.0, 1.2, 24);
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = FairingTarget::Drawn;
  params.toleranceMm = 20.0;
  params.profile = {{0.0, 0.006}, {1.0, 0.014}};
  const auto faired = fair(start, false, params, {});
  ASSERT_TRUE(faired) << faired.error().message;
  EXPECT_TRUE(faired->report.withinTolerance);
  const auto samples = sampleByArcLength(faired->curve, 101);
  const double scale = 120.0 / samples.back().s;  // profiles scale with the length
  for (const CurveSample& s : samples) EXPECT_NEAR(s.kappa, scale * (0.006 + 0.008 * s.s / samples.back().s), 2e-5);
  params.profile.clear();
  const auto nothing = fair(start, false, params, {});
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->curve, start);
  EXPECT_FALSE(nothing->report.note.empty());
}

/// A curve of given curvature over arc length 0..1 times `length`, by plain integration.
NurbsCurve curveOf(const std::function<double(double)>& kappa, double length, int points) {
  constexpr int kSteps = 20000;
  std::vector<Vec2> at{Vec2::Zero()};
  double angle = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double ds = length / kSteps, turn = kappa((i + 0.5) / kSteps) * ds;
    at.push_back(at.back() + ds * Vec2(std::cos(angle + turn / 2), std::sin(angle + turn / 2)));
    angle += turn;
  }
  return test::fitted([&](double t) { return at[std::lround(t * kSteps)]; }, points);
}

TEST(SplitProfile, TwoRampsThatOnePolynomialCannotFollow) {
  // The curvature rises along a line and falls along another: degree 1 is exact once it is split at the top.
  const auto tent = [](double f) { return f < 0.4 ? 0.01 + 0.02 * f : 0.018 - 0.03 * (f - 0.4); };
  const NurbsCurve start = curveOf(tent, 80.0, 60);
  FairingParams params;
  params.toleranceMm = 0.3;
  const auto whole = fitTargets(start, params.targets);
  EXPECT_GT(whole.profiles[0].rmsPercent, 10.0);
  params.targets.splits = {0.4};
  const auto parts = fitTargets(start, params.targets);
  const TargetProfile& line = parts.profiles[0];
  ASSERT_TRUE(line.valid);
  EXPECT_LT(line.rmsPercent, 2.0);
  EXPECT_EQ(parts.recommendedDegree, 1);
  for (double f = 0.02; f < 1.0; f += 0.02) EXPECT_NEAR(line.curvatureAt(f), tent(f), 2e-4) << f;
  EXPECT_NEAR(line.curvatureAt(0.4 - 1e-9), line.curvatureAt(0.4 + 1e-9), 1e-9) << "parts meet";
  params.mode = FairingMode::Target;
  params.target = FairingTarget::Degree1;
  const auto faired = fair(test::noisy(start, 0.001, 3), false, params, {});
  ASSERT_TRUE(faired);
  EXPECT_TRUE(faired->report.withinTolerance) << faired->report.neededMm.value_or(0.0);
  EXPECT_EQ(faired->report.extremaAfter, 1);
}

TEST(SplitProfile, ClosedOnesGoOnOverTheSeam) {
  const auto oval = [](double f) {
    const double a = 2.0 * std::numbers::pi * f;
    return Vec2(100.0 * std::cos(a), 60.0 * std::sin(a));
  };
  const NurbsCurve start = test::closedCurve(oval, 40);
  TargetParams params;
  // Each part holds one of the four vertices.
  params.monotone = false;
  params.splits = {0.125, 0.375, 0.625, 0.875};
  for (const int degree : {1, 3, 6}) {
    const auto set = fitTargets(start, params, true);
    const TargetProfile& profile = set.profiles[degree - 1];
    ASSERT_TRUE(profile.valid) << profile.problem;
    EXPECT_NEAR(profile.curvatureAt(0.0), profile.curvatureAt(1.0), 1e-12);
    for (const double f : params.splits)
      EXPECT_NEAR(profile.curvatureAt(f - 1e-9), profile.curvatureAt(f + 1e-9), 1e-8);
  }
}

TEST(LowPass, HalvesTheWaveOfItsLengthAndKeepsLines) {
  const double spacing = 0.5;
  std::vector<double> wave, line;
  for (int i = 0; i < 800; ++i) {
    wave.push_back(std::sin(2.0 * std::numbers::pi * i * spacing / 20.0));
    line.push_back(3.0 - 0.01 * i);
  }
  const auto half = lowPass(wave, spacing, 20.0, true);
  for (std::size_t i = 0; i < wave.size(); ++i) EXPECT_NEAR(half[i], 0.5 * wave[i], 1e-4);
  const auto open = lowPass(wave, spacing, 20.0, false);
  for (std::size_t i = 100; i < 700; ++i) EXPECT_NEAR(open[i], 0.5 * wave[i], 1e-3);
  const auto same = lowPass(line, spacing, 20.0, false);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(same[i], line[i], 1e-10);
  // A wavelength below the spacing changes nothing; one far above leaves the mean of a closed profile.
  EXPECT_NEAR(lowPass(wave, spacing, 0.01, false)[7], wave[7], 1e-12);
  for (const double v : lowPass(wave, spacing, 1e5, true)) EXPECT_NEAR(v, 0.0, 1e-6);
}

TEST(CurvatureStructure, FindsExtremaAndDropsTheSmallestFirst) {
  // A slow wave with a fast ripple of a hundredth of its height.
  std::vector<double> s, kappa;
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    s.push_back(100.0 * x);
    kappa.push_back(std::sin(2.0 * std::numbers::pi * x) + 0.05 * std::sin(40.0 * std::numbers::pi * x));
  }
  const auto levels = structureLevels(s, kappa, 100.0, false);
  EXPECT_EQ(static_cast<int>(levels.front().structure.extrema.size()), countExtrema(kappa, 1e-9, false));
  double estimate = 0.0;
  bool two = false;
  for (const StructureLevel& level : levels) {
    EXPECT_GE(level.estimateMm, estimate);
    estimate = level.estimateMm;
    for (std::size_t k = 1; k < level.structure.extrema.size(); ++k) {
      EXPECT_NE(level.structure.extrema[k].maximum, level.structure.extrema[k - 1].maximum);
    }
    if (level.structure.extrema.size() != 2) continue;
    two = true;
    EXPECT_TRUE(level.structure.extrema[0].maximum);
    EXPECT_NEAR(level.structure.extrema[0].sample, 250, 40);
    EXPECT_NEAR(level.structure.extrema[1].sample, 750, 40);
  }
  EXPECT_TRUE(two);
  EXPECT_TRUE(levels.back().structure.extrema.empty());
  EXPECT_EQ(countExtrema(kappa, 0.3, false), 2);
}

TEST(CurvatureStructure, ClosedProfilesKeepFour) {
  std::vector<double> s, kappa;
  for (int i = 0; i < 500; ++i) {
    s.push_back(i * 0.2);
    kappa.push_back(std::cos(4.0 * std::numbers::pi * i / 500.0) +
                    0.05 * std::cos(60.0 * std::numbers::pi * i / 500.0));
  }
  const auto levels = structureLevels(s, kappa, 100.0, true);
  EXPECT_EQ(levels.back().structure.extrema.size(), 4u);
  EXPECT_EQ(countExtrema(kappa, 0.5, true), 4);
  EXPECT_EQ(levels.front().structure.extrema.size() % 2, 0u);
}

}  // namespace
}  // namespace batten
