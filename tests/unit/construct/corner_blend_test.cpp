// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/corner_blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/curve/curvature.h"

namespace batten {
namespace {

/// An end on a side that runs at an angle, this far from the vertex at the origin, with a curvature and its change.
BlendEnd side(double angle, double along, double kappa, double slope) {
  BlendEnd end;
  end.tangent = Vec2(std::cos(angle), std::sin(angle));
  end.point = along * end.tangent;
  end.kappa = kappa;
  end.kappaSlope = slope;
  return end;
}

double curvatureAt(const NurbsCurve& curve, double u) { return curvature(curve, u).value(); }

/// d kappa / d s by a finite difference.
double slopeAt(const NurbsCurve& curve, double u) {
  const double h = u < 0.5 ? 1e-5 : -1e-5;
  const double d1 = (curvatureAt(curve, u + h) - curvatureAt(curve, u)) / h;
  const double d2 = (curvatureAt(curve, u + 2.0 * h) - curvatureAt(curve, u)) / (2.0 * h);
  return (2.0 * d1 - d2) / curve.derivatives(u, 1)[1].norm();
}

TEST(CornerBlend, MeetsItsSidesWithCurvatureAndItsSlope) {
  for (const double turn : {0.4, 1.2, -1.6, 2.4}) {
    for (const double kappa : {0.0, 0.01, -0.02}) {
      const BlendEnd before = side(0.0, -10.0, kappa, 0.001), behind = side(turn, 12.0, -kappa, -0.002);
      for (const BlendContact contact : {BlendContact::G2, BlendContact::G3}) {
        SCOPED_TRACE(testing::Message() << turn << " " << kappa << " G" << (contact == BlendContact::G3 ? 3 : 2));
        const auto blend = blendCorner(before, behind, contact);
        ASSERT_TRUE(blend);
        const NurbsCurve& curve = blend->curve;
        EXPECT_LT((curve.point(0.0) - before.point).norm(), 1e-9);
        EXPECT_LT((curve.point(1.0) - behind.point).norm(), 1e-9);
        EXPECT_NEAR(cross(curve.derivatives(0.0, 1)[1].normalized(), before.tangent), 0.0, 1e-9);
        EXPECT_GT(curve.derivatives(0.0, 1)[1].dot(before.tangent), 0.0);
        EXPECT_NEAR(cross(curve.derivatives(1.0, 1)[1].normalized(), behind.tangent), 0.0, 1e-9);
        EXPECT_GT(curve.derivatives(1.0, 1)[1].dot(behind.tangent), 0.0);
        EXPECT_NEAR(curvatureAt(curve, 0.0), before.kappa, 1e-9);
        EXPECT_NEAR(curvatureAt(curve, 1.0), behind.kappa, 1e-9);
        if (contact != BlendContact::G3) continue;
        EXPECT_NEAR(slopeAt(curve, 0.0), before.kappaSlope, 1e-4);
        EXPECT_NEAR(slopeAt(curve, 1.0), behind.kappaSlope, 1e-4);
      }
    }
  }
}

TEST(CornerBlend, TheCurvatureRisesOnceAndFallsOnce) {
  for (const double turn : {0.3, 0.9, 1.57, 2.2}) {
    for (const double kappa : {0.0, 0.01, -0.01}) {
      for (const BlendContact contact : {BlendContact::G2, BlendContact::G3}) {
        const auto blend = blendCorner(side(0.0, -10.0, kappa, 0.0), side(turn, 13.0, kappa, 0.0), contact);
        ASSERT_TRUE(blend);
        std::vector<double> bend;
        for (int i = 0; i <= 400; ++i) bend.push_back(curvatureAt(blend->curve, i / 400.0));
        const std::size_t peak = std::max_element(bend.begin(), bend.end()) - bend.begin();
        double back = 0.0;
        for (std::size_t i = 0; i + 1 < bend.size(); ++i)
          back += std::max(0.0, i < peak ? bend[i] - bend[i + 1] : bend[i + 1] - bend[i]);
        EXPECT_LT(back, 0.02 * bend[peak]) << turn << " " << kappa << " " << (contact == BlendContact::G3);
        EXPECT_NEAR(blend->smallestRadiusMm, 1.0 / bend[peak], 0.01 / bend[peak]);
        // Nearly as round as the circle between two straight sides as long as the shorter one.
        if (kappa == 0.0 && contact == BlendContact::G2) {
          EXPECT_GT(blend->smallestRadiusMm, 0.45 * 10.0 / std::tan(0.5 * turn));
        }
      }
    }
  }
}

TEST(CornerBlend, GrowsWithItsSizeAndRefusesWhatIsNoCorner) {
  double before = 0.0;
  for (const double size : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    const auto blend = blendCorner(side(0.0, -size, 0.005, 0.0), side(1.1, size, 0.008, 0.0), BlendContact::G2);
    ASSERT_TRUE(blend);
    EXPECT_GT(blend->smallestRadiusMm, before) << size;
    before = blend->smallestRadiusMm;
  }
  EXPECT_FALSE(blendCorner(side(0.0, -5.0, 0.0, 0.0), side(0.001, 5.0, 0.0, 0.0), BlendContact::G2));
  EXPECT_FALSE(blendCorner(side(0.0, 5.0, 0.0, 0.0), side(1.0, 5.0, 0.0, 0.0), BlendContact::G2))
      << "behind the vertex";
}

TEST(BlendEnd, HasTheCurvesOwnDerivatives) {
  const NurbsCurve curve =
      NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {{0, 0}, {3, 1}, {7, 5}, {9, 3}, {12, 8}, {20, 4}})
          .value();
  for (const double u : {0.1, 0.45, 0.8}) {
    const BlendEnd end = blendEndAt(curve, u);
    EXPECT_NEAR(end.kappa, curvatureAt(curve, u), 1e-12);
    const double h = 1e-5, ds = curve.derivatives(u, 1)[1].norm() * 2.0 * h;
    EXPECT_NEAR(end.kappaSlope, (curvatureAt(curve, u + h) - curvatureAt(curve, u - h)) / ds, 1e-6);
  }
}

}  // namespace
}  // namespace batten
