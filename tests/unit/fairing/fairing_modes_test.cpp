// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// Curvature at many parameters, from the general evaluation: an oracle that shares nothing with the solver.
std::vector<double> denseCurvature(const NurbsCurve& curve, int count = 4000) {
  std::vector<double> kappa;
  for (int i = 0; i <= count; ++i) {
    const double u = curve.start() + (curve.end() - curve.start()) * i / count;
    kappa.push_back(curvature(curve, u).value());
  }
  return kappa;
}

/// Times that the values turn back by more than a billionth of their size, counted the plain way.
int turnsOf(const std::vector<double>& values) {
  double size = 0.0;
  for (const double v : values) size = std::max(size, std::abs(v));
  const double flat = 1e-8 * size;
  int turns = 0, direction = 0;
  double extreme = values.front();
  for (const double v : values) {
    if (direction >= 0 && v > extreme) extreme = v;
    if (direction <= 0 && v < extreme) extreme = v;
    if (direction == 0 && std::abs(v - values.front()) > flat) direction = v > values.front() ? 1 : -1;
    if (direction != 0 && (direction > 0 ? extreme - v : v - extreme) > flat) {
      ++turns;
      direction = -direction;
      extreme = v;
    }
  }
  return turns;
}

/// Curvature over equal steps of the length, without its short waves: local straight lines with Gaussian weights by the
/// trapezoidal rule, written out plainly.
std::vector<double> filteredCurvature(const NurbsCurve& curve, double wavelength) {
  constexpr std::size_t kPlaces = 4001, kEvery = 8;
  const auto samples = sampleByArcLength(curve, kPlaces);
  const double sigma = wavelength * std::sqrt(0.5 * std::numbers::ln2) / std::numbers::pi;
  std::vector<double> filtered;
  for (std::size_t i = 0; i < kPlaces; i += kEvery) {
    double w0 = 0.0, w1 = 0.0, w2 = 0.0, y0 = 0.0, y1 = 0.0;
    for (std::size_t j = 0; j < kPlaces; ++j) {
      const double x = samples[j].s - samples[i].s, share = j == 0 || j + 1 == kPlaces ? 0.5 : 1.0;
      const double w = share * std::exp(-0.5 * x * x / (sigma * sigma));
      w0 += w;
      w1 += w * x;
      w2 += w * x * x;
      y0 += w * samples[j].kappa;
      y1 += w * x * samples[j].kappa;
    }
    filtered.push_back((w2 * y0 - w1 * y1) / (w0 * w2 - w1 * w1));
  }
  return filtered;
}

/// Times that the values turn back by more than this, counted the plain way.
int turnsBeyond(const std::vector<double>& values, double prominence) {
  int turns = 0, direction = 0;
  double low = values.front(), high = values.front();
  for (const double v : values) {
    low = std::min(low, v);
    high = std::max(high, v);
    const bool rises = direction <= 0 && v - low > prominence, falls = direction >= 0 && high - v > prominence;
    if (!rises && !falls) continue;
    turns += direction == 0 ? 0 : 1;
    direction = rises ? 1 : -1;
    low = high = v;
  }
  return turns;
}

FairingParams monotone(double tolerance, std::optional<int> keep) {
  FairingParams params;
  params.mode = FairingMode::Monotone;
  params.toleranceMm = tolerance;
  params.keepExtrema = {keep};
  return params;
}

TEST(Monotone, ANoisyArcOfAnEllipseBecomesTrulyMonotone) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 24), 0.3, seed);
    ASSERT_GT(turnsOf(denseCurvature(start)), 5);
    const auto faired = fair(start, false, monotone(2.0, 0), {});
    ASSERT_TRUE(faired) << faired.error().message;
    EXPECT_EQ(turnsOf(denseCurvature(faired->curve)), 0) << faired->report.note;
    EXPECT_TRUE(faired->report.withinTolerance);
    EXPECT_EQ(faired->report.why, Termination::Converged);
    EXPECT_LE(deviation(start, faired->curve).max, 2.0);
    // Nearest: hardly farther from the sketch than the truth is, which is monotone too.
    const NurbsCurve truth = test::ellipseQuarter(200, 120, 24);
    EXPECT_LT(deviation(start, faired->curve).rms, 1.2 * deviation(start, truth).rms);
  }
}

TEST(Monotone, AMonotoneCurveStaysWhereItIs) {
  const NurbsCurve start = test::ellipseQuarter(200, 120, 24);
  const auto faired = fair(start, false, monotone(0.5, 0), {});
  ASSERT_TRUE(faired);
  EXPECT_LT(deviation(start, faired->curve).max, 2e-3);
}

