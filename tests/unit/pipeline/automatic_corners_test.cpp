// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/corner_places.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/corner_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

constexpr int kSquareWidth = 800, kSquareHeight = 600;

Scan pageOf(const test::TruthShape& shape, bool stroke, std::uint32_t seed) {
  const auto outline = shape.outline();
  auto coverage = stroke ? test::strokeCoverage(outline, true, 5.0, kSquareWidth, kSquareHeight)
                         : test::fillCoverage(outline, kSquareWidth, kSquareHeight);
  return test::renderPage(std::move(coverage), kSquareWidth, kSquareHeight, test::scannedPage(seed));
}

std::vector<Corner> cornersWith(const Scan& scan, const Recipe& recipe) {
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Pieces;
  const auto out = runPipeline(scan, recipe, cache, request, {});
  EXPECT_FALSE(out.error) << out.error->message;
  return out.pieces ? out.pieces->corners : std::vector<Corner>{};
}

bool hasCornerAt(const std::vector<Corner>& corners, const Vec2& place, double within) {
  return std::ranges::any_of(corners, [&](const Corner& c) { return (c.positionPx - place).norm() < within; });
}

TEST(AutomaticCorners, AreThoseOfRenderedShapesAndNoOthers) {
  int known = 0, found = 0;
  double square = 0.0;
  for (const auto& shape : test::truthShapes(kSquareWidth, kSquareHeight)) {
    for (const bool stroke : {false, true}) {
      const std::vector<Corner> corners = cornersWith(pageOf(shape, stroke, 3), {});
      for (const Corner& corner : corners) {
        EXPECT_FALSE(corner.mark);
        double nearest = 1e9;
        for (const Vec2& truth : shape.corners) nearest = std::min(nearest, (corner.positionPx - truth).norm());
        EXPECT_LT(nearest, 2.0) << shape.name << (stroke ? " stroke" : " outline") << " at "
                                << corner.positionPx.transpose();
        square += nearest * nearest;
        ++found;
      }
      known += static_cast<int>(shape.corners.size());
    }
  }
  EXPECT_GE(found, 0.95 * known) << "of " << known;
  EXPECT_LT(std::sqrt(square / found), 0.2);
}

int cornersNear(const std::vector<Corner>& corners, const std::vector<Vec2>& places, double within) {
  return static_cast<int>(
      std::ranges::count_if(places, [&](const Vec2& place) { return hasCornerAt(corners, place, within); }));
}

// Sides of 18 to 30 px: beyond them begins the next corner, no bend of theirs.
TEST(AutomaticCorners, OfSmallZigzagsAreFound) {
  int drawn = 0, found = 0, all = 0;
  for (const double width : {2.0, 3.0, 4.5}) {
    for (const double blur : {0.8, 1.5}) {
      for (const double degrees : {45.0, 60.0, 90.0}) {
        const test::CornerPage page = test::zigzagPage({degrees * std::numbers::pi / 180.0, 12.0 + 4.0 * width}, 1);
        const std::vector<Corner> corners = cornersWith(test::scanOfCorners(page, false, width, blur, 6.0, 1), {});
        const int near = cornersNear(corners, page.corners, 1.0);
        EXPECT_GE(near, 0.75 * static_cast<double>(page.corners.size()))
            << degrees << " degrees, pen " << width << ", blur " << blur;
        drawn += static_cast<int>(page.corners.size());
        found += near;
        all += static_cast<int>(corners.size());
      }
    }
  }
  EXPECT_GE(found, 0.95 * drawn) << "of " << drawn;
  EXPECT_LE(all, 1.02 * drawn);
}

constexpr double kTipY = 80.0, kTipHeight = 420.0;

/// A filled wedge that opens by so much. @param radius [px] of its rounded tip; 0: it is sharp.
Scan wedgePage(double openingDeg, double radius, double blur, std::uint32_t seed) {
  const double half = 0.5 * openingDeg * std::numbers::pi / 180.0, middle = 0.5 * kSquareWidth;
  std::vector<Vec2> outline;
  const Vec2 centre(middle, kTipY + radius / std::sin(half));
  for (int i = 0; i <= 40; ++i) {
    const double turned = (0.5 * std::numbers::pi - half) * (i / 20.0 - 1.0);
    outline.push_back(centre + radius * Vec2(std::sin(turned), -std::cos(turned)));
  }
  const double width = kTipHeight * std::tan(half);
  outline.emplace_back(middle + width, kTipY + kTipHeight);
  outline.emplace_back(middle - width, kTipY + kTipHeight);
  test::PageStyle style = test::scannedPage(seed);
  style.blurPx = blur;
  return test::renderPage(test::fillCoverage(outline, kSquareWidth, kSquareHeight), kSquareWidth, kSquareHeight, style);
}

