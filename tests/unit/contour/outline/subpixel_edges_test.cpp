// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/subpixel_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/contour/outline/crack_contours.h"
#include "tests/support/contour_shapes.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::RenderSettings;
using test::renderShape;

struct Accuracy {
  double bias = 0.0, rms = 0.0, worst = 0.0, share = 0.0;
};

Contour longestRefined(const GreyImage& grey, double threshold) {
  auto set = crackContours(test::thresholdMask(grey, threshold), false, 40.0, {});
  Contour longest;
  for (Contour& c : set->contours) {
    if (c.lengthPx > longest.lengthPx) longest = std::move(c);
  }
  refineOutline(longest, grey, {});
  return longest;
}

// Signed distance outwards from a circle.
Accuracy accuracyOf(const Contour& c, const Vec2& centre, double radius) {
  Accuracy a;
  int n = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (!c.points[i].refined) continue;
    const double e = (c.points[i].at - centre).norm() - radius;
    a.bias += e;
    a.rms += e * e;
    a.worst = std::max(a.worst, std::abs(e));
    ++n;
  }
  a.bias /= n;
  a.rms = std::sqrt(a.rms / n);
  a.share = static_cast<double>(n) / static_cast<double>(c.points.size());
  return a;
}

Accuracy circleAccuracy(const Vec2& centre, double radius, const RenderSettings& s) {
  const GreyImage grey =
      renderShape([&](double x, double y) { return std::hypot(x - centre.x(), y - centre.y()) < radius; }, s);
  return accuracyOf(longestRefined(grey, 0.5 * (s.paper + s.ink) + s.slope * centre.x()), centre, radius);
}

TEST(RefineOutline, DiscsAreUnbiasedWhateverTheirRadius) {
  for (const double radius : {20.0, 35.0, 80.0}) {
    for (const double blur : {0.8, 1.2, 1.8}) {
      RenderSettings s;
      s.blurPx = blur;
      const Accuracy a = circleAccuracy({100.3, 99.6}, radius, s);
      RecordProperty("bias", std::to_string(a.bias));
      EXPECT_LE(std::abs(a.bias), 0.01) << "radius " << radius << " blur " << blur;
      EXPECT_LE(a.rms, 0.03) << "radius " << radius << " blur " << blur;
      EXPECT_GE(a.share, 0.99);
    }
  }
}

TEST(RefineOutline, NoiseLeavesSmallUnbiasedErrors) {
  double bias = 0.0, square = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    RenderSettings s;
    s.noise = 5.0;
    s.seed = seed;
    s.ink = 100.0;
    const Accuracy a = circleAccuracy({100.3, 99.6}, 70.0, s);
    bias += a.bias / 4;
    square += a.rms * a.rms / 4;
    EXPECT_GE(a.share, 0.98);
  }
  printf("noise 5, contrast 130: bias %.4f rms %.4f\n", bias, std::sqrt(square));
  EXPECT_LE(std::abs(bias), 0.01);
  EXPECT_LE(std::sqrt(square), 0.08);
}

TEST(RefineOutline, JpegBlocksAndTextureDoNotMoveTheEdge) {
  constexpr int kSize = 400, kCorners = 1024;
  constexpr double kRadius = 140.0;
  const Vec2 centre(200.3, 199.6);
  std::vector<Vec2> circle;
  for (int i = 0; i < kCorners; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kCorners;
    circle.push_back(centre + kRadius * Vec2(std::cos(t), std::sin(t)));
  }
  for (const bool textured : {false, true}) {
    test::PageStyle style = test::cleanPage();
    style.blurPx = 0.8;
    style.paperLeft = style.paperRight = 220.0;
    style.texture = textured ? 6.0 : 0.0;
    style.jpegQuality = textured ? 0 : 85;
    const Scan page = test::renderPage(test::fillCoverage(circle, kSize, kSize), kSize, kSize, style);
    const Accuracy a = accuracyOf(longestRefined(page.grey, 120.0), centre, kRadius);
    printf("%s: bias %.4f rms %.4f\n", textured ? "texture" : "jpeg 85", a.bias, a.rms);
    EXPECT_LE(std::abs(a.bias), 0.01) << textured;
    EXPECT_LE(a.rms, 0.03) << textured;
    EXPECT_GE(a.share, 0.98) << textured;
  }
}

TEST(RefineOutline, GradationDoesNotMoveTheEdge) {
  RenderSettings s;
  s.paper = 180.0;
  s.slope = 0.2;
  const Accuracy a = circleAccuracy({100.3, 99.6}, 60.0, s);
  EXPECT_LE(std::abs(a.bias), 0.01);
  EXPECT_LE(a.rms, 0.03);
}