TEST(Monotone, KeepsTheExtremaThatAreAskedFor) {
  // Half an ellipse has one extremum of curvature, at the end of the long axis.
  const auto half = [](double t) {
    const double a = std::numbers::pi * (t - 0.5);
    return Vec2(150.0 * std::cos(a), 70.0 * std::sin(a));
  };
  const NurbsCurve start = test::noisy(test::fitted(half, 40), 0.1, 9);
  const auto one = fair(start, false, monotone(1.0, 1), {});
  ASSERT_TRUE(one);
  const auto kappa = denseCurvature(one->curve);
  EXPECT_EQ(turnsOf(kappa), 1) << one->report.note;
  const auto top = std::max_element(kappa.begin(), kappa.end()) - kappa.begin();
  EXPECT_NEAR(static_cast<double>(top) / 4000.0, 0.5, 0.06);
  EXPECT_EQ(one->report.extremaAfter, 1);
  // None is not to be had within the tolerance: said, with what it takes, and nothing is exceeded.
  const auto none = fair(start, false, monotone(1.0, 0), {});
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->report.withinTolerance);
  EXPECT_GE(none->report.extremaAfter, 1);
  EXPECT_FALSE(none->report.note.empty());
  EXPECT_LE(deviation(start, none->curve).max, 1.0);
  EXPECT_NE(none->report.why, Termination::Converged);
}

TEST(Monotone, BySignificanceReachesTheNumberThatTheTruthHas) {
  const NurbsCurve start = test::noisy(test::wave(240, 18, 40), 0.06, 4);
  FairingParams params = monotone(0.4, std::nullopt);
  const auto faired = fair(start, false, params, {});
  ASSERT_TRUE(faired);
  // One period of a sine: the curvature is 0 at the ends and has one minimum and one maximum.
  EXPECT_EQ(turnsOf(denseCurvature(faired->curve)), 2);
  EXPECT_LE(deviation(start, faired->curve).max, 0.4);
  EXPECT_TRUE(faired->report.withinTolerance);
}

TEST(Monotone, KeepsExtremaByPlace) {
  const NurbsCurve start = test::noisy(test::wave(240, 18, 40), 0.06, 4);
  FairingParams params = monotone(20.0, std::nullopt);
  params.keptAt = {0.25, 0.75};
  const auto faired = fair(start, false, params, {});
  ASSERT_TRUE(faired);
  const auto kappa = denseCurvature(faired->curve);
  EXPECT_EQ(turnsOf(kappa), 2) << faired->report.note;
  const auto low = std::min_element(kappa.begin(), kappa.end()) - kappa.begin();
  const auto high = std::max_element(kappa.begin(), kappa.end()) - kappa.begin();
  EXPECT_NEAR(static_cast<double>(low) / 4000.0, 0.25, 0.1);
  EXPECT_NEAR(static_cast<double>(high) / 4000.0, 0.75, 0.1);
}

TEST(Monotone, ClosedCurvesKeepFourExtremaAndMeet) {
  const auto bumpy = [](double f) {
    const double a = 2.0 * std::numbers::pi * f, r = 1.0 + 0.002 * std::sin(11.0 * a);
    return Vec2(100.0 * r * std::cos(a), 70.0 * r * std::sin(a));
  };
  const NurbsCurve start = test::closedCurve(bumpy, 40);
  const auto faired = fair(start, true, monotone(1.0, std::nullopt), {});
  ASSERT_TRUE(faired) << faired.error().message;
  std::vector<double> kappa = denseCurvature(faired->curve);
  // From the smallest value on around: three turns between it and itself.
  kappa.pop_back();
  std::rotate(kappa.begin(), std::min_element(kappa.begin(), kappa.end()), kappa.end());
  kappa.push_back(kappa.front());
  EXPECT_EQ(turnsOf(kappa), 3) << faired->report.note;
  EXPECT_LE(deviation(start, faired->curve).max, 1.0);
  const auto a = faired->curve.derivatives(0.0, 2), b = faired->curve.derivatives(1.0, 2);
  for (std::size_t d = 0; d <= 2; ++d) EXPECT_LT((a[d] - b[d]).norm(), 1e-7 * (1.0 + a[d].norm()));
}

