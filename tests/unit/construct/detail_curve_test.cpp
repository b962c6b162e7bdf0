// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/detail_curve.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/construct/light/detail_line.h"
#include "core/curve/curvature.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

constexpr double kStroke = 60.0, kRagged = 1.2;
const std::vector<Vec2> kBar = {Vec2(0, 0), Vec2(400, 0), Vec2(400, kStroke), Vec2(0, kStroke)};

/// A closed polygon with its sides made ragged: waves of about 9 px along them, none at the corners.
test::TruthPiece raggedPolygon(const std::vector<Vec2>& corners) {
  test::TruthPiece piece;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], way = corners[(i + 1) % corners.size()] - a;
    const double length = way.norm();
    const Vec2 across = leftNormal(way / length);
    const int steps = static_cast<int>(10.0 * length);
    for (int k = 0; k < steps; ++k) {
      const double s = length * k / steps;
      const double fade = std::min(1.0, std::min(s, length - s) / 6.0);
      const double off = kRagged * fade * (0.6 * std::sin(0.7 * s + static_cast<double>(i)) + 0.4 * std::sin(0.43 * s));
      piece.points.push_back(a + way * (s / length) + off * across);
    }
  }
  return piece;
}

/// A ring of this radius with small waves.
test::TruthPiece raggedRing(double radius) {
  test::TruthPiece piece;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / steps;
    piece.points.push_back((radius + kRagged * std::sin(71.0 * a)) * Vec2(1.3 * std::cos(a), std::sin(a)));
  }
  return piece;
}

LightOptions atScale(double tolerance) {
  LightOptions options;
  options.tolerance = tolerance;
  return options;
}

TEST(ScaleCorners, AreWhereARaggedLineIsSharpAtLarge) {
  const NurbsCurve dense = test::denseCurve(raggedPolygon(kBar), true);
  const double scale = 6.0;
  const auto corners = cornersAtScale(evenLine(dense, true, 0.5), scale);
  std::vector<ScaleCorner> hard;
  for (const ScaleCorner& corner : corners) {
    if (corner.hard) hard.push_back(corner);
  }
  ASSERT_EQ(hard.size(), kBar.size());
  for (const Vec2& wanted : kBar) {
    double nearest = 1e9;
    for (const ScaleCorner& corner : hard) {
      if ((corner.vertex - wanted).norm() >= nearest) continue;
      nearest = (corner.vertex - wanted).norm();
      EXPECT_NEAR(std::abs(corner.turnRad), 0.5 * std::numbers::pi, 0.25);
    }
    EXPECT_LT(nearest, 0.4 * scale);
  }
}

TEST(ScaleCorners, SmoothLinesHaveNone) {
  for (const double scale : {2.0, 6.0, 12.0}) {
    const NurbsCurve ring = test::denseCurve(raggedRing(120.0), true);
    for (const ScaleCorner& corner : cornersAtScale(evenLine(ring, true, 0.5), scale)) {
      EXPECT_FALSE(corner.hard) << scale;
    }
  }
  const NurbsCurve roof = test::denseCurve(test::truthShape("clothoid", 800, 600).pieces[0], false);
  EXPECT_TRUE(cornersAtScale(evenLine(roof, false, 0.5), 6.0).empty());
}

TEST(SimplifiedCurve, KeepsCornersSharpAndSidesSmooth) {
  const NurbsCurve dense = test::denseCurve(raggedPolygon(kBar), true);
  const auto simple = simplifiedCurve(dense, true, atScale(6.0), {});
  ASSERT_TRUE(simple);
  EXPECT_EQ(simple->report.corners, 4);
  EXPECT_LE(simple->report.points, 8) << "four straight sides";
  EXPECT_LT(simple->report.worst, 6.0);
  const auto line = test::pointsOn(simple->curve, 6000);
  EXPECT_LT(test::farthestFrom(line, kBar), 2.0);
  std::vector<Vec2> outline = kBar;
  outline.push_back(kBar.front());
  EXPECT_LT(test::farthestFrom(outline, test::pointsOn(simple->curve, 500)), 2.5) << "nearer to what was meant";
}

TEST(SimplifiedCurve, CountsTheControlPointsOfTheCurveThatComesOut) {
  // One side is a bow: the straight ones are raised to its degree.
  test::TruthPiece piece = raggedPolygon(kBar);
  for (Vec2& p : piece.points)
    if (p.y() > 0.5 * kStroke) p.y() += 40.0 * std::sin(std::numbers::pi * std::clamp(p.x() / 400.0, 0.0, 1.0));
  const NurbsCurve dense = test::denseCurve(piece, true);
  const auto simple = simplifiedCurve(dense, true, atScale(6.0), {});
  ASSERT_TRUE(simple);
  ASSERT_GT(simple->curve.degree(), 1);
  EXPECT_EQ(simple->report.points, simple->curve.controlPointCount() - 1) << "the last is the first";
}

TEST(SimplifiedCurve, GivesARingItsFewExtremaBack) {
  const NurbsCurve dense = test::denseCurve(raggedRing(120.0), true);
  const auto simple = simplifiedCurve(dense, true, atScale(6.0), {});
  ASSERT_TRUE(simple);
  EXPECT_EQ(simple->report.corners, 0);
  EXPECT_LE(countedExtrema(simple->curve, true), 8);
  EXPECT_LE(simple->report.points, 12);
  EXPECT_LT(test::farthestFrom(test::pointsOn(simple->curve, 6000), test::pointsOn(dense, 600)), 1.3 * 6.0);
  EXPECT_GT(countedExtrema(dense, true), 100);
}

TEST(SimplifiedCurve, IsTheSameWhateverTheNumberOfThreads) {
  const NurbsCurve dense = test::denseCurve(raggedPolygon(kBar), true);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = simplifiedCurve(dense, true, atScale(3.0), one), b = simplifiedCurve(dense, true, atScale(3.0), four);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->curve, b->curve);
}

TEST(SimplifiedCurve, HearsACancel) {
  RunContext context;
  context.cancel.cancel();
  EXPECT_FALSE(simplifiedCurve(test::denseCurve(raggedRing(90.0), true), true, atScale(4.0), context));
}

}  // namespace
}  // namespace batten
