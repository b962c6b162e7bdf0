// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/curve_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/fairing/profile/similarity.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

NurbsCurve reversedCurve(const NurbsCurve& curve) {
  std::vector<double> knots;
  for (const double k : curve.knots()) knots.insert(knots.begin(), curve.start() + curve.end() - k);
  std::vector<Vec2> points(curve.controlPoints().rbegin(), curve.controlPoints().rend());
  return NurbsCurve::make(curve.degree(), knots, points).value();
}

TEST(CompareShapes, IsIndependentOfPlaceSizeTurnReflectionAndDirection) {
  const NurbsCurve curve = test::ellipseQuarter(200, 90, 24);
  Eigen::Matrix2d turned;
  turned << 0.3 * std::cos(1.1), -0.3 * std::sin(1.1), 0.3 * std::sin(1.1), 0.3 * std::cos(1.1);
  Eigen::Matrix2d mirror;
  mirror << 1, 0, 0, -1;
  const ShapeProfile a = shapeProfile(curve, false);
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(testing::Message() << mirrored << reversed);
      NurbsCurve other = curve.mapped(mirrored ? Eigen::Matrix2d(turned * mirror) : turned, Vec2(30, -7));
      if (reversed) other = reversedCurve(other);
      const ShapeComparison found = compareShapes(a, shapeProfile(other, false));
      EXPECT_NEAR(found.similarity, 1.0, 1e-9);
      EXPECT_NEAR(found.pearson, 1.0, 1e-9);
      EXPECT_NEAR(found.curvatureSimilarity, 1.0, 1e-9);
      EXPECT_EQ(found.mirrored, mirrored);
      EXPECT_EQ(found.reversed, reversed);
    }
  }
}

TEST(CompareShapes, FindsWhereAClosedCurveBegins) {
  const auto egg = [](double start) {
    return test::closedCurve(
        [start](double f) {
          const double a = 2.0 * std::numbers::pi * (f + start);
          return Vec2(100.0 * std::cos(a) + 12.0 * std::cos(2.0 * a), 70.0 * std::sin(a));
        },
        48);
  };
  const ShapeProfile a = shapeProfile(egg(0.0), true), b = shapeProfile(egg(0.25), true);
  EXPECT_LT(similarity(a.radius, b.radius), 0.98);
  const ShapeComparison found = compareShapes(a, b);
  EXPECT_GT(found.similarity, 0.9999);
  EXPECT_GT(found.pearson, 0.999);
}

TEST(CompareShapes, TellsShapesApart) {
  const ShapeProfile arc = shapeProfile(test::arc(50, 1.0, 12), false);
  const ShapeProfile ellipse = shapeProfile(test::ellipseQuarter(200, 60, 24), false);
  const ShapeProfile wave = shapeProfile(test::wave(200, 30, 30), false);
  const ShapeComparison same = compareShapes(arc, arc), other = compareShapes(arc, ellipse),
                        far = compareShapes(arc, wave);
  EXPECT_NEAR(same.similarity, 1.0, 1e-12);
  EXPECT_LT(other.similarity, 0.95);
  EXPECT_LT(far.curvatureSimilarity, 0.1);
  // Symmetric but for who is laid over whom.
  EXPECT_NEAR(other.similarity, compareShapes(ellipse, arc).similarity, 1e-12);
}

TEST(CompareShapes, TheProfileIsRescaledToOne) {
  const ShapeProfile arc = shapeProfile(test::arc(50, 1.25, 16), false);
  ASSERT_EQ(std::ssize(arc.radius), kShapeSamples);
  for (const double rho : arc.radius) EXPECT_NEAR(rho, 1.0 / 1.25, 1e-6);
  for (const double kappa : arc.curvature) EXPECT_NEAR(kappa, 1.25, 1e-6);
  TargetProfile line;
  line.valid = true;
  line.coefficients = {0.01, 0.02};
  const ShapeProfile target = shapeProfile(line, false, 100.0, 80.0);
  EXPECT_NEAR(target.curvature.front(), 1.0, 1e-12);
  EXPECT_NEAR(target.curvature.back(), 3.0, 1e-12);
  EXPECT_TRUE(shapeProfile(NurbsCurve(), false).radius.empty());
}

}  // namespace
}  // namespace batten