TEST(FairingModes, HoldTheEndsInEveryMode) {
  const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 20), 0.05, 5);
  for (const FairingMode mode :
       {FairingMode::Target, FairingMode::Tolerance, FairingMode::Monotone, FairingMode::LowPass}) {
    for (const EndHold hold : {EndHold{false, false}, EndHold{true, false}, EndHold{true, true}}) {
      SCOPED_TRACE(testing::Message() << "mode " << static_cast<int>(mode) << " hold " << hold.tangent
                                      << hold.curvature);
      FairingParams params;
      params.mode = mode;
      params.toleranceMm = 1.0;
      params.lowPassMm = 100.0;
      params.startHold = params.endHold = hold;
      const auto faired = fair(start, false, params, {});
      ASSERT_TRUE(faired) << faired.error().message;
      // The nearest curve without the noise is nearer than the noise is large; and the noise is gone.
      EXPECT_GT(faired->report.maxDeviationMm, 0.003) << faired->report.note;
      EXPECT_LT(faired->report.extremaAfter, faired->report.extremaBefore);
      EXPECT_LE(deviation(faired->curve, start).max, 1.0);
      for (const double u : {0.0, 1.0}) {
        EXPECT_LT((start.point(u) - faired->curve.point(u)).norm(), 1e-9 * extent(start));
        const Vec2 a = start.derivatives(u, 1)[1].normalized(), b = faired->curve.derivatives(u, 1)[1].normalized();
        if (hold.tangent) {
          EXPECT_NEAR(cross(a, b), 0.0, 1e-9);
        }
        if (hold.curvature) {
          EXPECT_NEAR(*curvature(start, u), *curvature(faired->curve, u), 1e-9);
        }
      }
    }
  }
}

TEST(LowPassMode, TakesShortWavesAndLeavesLongOnes) {
  // An arc whose radius carries two waves, of 8 and of 100 mm: measured by the curvature's Fourier coefficients.
  const double radius = 200.0, angle = 1.6, length = radius * angle;
  const auto shape = [&](double t) {
    const double s = t * length, r = radius + 0.004 * std::sin(2.0 * std::numbers::pi * s / 16.0) +
                                     1.5 * std::sin(2.0 * std::numbers::pi * s / 107.0);
    return Vec2(r * std::cos(t * angle), r * std::sin(t * angle));
  };
  const NurbsCurve start = test::fitted(shape, 100);
  FairingParams params;
  params.mode = FairingMode::LowPass;
  params.toleranceMm = 0.5;
  params.lowPassMm = 40.0;
  const auto faired = fair(start, false, params, {});
  ASSERT_TRUE(faired);
  const auto amplitude = [&](const NurbsCurve& curve, double wavelength) {
    double c = 0.0, s = 0.0;
    const auto samples = sampleByArcLength(curve, 2001);
    for (const CurveSample& one : samples) {
      const double w = 1.0 - std::cos(2.0 * std::numbers::pi * one.s / samples.back().s);
      c += w * (one.kappa - 1.0 / radius) * std::cos(2.0 * std::numbers::pi * one.s / wavelength);
      s += w * (one.kappa - 1.0 / radius) * std::sin(2.0 * std::numbers::pi * one.s / wavelength);
    }
    return std::hypot(c, s);
  };
  EXPECT_LT(amplitude(faired->curve, 16.0), 0.05 * amplitude(start, 16.0));
  EXPECT_NEAR(amplitude(faired->curve, 107.0) / amplitude(start, 107.0), 0.91, 0.05);
  EXPECT_LE(deviation(faired->curve, start).max, 0.5);
}

TEST(LowPassMode, KeepsItsShareOfEveryWaveAtAnyTolerance) {
  constexpr double kLength = 200.0;
  for (const double wave : {20.0, 40.0}) {
    std::vector<Vec2> course{Vec2::Zero()};
    constexpr int kSteps = 4000;
    const auto angle = [&](double s) {
      return 0.01 * s + 0.004 * wave / (2.0 * std::numbers::pi) * (1.0 - std::cos(2.0 * std::numbers::pi * s / wave));
    };
    for (int i = 0; i < kSteps; ++i) {
      const double a = angle(kLength * (i + 0.5) / kSteps);
      course.push_back(course.back() + kLength / kSteps * Vec2(std::cos(a), std::sin(a)));
    }
    const auto shape = [&](double t) { return course[std::lround(t * kSteps)]; };
    const NurbsCurve start = test::fitted(shape, 100);
    const auto amplitude = [&](const NurbsCurve& curve) {
      double sum = 0.0;
      const auto samples = sampleByArcLength(curve, 2001);
      for (const CurveSample& one : samples)
        sum += (1.0 - std::cos(2.0 * std::numbers::pi * one.s / samples.back().s)) * one.kappa *
               std::sin(2.0 * std::numbers::pi * one.s / wave);
      return sum;
    };
    // A Gaussian that halves waves of 20 mm.
    const double share = std::pow(0.5, std::pow(20.0 / wave, 2.0));
    for (const double tolerance : {0.1, 1.0, 5.0}) {
      FairingParams params;
      params.mode = FairingMode::LowPass;
      params.toleranceMm = tolerance;
      params.lowPassMm = 20.0;
      const auto faired = fair(start, false, params, {});
      ASSERT_TRUE(faired);
      EXPECT_NEAR(amplitude(faired->curve) / amplitude(start), share, 0.05) << wave << ", tolerance " << tolerance;
    }
  }
}

