// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/outline/crack_contours.h"
#include "core/contour/outline/subpixel_edges.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

TEST(CornerPixels, BothBelowIsTheIntegralOfTheDensity) {
  for (const double rho : {-0.97, -0.5, 0.0, 0.3, 0.9, 0.98}) {
    for (const double h : {-2.0, -0.3, 0.0, 1.1}) {
      for (const double k : {-1.2, 0.4, 2.5}) {
        // Over the first variable; the second, given it, is normal again.
        double sum = 0.0;
        constexpr double kStep = 1e-3;
        for (double t = h - 0.5 * kStep; t > -8.0; t -= kStep) {
          const double given = (k - rho * t) / std::sqrt(1.0 - rho * rho);
          sum += kStep * std::exp(-0.5 * t * t) / std::sqrt(2.0 * std::numbers::pi) * 0.5 *
                 std::erfc(-given / std::numbers::sqrt2);
        }
        EXPECT_NEAR(bothBelow(h, k, rho), sum, 2e-4) << h << " " << k << " " << rho;
      }
    }
  }
}

/// A wedge whose tip is known, opening to the left, 60 px long, as a closed outline with noise.
struct WedgePage {
  Vec2 tip = Vec2(120.37, 100.61);
  double openingDeg = 60.0;
  bool rounded = false;
  GreyImage grey(unsigned seed, double noise) const {
    const double half = 0.5 * openingDeg * std::numbers::pi / 180.0, turned = 0.21;
    const auto inside = [&](double x, double y) {
      const Vec2 d(x - tip.x(), y - tip.y());
      const double along = -(std::cos(turned) * d.x() + std::sin(turned) * d.y());
      const double across = -std::sin(turned) * d.x() + std::cos(turned) * d.y();
      if (along > 80.0) return false;
      // Rounded with radius 6: the circle that touches both sides.
      const double centre = 6.0 / std::sin(half);
      if (rounded && along < centre * std::cos(half) * std::cos(half)) return std::hypot(along - centre, across) < 6.0;
      return along > 0.0 && std::abs(across) < along * std::tan(half);
    };
    test::RenderSettings s;
    s.blurPx = 0.9;
    s.paper = 200.0;
    s.ink = 110.0;
    s.noise = noise;
    s.seed = seed;
    return test::renderShape(inside, s);
  }
  /// Distance of the corner found from the tip.
  Vec2 miss(unsigned seed, double noise, bool askPixels) const {
    const GreyImage page = grey(seed, noise);
    auto set = crackContours(test::thresholdMask(page, 155.0), false, 100.0, {});
    if (!set || set->contours.empty()) return {99.0, 99.0};
    set->contours.resize(1);
    refineOutline(set->contours.front(), page, {});
    const CornerMark marks[] = {{tip + Vec2(-3.0, 4.0)}};
    const auto pieces = splitAtCorners(*set, marks, {}, {}, askPixels ? &page : nullptr);
    if (!pieces || pieces->corners.size() != 1) return {99.0, 99.0};
    return pieces->corners.front().positionPx - tip;
  }
};

TEST(CornerPixels, PlaceNoisyCornersBetterThanTheirSidesAlone) {
  double with = 0.0, without = 0.0;
  for (const double opening : {35.0, 60.0, 100.0}) {
    WedgePage page;
    page.openingDeg = opening;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      with += page.miss(seed, 9.0, true).squaredNorm() / 15.0;
      without += page.miss(seed, 9.0, false).squaredNorm() / 15.0;
    }
  }
  RecordProperty("with", std::to_string(std::sqrt(with)));
  RecordProperty("without", std::to_string(std::sqrt(without)));
  EXPECT_LT(std::sqrt(with), 0.85 * std::sqrt(without));
  EXPECT_LT(std::sqrt(with), 0.25);
}

TEST(CornerPixels, LeaveCleanCornersWhereTheyAre) {
  for (const double opening : {35.0, 60.0, 100.0}) {
    WedgePage page;
    page.openingDeg = opening;
    EXPECT_LT(page.miss(1, 0.0, true).norm(), 0.06) << opening;
  }
}

TEST(CornerPixels, AreNotBelievedAtRoundedCorners) {
  // Where the tip is not a wedge the sides decide, as they do without pixels.
  WedgePage page;
  page.openingDeg = 70.0;
  page.rounded = true;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Vec2 with = page.miss(seed, 4.0, true), without = page.miss(seed, 4.0, false);
    EXPECT_LT((with - without).norm(), 0.1) << seed;
  }
}

}  // namespace
}  // namespace batten
