// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/construct/light/light_curve.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

/// A line of a few bends away from its ends, where its curvature changes slowly.
test::TruthPiece calmEndedLine(int seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const double length = between(40.0, 400.0), level = between(-1.0, 1.0), rise = between(-1.0, 1.0);
  const double bend = between(-6.0, 6.0), place = between(0.35, 0.65), width = between(0.06, 0.12);
  constexpr double kStep = 0.1;
  test::TruthPiece piece;
  Vec2 at(0.0, 0.0);
  double angle = 0.3;
  for (double s = 0.0; s <= length; s += kStep) {
    const auto kappaAt = [&](double where) {
      const double f = where / length;
      return (level + rise * f + bend * std::exp(-std::pow((f - place) / width, 2.0))) / length;
    };
    piece.points.push_back(at);
    piece.kappa.push_back(kappaAt(s));
    const double middle = angle + 0.5 * kStep * kappaAt(s + 0.25 * kStep);
    at += kStep * Vec2(std::cos(middle), std::sin(middle));
    angle += kStep * kappaAt(s + 0.5 * kStep);
  }
  return piece;
}

/// How much the curvature changes in the first or the last tenth of the length, times the size of the curve.
double changeAtEnd(const NurbsCurve& curve, bool atEnd) {
  constexpr int kPlaces = 4001;
  const std::vector<Vec2> points = test::pointsOn(curve, kPlaces);
  const std::vector<double> kappa = test::curvaturesOn(curve, kPlaces, false);
  std::vector<double> run{0.0};
  Vec2 low = points.front(), high = low;
  for (int i = 1; i < kPlaces; ++i) {
    run.push_back(run.back() + (points[i] - points[i - 1]).norm());
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  double least = atEnd ? kappa.back() : kappa.front(), most = least;
  for (int i = 0; i < kPlaces; ++i) {
    const double fromEnd = atEnd ? run.back() - run[i] : run[i];
    if (fromEnd > 0.1 * run.back()) continue;
    least = std::min(least, kappa[i]);
    most = std::max(most, kappa[i]);
  }
  return (most - least) * (high - low).norm();
}

TEST(LightEnds, HaveNoHooksWhereTheDenseCurveIsCalm) {
  int points = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const NurbsCurve dense = test::denseCurve(calmEndedLine(seed), false);
    for (const double tolerance : {0.05, 0.2, 0.5}) {
      LightOptions options;
      options.tolerance = tolerance;
      const auto light = makeLight(dense, false, options, {});
      ASSERT_TRUE(light) << light.error().message;
      points += light->report.points;
      for (const bool atEnd : {false, true}) {
        const double now = changeAtEnd(light->curve, atEnd), before = changeAtEnd(dense, atEnd);
        if (now <= 2.0 * before + 0.2) continue;
        ADD_FAILURE() << "line " << seed << " at " << tolerance << ": " << now << " where the dense curve has "
                      << before;
      }
    }
  }
  // Without the rule they are 969.
  EXPECT_LE(points, 985) << "hooks cost control points in a few lines only";
}

}  // namespace
}  // namespace batten
