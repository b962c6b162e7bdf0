// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/construct/fair/fair_fit.h"
#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

TEST(FairFit, NoiseMakesNoExtrema) {
  const std::vector<std::function<double(double)>> courses = {[](double) { return 0.0; }, [](double) { return 0.004; },
                                                              [](double s) { return -0.002 + 1e-5 * s; }};
  for (std::size_t i = 0; i < courses.size(); ++i) {
    for (const double length : {80.0, 250.0, 600.0}) {
      const auto truth = test::curveOfCurvature(length, courses[i]);
      for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const auto fit = test::fitOne(test::noisyPoints(truth, 0.127, seed), false);
        ASSERT_TRUE(fit.has_value());
        EXPECT_EQ(test::extremaOf(fit->front().curve, false).size(), 0U) << i << " " << length << " " << seed;
        EXPECT_LT(test::rmsFrom(truth, fit->front().curve), length < 100 ? 0.12 : 0.06)
            << i << " " << length << " " << seed;
        if (i == 0 && length > 200) {
          EXPECT_TRUE(fit->front().report.isLine);
        }
      }
    }
  }
}

TEST(FairFit, LiesOnTheTrueCurveAndKeepsItsExtrema) {
  const auto bump = [](double s, double at, double width) { return std::exp(-std::pow((s - at) / width, 2)); };
  const auto truth = test::curveOfCurvature(
      620.0, [&](double s) { return 0.0006 + 0.0045 * bump(s, 167, 90) + 0.005 * bump(s, 484, 80); });
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto fit = test::fitOne(test::noisyPoints(truth, 0.127, seed), false);
    ASSERT_TRUE(fit.has_value());
    EXPECT_EQ(test::extremaOf(fit->front().curve, false).size(), 3U) << seed;
    EXPECT_LT(test::rmsFrom(truth, fit->front().curve), 0.055) << seed;
    int kept = 0;
    for (const ExtremumNote& e : fit->front().report.extrema) {
      EXPECT_GE(e.removalCost, 0.0);
      EXPECT_EQ(e.kept, e.removalCost >= e.askedCost);
      kept += e.kept ? 1 : 0;
    }
    EXPECT_EQ(kept, 3);
  }
}

TEST(FairFit, LongLinesAskMoreOfABump) {
  // A bump of three freedoms passes x by chance with P(x) = erfc(sqrt(x / 2)) + sqrt(2 x / pi) exp(-x / 2): a line of
  // 10 times the length has 10 times the places, and must not have 10 times the chance.
  const auto passes = [](double x) {
    return std::erfc(std::sqrt(0.5 * x)) + std::sqrt(2.0 * x / 3.14159265358979) * std::exp(-0.5 * x);
  };
  const auto asked = [](double px) {
    ConstructContour contour;
    contour.pieces.resize(2);
    for (ConstructPiece& piece : contour.pieces) piece.points = {{Vec2(0.0, 0.0)}, {Vec2(0.5 * px, 0.0)}};
    return costAsked(contour, {});
  };
  EXPECT_DOUBLE_EQ(asked(300.0), FairFitOptions().extremumSignificance);
  EXPECT_DOUBLE_EQ(asked(2000.0), FairFitOptions().extremumSignificance);
  EXPECT_NEAR(10.0 * passes(asked(20000.0)) / passes(asked(2000.0)), 1.0, 0.15);
}

/// The fit before control points are spared: its spans are those of the band.
Result<std::vector<ConstructedPiece>> fitWithAllPoints(std::vector<Vec2> points) {
  ConstructContour contour;
  contour.pieces.resize(1);
  contour.pieces[0].points = piecePoints(std::move(points));
  FairFitOptions options;
  options.knotRemovalTolerance = 0.0;
  return fairFit(contour, options, {});
}

TEST(FairFit, NoiseBandIsHonest) {
  // (kappa - true) / sigma over many runs should have a spread of about 1, away from the ends where the prior guesses.
  const auto course = [](double s) { return 0.004 + 0.003 * std::sin(s / 90.0); };
  const auto truth = test::curveOfCurvature(600.0, course);
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto fit = fitWithAllPoints(test::noisyPoints(truth, 0.127, seed));
    ASSERT_TRUE(fit.has_value());
    const auto& piece = fit->front();
    const auto profile = test::profileOf(piece.curve, 4);
    const std::vector<NoiseNote>& noise = piece.report.noise;
    ASSERT_EQ(profile.kappa.size(), noise.size());
    for (std::size_t i = 12; i + 12 < noise.size(); i += 4) {
      const double z = (profile.kappa[i] - course(noise[i].s + 0.5)) / noise[i].sigma;
      sum += z * z;
      ++count;
    }
  }
  const double spread = std::sqrt(sum / count);
  EXPECT_GT(spread, 0.5);
  EXPECT_LT(spread, 2.0);
}

TEST(FairFit, LongContoursKeepEveryExtremumAndCanBeCancelled) {
  const auto truth = test::curveOfCurvature(29700.0, [](double s) { return 0.002 + 0.004 * std::sin(s / 150.0); });
  const auto points = test::noisyPoints(truth, 0.127, 2);
  const auto fit = test::fitOne(points, false);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(test::extremaOf(fit->front().curve, false, 5e-2).size(), 63U);
  RunContext context;
  context.cancel.cancel();
  ConstructContour contour;
  contour.pieces.resize(1);
  contour.pieces[0].points = piecePoints(points);
  const auto stopped = fairFit(contour, {}, context);
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