TEST(RefineOutline, NeighbouringInkDoesNotDragTheEdge) {
  RenderSettings s;
  const Vec2 centre(100.3, 99.6);
  // A disc inside a ring of ink whose gap is 4 px wide: well inside the profile.
  const GreyImage grey = renderShape(
      [&](double x, double y) {
        const double r = std::hypot(x - centre.x(), y - centre.y());
        return r < 50.0 || (r > 54.0 && r < 70.0);
      },
      s);
  auto set = crackContours(test::thresholdMask(grey, 150.0), false, 40.0, {});
  ASSERT_EQ(set->contours.size(), 2u);
  for (Contour& c : set->contours) {
    refineOutline(c, grey, {});
    const double radius = (c.points[0].unrefined - centre).norm() < 60.0 ? 50.0 : 70.0;
    double bias = 0.0;
    for (const Vec2& p : positionsOf(c.points))
      bias += ((p - centre).norm() - radius) / static_cast<double>(c.points.size());
    printf("gap 4 px, radius %.0f: bias %.4f\n", radius, bias);
    EXPECT_LE(std::abs(bias), 0.07) << radius;  // the true paper is nowhere to be seen in the gap
  }
}

TEST(RefineOutline, PointsKeepTheirNumberAndAdvance) {
  RenderSettings s;
  s.noise = 8.0;
  const std::vector<Vec2> star{{100, 20},  {115, 85}, {180, 100}, {115, 115},
                               {100, 180}, {85, 115}, {20, 100},  {85, 85}};
  const GreyImage grey = renderShape(test::PolygonInside(star), s);
  auto set = crackContours(test::thresholdMask(grey, 135.0), false, 40.0, {});
  ASSERT_FALSE(set->contours.empty());
  Contour& c = set->contours[0];
  const std::vector<Vec2> chain = unrefinedPositionsOf(c.points);
  refineOutline(c, grey, {});
  ASSERT_EQ(c.points.size(), chain.size());
  EXPECT_EQ(unrefinedPositionsOf(c.points), chain);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    EXPECT_LE((c.points[i].at - chain[i]).norm(), 2.0);
    const Vec2 step = c.points[(i + 1) % c.points.size()].at - c.points[i].at;
    const Vec2 next = c.points[(i + 2) % c.points.size()].at - c.points[(i + 1) % c.points.size()].at;
    EXPECT_GT(step.norm(), 0.0);
    double tip = 1e9;
    for (const Vec2& corner : star) tip = std::min(tip, (c.points[i].at - corner).norm());
    if (tip > 6.0) {
      EXPECT_GT(step.dot(next), 0.0);
    }
    if (c.points[i].refined) {
      EXPECT_LE(test::distanceToPolyline(star, c.points[i].at), 1.2) << tip;
    }
  }
}

TEST(RefineOutline, PageBorderIsNoEdge) {
  RenderSettings s;
  s.width = 80;
  s.height = 60;
  const GreyImage grey = renderShape([](double x, double) { return x < 30.5; }, s);
  const Contour c = longestRefined(grey, 135.0);
  int onBorder = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (c.points[i].unrefined.x() <= 0.0 || c.points[i].unrefined.y() <= 0.0 || c.points[i].unrefined.y() >= 60.0) {
      ++onBorder;
      EXPECT_EQ(c.points[i].refined, 0);
    } else if (std::abs(c.points[i].unrefined.y() - 30.0) < 20.0) {
      EXPECT_EQ(c.points[i].refined, 1);
      EXPECT_NEAR(c.points[i].at.x(), 30.5, 0.04) << c.points[i].unrefined.transpose();
    }
  }
  EXPECT_EQ(onBorder, 60 + 30 + 30);
}

TEST(RefineOutline, FlatGreyFallsBackToTheCrack) {
  const GreyImage grey(60, 60, 40000);
  BitImage ink(60, 60);
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) ink.set(x, y, true);
  }
  auto set = crackContours(ink, false, 0.0, {});
  Contour& c = set->contours[0];
  refineOutline(c, grey, {});
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    EXPECT_EQ(c.points[i].refined, 0);
    EXPECT_LE((c.points[i].at - c.points[i].unrefined).norm(), 1.0);
  }
}

TEST(RefineOutline, TinyContoursAreLeftAlone) {
  const GreyImage grey(10, 10, 40000);
  Contour c;
  refineOutline(c, grey, {});
  EXPECT_TRUE(c.points.empty());
  c.closed = true;
  const std::vector<Vec2> ring{{1, 1.5}, {1.5, 1}, {2, 1.5}};
  c.points = contourPoints(ring, true);
  refineOutline(c, grey, {});
  EXPECT_EQ(positionsOf(c.points), ring);
}

}  // namespace
}  // namespace batten