// Of a tip that opens by 12 degrees blur leaves no ink on 10 px.
TEST(AutomaticCorners, OfAcuteTipsAreFoundAndOfRoundedOnesThereAreNone) {
  const Vec2 tip(0.5 * kSquareWidth, kTipY);
  for (const double opening : {12.0, 14.0, 25.0}) {
    for (const double blur : {0.6, 0.9}) {
      for (const std::uint32_t seed : {1U, 2U}) {
        SCOPED_TRACE(testing::Message() << opening << " degrees, blur " << blur << ", seed " << seed);
        EXPECT_TRUE(hasCornerAt(cornersWith(wedgePage(opening, 0.0, blur, seed), {}), tip, 1.5));
        EXPECT_FALSE(hasCornerAt(cornersWith(wedgePage(opening, 8.0, blur, seed), {}), tip, 100.0));
      }
    }
  }
}

TEST(AutomaticCorners, OfSmallSmoothLinesThereAreNone) {
  for (const double width : {3.0, 4.5}) {
    for (const test::Smooth kind : {test::Smooth::Circle, test::Smooth::Ellipse, test::Smooth::Wave}) {
      for (const double radius : {3.0, 5.0}) {
        const test::CornerPage page = test::smoothPage(kind, radius * width, 1);
        const Scan scan = test::scanOfCorners(page, kind != test::Smooth::Wave, width, 0.8, 6.0, 1);
        EXPECT_TRUE(cornersWith(scan, {}).empty()) << "pen " << width << ", radius " << radius << " widths";
        StageCache cache;
        EXPECT_FALSE(runPipeline(scan, {}, cache, {}, {}).faired->curves.empty());
      }
    }
  }
}

TEST(AutomaticCorners, GiveTheCurvesThatMarksAtTheCornersGive) {
  const auto shape = test::truthShape("crown", kSquareWidth, kSquareHeight);
  const Scan scan = pageOf(shape, false, 4);
  Recipe marked;
  marked.corners.automatic = false;
  for (const Vec2& corner : shape.corners) marked.cornerMarks.push_back({corner});
  StageCache cache;
  const auto found = runPipeline(scan, {}, cache, {}, {}), asked = runPipeline(scan, marked, cache, {}, {});
  ASSERT_EQ(found.faired->curves.size(), asked.faired->curves.size());
  for (std::size_t i = 0; i < found.faired->curves.size(); ++i)
    EXPECT_LT(deviation(found.faired->curves[i].sketched, asked.faired->curves[i].sketched).rms,
              0.1 * found.frame.mmPerPx)
        << i;
}

TEST(AutomaticCorners, ARefusedOneStaysOut) {
  const auto shape = test::truthShape("K", kSquareWidth, kSquareHeight);
  const Scan scan = pageOf(shape, false, 3);
  const std::size_t all = cornersWith(scan, {}).size();
  Recipe recipe;
  recipe.refusedCornersPx = {shape.corners[4] + Vec2(3.0, -2.0)};
  const auto read = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->cornerMarks.empty());
  const std::vector<Corner> left = cornersWith(scan, *read);
  EXPECT_EQ(left.size(), all - 1);
  EXPECT_FALSE(hasCornerAt(left, shape.corners[4], 10.0));
  // At another threshold the line lies elsewhere.
  recipe.threshold.strength *= 1.2;
  EXPECT_FALSE(hasCornerAt(cornersWith(scan, recipe), shape.corners[4], 10.0));
  // A refusal where no corner is refuses none.
  recipe = {};
  recipe.refusedCornersPx = {{5.0, 5.0}};
  EXPECT_EQ(cornersWith(scan, recipe).size(), all);
}

