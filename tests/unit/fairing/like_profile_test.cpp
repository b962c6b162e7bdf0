// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/like_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/curve/knot_operations.h"
#include "core/fairing/fairing.h"
#include "core/fairing/profile/curve_comparison.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

NurbsCurve bend(double size) {
  return test::fitted(
      [=](double t) {
        const double a = 0.3 + 1.2 * t;
        return Vec2(size * (1.0 + 0.8 * t * t) * Vec2(std::cos(a), std::sin(a)));
      },
      16);
}

TEST(LikeProfile, IsTheCurvesOwnWhateverSizeAndDirection) {
  const NurbsCurve curve = bend(80.0);
  Eigen::Matrix2d mirror;
  mirror << 1.0, 0.0, 0.0, -1.0;
  for (const NurbsCurve& source :
       {bend(80.0), bend(200.0), reversed(bend(35.0)), bend(50.0).mapped(mirror, Vec2(3, 4))}) {
    const auto points = profileLike(shapeOf(source), curve, false);
    ASSERT_EQ(points.size(), 61u);
    const TargetProfile profile = drawnProfile(points, false);
    ASSERT_TRUE(profile.valid);
    const auto own = shapeOf(curve);
    double length = 0.0, largest = 0.0;
    for (int i = 1; i <= 4000; ++i) {
      const auto at = [&](int k) { return curve.point(curve.start() + (curve.end() - curve.start()) * k / 4000.0); };
      length += (at(i) - at(i - 1)).norm();
    }
    for (const ProfilePoint& point : own) largest = std::max(largest, std::abs(point.kappa) / length);
    for (const ProfilePoint& point : own)
      EXPECT_NEAR(profile.curvatureAt(point.fraction), point.kappa / length, 0.02 * largest);
  }
}

TEST(LikeProfile, MakesACurveLikeAnother) {
  const NurbsCurve model = bend(80.0), sketch = test::noisy(test::arc(100.0, 1.0, 20), 0.05, 5);
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = FairingTarget::Drawn;
  params.toleranceMm = 10.0;
  params.profile = profileLike(shapeOf(model), sketch, false);
  ASSERT_FALSE(validate(params));
  const auto faired = fair(sketch, false, params, {});
  ASSERT_TRUE(faired);
  const auto alike = [&](const NurbsCurve& one) {
    return compareShapes(shapeProfile(model, false), shapeProfile(one, false)).similarity;
  };
  EXPECT_GT(alike(faired->curve), 0.999);
  EXPECT_LT(alike(sketch), alike(faired->curve));
}

TEST(LikeProfile, NothingComesOfNothing) {
  EXPECT_TRUE(shapeOf(NurbsCurve()).empty());
  EXPECT_TRUE(profileLike({}, bend(80.0), false).empty());
  EXPECT_TRUE(profileLike(shapeOf(bend(80.0)), NurbsCurve(), false).empty());
}

}  // namespace
}  // namespace batten
