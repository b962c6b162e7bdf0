// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "tests/support/asked_count.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// A line as a hand draws it: a few bends, with a tremor that the curve follows.
NurbsCurve randomLine(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const int count = 8 + static_cast<int>(uniform(random) * 30);
  const double length = 60.0 + 200.0 * uniform(random), bend = 2.5 * uniform(random), wave = 5.0 * uniform(random),
               phase = 6.0 * uniform(random), noise = 0.15 * uniform(random) * uniform(random);
  std::vector<Vec2> course{Vec2::Zero()};
  double angle = 6.28 * uniform(random);
  for (int j = 1; j <= 200; ++j) {
    angle += bend / 200.0 * (0.4 + std::sin(wave * j / 200.0 + phase));
    course.push_back(course.back() + length / 200.0 * Vec2(std::cos(angle), std::sin(angle)));
  }
  const auto at = [&](double t) {
    const double x = 200.0 * t;
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, 199.0));
    return Vec2(course[i] + (x - static_cast<double>(i)) * (course[i + 1] - course[i]));
  };
  return test::noisy(test::fitted(at, count), noise, random());
}

/// How many lines: some by default, BATTEN_RANDOM_LINES where it is set.
int lineCount() { return test::askedCount("BATTEN_RANDOM_LINES", 50); }

constexpr std::array kTolerances = {0.03, 0.13, 0.6, 5.0};

FairingParams paramsOf(FairingMode mode, int choice) {
  FairingParams params;
  params.mode = mode;
  if (mode == FairingMode::Target) params.target = *targetOfNumber(choice);
  if (mode == FairingMode::Monotone) params.keepExtrema = choice;
  if (mode == FairingMode::Tolerance)
    params.tolerancePolicy = choice > 0 ? TolerancePolicy::All : TolerancePolicy::AsNeeded;
  return params;
}

struct Asked {
  FairingMode mode;
  int choice;
};
constexpr std::array kAsked = {Asked{FairingMode::Monotone, kKeepSignificant},
                               Asked{FairingMode::Monotone, 0},
                               Asked{FairingMode::Target, 0},
                               Asked{FairingMode::Target, 1},
                               Asked{FairingMode::Target, 4},
                               Asked{FairingMode::Tolerance, 0},
                               Asked{FairingMode::Tolerance, 1},
                               Asked{FairingMode::LowPass, 0}};

TEST(LargerTolerance, NeverGivesMoreExtremaInAnyMode) {
  std::mt19937 random(414);
  for (int i = 0; i < lineCount(); ++i) {
    const NurbsCurve line = randomLine(random);
    const int sketched = countedExtrema(line, false);
    for (std::size_t k = 0; k < kAsked.size(); ++k) {
      if ((k + static_cast<std::size_t>(i)) % 4 != 0) continue;  // each line in a quarter of the ways
      const Asked& asked = kAsked[k];
      FairingParams params = paramsOf(asked.mode, asked.choice);
      int before = sketched;
      for (const double tolerance : kTolerances) {
        params.toleranceMm = tolerance;
        SCOPED_TRACE(testing::Message() << "line " << i << ", mode " << static_cast<int>(asked.mode) << " "
                                        << asked.choice << ", tolerance " << tolerance);
        const auto faired = fair(line, false, params, {});
        ASSERT_TRUE(faired) << faired.error().message;
        const int extrema = countedExtrema(faired->curve, false);
        EXPECT_LE(extrema, before);
        EXPECT_LE(deviation(faired->curve, line).max, tolerance * (1.0 + 1e-6));
        EXPECT_LE(deviation(line, faired->curve).max, tolerance * (1.0 + 1e-3));
        before = std::min(before, extrema);
      }
    }
  }
}

TEST(LargerTolerance, WhatATargetOrANumberOfExtremaNeedsDoesNotDependOnIt) {
  std::mt19937 random(515);
  for (int i = 0; i < lineCount(); ++i) {
    const NurbsCurve line = randomLine(random);
    for (const Asked& asked : {Asked{FairingMode::Target, 1}, Asked{FairingMode::Target, 4}}) {
      FairingParams params = paramsOf(asked.mode, asked.choice);
      // One and the same target: natural spans are other ones for another tolerance.
      params.targets.spans = TargetSpans::Whole;
      double needed = -1.0;
      for (const double tolerance : kTolerances) {
        params.toleranceMm = tolerance;
        SCOPED_TRACE(testing::Message() << "line " << i << ", choice " << asked.choice << ", tolerance " << tolerance);
        const auto faired = fair(line, false, params, {});
        ASSERT_TRUE(faired);
        if (needed < 0.0) needed = faired->report.neededMm;
        EXPECT_DOUBLE_EQ(faired->report.neededMm, needed);
        EXPECT_EQ(faired->report.withinTolerance, needed <= 0.999 * tolerance);
      }
    }
  }
}

TEST(LargerTolerance, MonotoneReachesWhatATargetReaches) {
  std::mt19937 random(616);
  for (int i = 0; i < lineCount(); ++i) {
    const NurbsCurve line = randomLine(random);
    for (const double tolerance : {0.1, 0.5, 3.0}) {
      FairingParams params = paramsOf(FairingMode::Monotone, kKeepSignificant);
      params.toleranceMm = tolerance;
      const auto monotone = fair(line, false, params, {});
      ASSERT_TRUE(monotone);
      params.mode = FairingMode::Target;
      int fewest = std::numeric_limits<int>::max();
      const auto targets = fairAllTargets(line, false, params, {});
      ASSERT_TRUE(targets);
      for (const auto& faired : targets->faired) {
        if (faired) fewest = std::min(fewest, faired->report.extremaAfter);
      }
      EXPECT_LE(monotone->report.extremaAfter, fewest) << "line " << i << ", tolerance " << tolerance;
    }
  }
}

TEST(LargerTolerance, WhatANumberOfExtremaNeedsIsEnough) {
  std::mt19937 random(717);
  for (int i = 0; i < lineCount(); ++i) {
    const NurbsCurve line = randomLine(random);
    FairingParams params = paramsOf(FairingMode::Monotone, 0);
    params.toleranceMm = 0.01;
    const auto tight = fair(line, false, params, {});
    ASSERT_TRUE(tight);
    if (tight->report.withinTolerance) continue;
    ASSERT_GT(tight->report.neededMm, 0.0) << "line " << i << ": " << tight->report.note;
    params.toleranceMm = std::min(20.0, 1.002 * tight->report.neededMm);
    if (params.toleranceMm < tight->report.neededMm) continue;
    const auto wide = fair(line, false, params, {});
    ASSERT_TRUE(wide);
    EXPECT_EQ(wide->report.extremaAfter, 0) << "line " << i << ": " << wide->report.note;
    EXPECT_TRUE(wide->report.withinTolerance);
  }
}

}  // namespace
}  // namespace batten
