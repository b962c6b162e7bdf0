// SPDX-License-Identifier: GPL-3.0-or-later
// What the user asks for single curvature extrema: keep this bump, take that one out.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

double bump(double s, double at, double width) { return std::exp(-std::pow((s - at) / width, 2)); }

/// Two roofs with a valley between them: three extrema.
test::TrueCurve roofs() {
  return test::curveOfCurvature(620.0,
                                [](double s) { return 0.0006 + 0.0045 * bump(s, 167, 90) + 0.005 * bump(s, 484, 80); });
}

ConstructedPiece fitWith(const std::vector<Vec2>& points, bool closed, std::vector<ExtremumConstraint> constraints) {
  ConstructContour contour;
  contour.pixelMm = 1.0;
  contour.pieces.resize(1);
  contour.pieces[0].points = piecePoints(points);
  contour.pieces[0].closed = closed;
  contour.pieces[0].constraints = std::move(constraints);
  auto fit = fairFit(contour, {}, {});
  EXPECT_TRUE(fit.has_value());
  return fit ? std::move(fit->front()) : ConstructedPiece{};
}

int keptOf(const ConstructReport& report) {
  return static_cast<int>(std::count_if(report.extrema.begin(), report.extrema.end(), [](auto& e) { return e.kept; }));
}

const ExtremumNote* noteOf(const ConstructReport& report, int constraint) {
  for (const ExtremumNote& e : report.extrema)
    if (e.constraint == constraint) return &e;
  return nullptr;
}

TEST(ExtremumConstraints, ADroppedBumpComesBackWhenTheUserKeepsIt) {
  int tried = 0;
  for (std::uint32_t seed = 1; seed <= 24 && tried < 3; ++seed) {
    // A bump on a rising curvature, too weak to be certain.
    const double height = 2.6e-4 + 0.6e-4 * (seed % 4);
    const auto truth =
        test::curveOfCurvature(700.0, [&](double s) { return 0.001 + 1e-6 * s + height * bump(s, 350, 45); });
    const auto points = test::noisyPoints(truth, 0.127, seed);
    const auto plain = fitWith(points, false, {});
    const auto dropped = std::find_if(plain.report.extrema.begin(), plain.report.extrema.end(),
                                      [](const ExtremumNote& e) { return !e.kept; });
    if (dropped == plain.report.extrema.end()) continue;
    ++tried;
    const auto kept = fitWith(points, false, {{dropped->point + Vec2(0.5, -0.5), true, 7}});
    EXPECT_TRUE(kept.report.unmetConstraints.empty()) << seed;
    const ExtremumNote* note = noteOf(kept.report, 7);
    ASSERT_NE(note, nullptr) << seed;
    EXPECT_TRUE(note->kept);
    EXPECT_LT((note->point - dropped->point).norm(), 60.0);
    EXPECT_GT(keptOf(kept.report), keptOf(plain.report));
    // Counted on the curve itself, with a threshold that sees weak bumps too.
    EXPECT_GT(test::extremaOf(kept.curve, false, 2e-4).size(), test::extremaOf(plain.curve, false, 5e-3).size())
        << seed;
  }
  EXPECT_GT(tried, 0);
}

TEST(ExtremumConstraints, ATrueBumpGoesWhenTheUserRemovesIt) {
  const auto truth = roofs();
  const auto points = test::noisyPoints(truth, 0.127, 3);
  const auto plain = fitWith(points, false, {});
  ASSERT_EQ(keptOf(plain.report), 3);
  const auto valley = std::find_if(plain.report.extrema.begin(), plain.report.extrema.end(),
                                   [](const ExtremumNote& e) { return e.kept && !e.maximum; });
  ASSERT_NE(valley, plain.report.extrema.end());
  const auto without = fitWith(points, false, {{valley->point, false, 2}});
  EXPECT_TRUE(without.report.unmetConstraints.empty());
  const ExtremumNote* note = noteOf(without.report, 2);
  ASSERT_NE(note, nullptr);
  EXPECT_FALSE(note->kept);
  EXPECT_GT(note->removalCost, 20.0) << "what it costs is said all the same";
  EXPECT_EQ(keptOf(without.report), 1);
  EXPECT_EQ(test::extremaOf(without.curve, false).size(), 1U);
  EXPECT_LT(test::rmsFrom(truth, without.curve), 6.0) << "still the best curve without the valley";
}

TEST(ExtremumConstraints, TheNotesLieOnTheCurveAtTheirLengths) {
  const auto fit = fitWith(test::noisyPoints(roofs(), 0.127, 5), false, {});
  const auto profile = test::profileOf(fit.curve);
  for (const ExtremumNote& e : fit.report.extrema) {
    if (!e.kept) continue;
    double nearest = 1e9, at = 0.0, s = 0.0;
    Vec2 last = fit.curve.point(fit.curve.start());
    for (int i = 0; i <= 4000; ++i) {
      const Vec2 p = fit.curve.point(fit.curve.start() + (fit.curve.end() - fit.curve.start()) * i / 4000.0);
      s += (p - last).norm();
      last = p;
      if ((p - e.point).norm() < nearest) nearest = (p - e.point).norm(), at = s;
    }
    EXPECT_LT(nearest, 0.2);
    EXPECT_NEAR(at, e.s, 1.0);
  }
}

TEST(ExtremumConstraints, WhatFindsNoExtremumOrCannotGoIsSaid) {
  const auto open = fitWith(test::noisyPoints(roofs(), 0.127, 3), false, {{Vec2(-4000.0, 0.0), false, 11}});
  // The nearest point is the first one, and there is no extremum near it.
  EXPECT_EQ(open.report.unmetConstraints, std::vector<int>{11});
  std::vector<Vec2> ellipse;
  for (int i = 0; i < 1532; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 1532;
    ellipse.emplace_back(300.0 * std::cos(t), 180.0 * std::sin(t));
  }
  const auto closed = fitWith(ellipse, true, {{Vec2(300.0, 0.0), false, 4}});
  EXPECT_EQ(closed.report.unmetConstraints, std::vector<int>{4}) << "a closed smooth line has four vertices";
  EXPECT_EQ(keptOf(closed.report), 4);
  EXPECT_EQ(test::extremaOf(closed.curve, true).size(), 4U);
}

TEST(ExtremumConstraints, OtherMethodsAndShortLinesIgnoreThem) {
  ConstructContour contour;
  contour.pieces.resize(1);
  contour.pieces[0].points = piecePoints(std::vector{Vec2(0, 0), Vec2(1, 0), Vec2(2, 0.1), Vec2(3, 0)});
  contour.pieces[0].constraints = {{Vec2(1, 0), true, 0}};
  const auto fit = fairFit(contour, {}, {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->front().report.unmetConstraints, std::vector<int>{0});
}

}  // namespace
}  // namespace batten