TEST(LowPassMode, HasNoMoreExtremaThanTheFilteredCurvature) {
  std::mt19937 random(1203);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int followed = 0;
  for (unsigned i = 0; i < 90; ++i) {
    const int count = 14 + static_cast<int>(30.0 * uniform(random));
    const double length = 200.0 + 200.0 * uniform(random), height = 40.0 * uniform(random);
    const NurbsCurve shape =
        i % 2 == 0 ? test::wave(length, height, count) : test::arc(length, 0.4 + uniform(random), count);
    const NurbsCurve start = test::noisy(shape, 0.3 * uniform(random), i);
    FairingParams params;
    params.mode = FairingMode::LowPass;
    params.lowPassMm = 20.0 * std::pow(6.0, uniform(random));
    params.toleranceMm = i % 3 == 0 ? 0.3 : 20.0;
    SCOPED_TRACE(testing::Message() << "line " << i << ", wavelength " << params.lowPassMm);
    const auto faired = fair(start, false, params, {});
    ASSERT_TRUE(faired);
    const int extrema = countedExtrema(faired->curve, false);
    EXPECT_LE(extrema, countedExtrema(start, false));
    if (!faired->report.withinTolerance) continue;
    ++followed;
    // What is all but an extremum of the profile may be one of the curve.
    constexpr double kAllBut = 0.9;
    const double prominence = kAllBut * kExtremumProminence / extent(start);
    EXPECT_LE(extrema, turnsBeyond(filteredCurvature(start, params.lowPassMm), prominence));
  }
  EXPECT_GT(followed, 45);
}

TEST(LowPassMode, AdvisesNothingThatOnlyTargetsHave) {
  int noted = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    for (const double tolerance : {0.0005, 0.02, 0.5}) {
      FairingParams params;
      params.mode = FairingMode::LowPass;
      params.toleranceMm = std::max(tolerance, 0.001);
      params.lowPassMm = 20.0 * seed;
      const auto faired = fair(test::noisy(test::wave(240, 18, 40), 0.3, seed), false, params, {});
      ASSERT_TRUE(faired);
      const std::string& note = faired->report.note;
      noted += note.empty() ? 0 : 1;
      for (const char* word : {"target", "degree", "plit", "rofile"})
        EXPECT_EQ(note.find(word), std::string::npos) << note;
    }
  }
  EXPECT_GT(noted, 0);
}

TEST(FairingModes, SayWhereAProfileThatIsMissingIsDrawn) {
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = FairingTarget::Drawn;
  const auto faired = fair(test::wave(240, 18, 40), false, params, {});
  ASSERT_TRUE(faired);
  EXPECT_EQ(faired->report.note, "No profile is drawn yet: drag its points in the plot, or set fairing.profile.");
}

/// What lies between the sketched curve and the one that fairing begins with is of the same tolerance.
TEST(FairingModes, LeaveWhatIsTakenOfTheTolerance) {
  const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 20), 0.3, 5);
  for (const FairingMode mode :
       {FairingMode::Target, FairingMode::Tolerance, FairingMode::Monotone, FairingMode::LowPass}) {
    FairingParams params;
    params.mode = mode;
    params.toleranceMm = 0.5;
    const auto whole = fair(start, false, params, {});
    params.takenMm = 0.2;
    const auto rest = fair(start, false, params, {});
    ASSERT_TRUE(whole && rest);
    EXPECT_LE(rest->report.maxDeviationMm, 0.3);
    EXPECT_LE(deviation(rest->curve, start).max, 0.3);
    EXPECT_GT(rest->report.maxDeviationMm, 0.0) << static_cast<int>(mode);
    if (mode == FairingMode::Target && rest->report.targetDegree == whole->report.targetDegree) {
      EXPECT_NEAR(rest->report.neededMm.value(), whole->report.neededMm.value() + 0.2, 1e-9);
    }
    if (mode == FairingMode::Target) {
      EXPECT_EQ(rest->report.targetSplits, whole->report.targetSplits) << "spans go by the whole tolerance";
    }
    params.takenMm = 0.5;
    const auto none = fair(start, false, params, {});
    ASSERT_TRUE(none);
    EXPECT_EQ(none->curve, start);
    EXPECT_EQ(none->report.note, "Unchanged: the tolerance is too small. Raise it.");
    EXPECT_FALSE(none->report.withinTolerance);
  }
}

}  // namespace
}  // namespace batten