TEST(AutomaticCorners, GiveWayToMarks) {
  const auto shape = test::truthShape("K", kSquareWidth, kSquareHeight);
  const Scan scan = pageOf(shape, false, 3);
  const std::size_t all = cornersWith(scan, {}).size();
  Recipe recipe;
  recipe.cornerMarks = {{shape.corners[0] + Vec2(4.0, 3.0)}};
  recipe.refusedCornersPx = {shape.corners[0]};
  const std::vector<Corner> corners = cornersWith(scan, recipe);
  EXPECT_EQ(corners.size(), all);
  EXPECT_EQ(std::ranges::count_if(corners, [](const Corner& c) { return c.mark == 0; }), 1);
  EXPECT_TRUE(hasCornerAt(corners, shape.corners[0], 1.0));
}

// Two sides of 150 px that turn by 120 degrees, rounded: where they would meet lies `radiusPx` beside the middle.
std::vector<Vec2> roundedTip(const Vec2& vertex, double radiusPx) {
  constexpr double kSidePx = 150.0;
  const double half = std::numbers::pi / 6.0;  // between the middle of the tip and a side
  const double tangent = radiusPx / std::tan(half);
  std::vector<Vec2> points;
  const auto onSide = [&](double sign, double s) {
    return Vec2(vertex + s * Vec2(-std::cos(half), sign * std::sin(half)));
  };
  for (double s = kSidePx; s > tangent; s -= 1.0) points.push_back(onSide(-1.0, s));
  const Vec2 centre = vertex - Vec2(radiusPx / std::sin(half), 0.0);
  const double turn = 0.5 * std::numbers::pi - half;
  const int steps = static_cast<int>(2.0 * turn * radiusPx);
  for (int k = 1; k < steps; ++k) {
    const double angle = turn * (2.0 * k / steps - 1.0);
    points.push_back(centre + radiusPx * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (double s = tangent + 0.5; s < kSidePx; s += 1.0) points.push_back(onSide(1.0, s));
  return points;
}

// The point of a pencil ends before the place where the sides meet; a pen's ink reaches it, or was bent.
TEST(AutomaticCorners, OfAPencilMayLieALittleBeyondItsInk) {
  const Vec2 vertex(300.0, 200.0);
  for (const double widthPx : {3.0, 4.0, 5.0}) {
    const std::vector<Vec2> line = roundedTip(vertex, widthPx);
    const GreyImage page =
        test::renderPage(test::strokeCoverage(line, false, widthPx, 500, 400), 500, 400, test::cleanPage()).grey;
    ContourSet set;
    Contour& contour = set.contours.emplace_back();
    contour.kind = ContourKind::Centreline;
    for (const Vec2& at : line) {
      ContourPoint& point = contour.points.emplace_back();
      point.at = point.unrefined = at;
      point.refined = true;
      point.widthPx = static_cast<float>(widthPx);
    }
    const std::vector<Corner> corners = certainCorners(set, page, {}, 16.0, {});
    ASSERT_EQ(corners.size(), 1u) << widthPx;
    EXPECT_LT((corners.front().positionPx - vertex).norm(), 1.0) << widthPx;
    for (ContourPoint& point : contour.points) point.sigmaPx = 0.1f;
    EXPECT_TRUE(certainCorners(set, page, {}, 16.0, {}).empty()) << widthPx;
  }
}

TEST(AutomaticCorners, NoneWhenSwitchedOffOrOnPenLines) {
  const auto shape = test::truthShape("K", kSquareWidth, kSquareHeight);
  Recipe off;
  off.corners.automatic = false;
  EXPECT_TRUE(cornersWith(pageOf(shape, false, 3), off).empty());
  ContourSet drawn;
  Contour line;
  line.kind = ContourKind::Pen;
  std::vector<Vec2> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(i, 0.0);
  for (int i = 0; i < 100; ++i) points.emplace_back(100.0, i);
  line.points = contourPoints(points, true);
  drawn.contours = {line};
  EXPECT_TRUE(certainCorners(drawn, {}, {}, 16.0, {}).empty());
  drawn.contours.front().kind = ContourKind::Outline;
  EXPECT_EQ(certainCorners(drawn, {}, {}, 16.0, {}).size(), 1u);
}

}  // namespace
}  // namespace batten
