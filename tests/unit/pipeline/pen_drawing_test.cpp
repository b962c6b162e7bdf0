// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/document/report.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/piece_construction.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/render_page.h"
#include "tests/unit/pipeline/ellipse_scan.h"

namespace batten {
namespace {

/// A wave of 60 drawn points, and a triangle.
std::vector<PenStroke> strokes() {
  PenStroke wave;
  for (int i = 0; i < 60; ++i) wave.points.emplace_back(40.0 + 5.0 * i, 150.0 + 60.0 * std::sin(0.1 * i));
  return {wave, PenStroke{{{60, 40}, {160, 40}, {110, 90}}, true}};
}

Recipe drawing() {
  Recipe recipe;
  recipe.page = BlankPage{test::kEllipseWidth, test::kEllipseHeight};
  recipe.dpi = 254.0;
  recipe.penStrokes = strokes();
  return recipe;
}

PipelineOutput run(const Scan& scan, const Recipe& recipe, StageCache& cache) {
  return runPipeline(scan, recipe, cache, {}, {});
}

TEST(PenDrawing, NeedsNoScan) {
  const Scan page = blankScan(test::kEllipseWidth, test::kEllipseHeight, 254.0);
  StageCache cache;
  const auto empty = run(page, Recipe{}, cache);
  ASSERT_TRUE(empty.error);
  EXPECT_EQ(empty.error->code, ErrorCode::NoCurve);
  for (const ConstructMethod method : {ConstructMethod::Fair, ConstructMethod::Nurbs, ConstructMethod::Bezier,
                                       ConstructMethod::Typical, ConstructMethod::ControlPolygon}) {
    Recipe recipe = drawing();
    recipe.construct.method = method;
    recipe.cornerMarks = {{{60, 40}}, {{160, 40}}, {{110, 90}}};
    const auto out = run(page, recipe, cache);
    ASSERT_FALSE(out.error) << out.error->message;
    ASSERT_EQ(out.faired->curves.size(), 4u) << static_cast<int>(method);
    EXPECT_NEAR(out.frame.mmPerPx, 0.1, 1e-12);
    for (const TracedCurve& curve : out.faired->curves) {
      EXPECT_LT(curve.sketchedFigures.fromPoints.max, 4.0 * out.frame.mmPerPx) << static_cast<int>(method);
    }
    // The sides of the triangle meet exactly in the corners that were drawn.
    EXPECT_LT((out.faired->curves[1].faired.point(0.0) - out.frame.pointToModel({60, 40})).norm(), 1e-9);
  }
}

TEST(PenDrawing, StrokesComeBehindTheLinesOfTheScanWithoutTracingAgain) {
  StageCache cache;
  const auto before = run(test::ellipseScan(), {}, cache);
  ASSERT_FALSE(before.error);
  Recipe recipe;
  recipe.penStrokes = strokes();
  const auto after = run(test::ellipseScan(), recipe, cache);
  ASSERT_FALSE(after.error);
  ASSERT_EQ(after.contours->contours.size(), before.contours->contours.size() + 2);
  EXPECT_TRUE(after.contours->contours[0].points == before.contours->contours[0].points);
  EXPECT_EQ(after.contours->contours[1].kind, ContourKind::Pen);
  EXPECT_EQ(after.faired->curves[0].sketched, before.faired->curves[0].sketched);
  EXPECT_TRUE(after.timing[indexOf(StageId::Filtered)].fromCache);
  // Another cache, the same result; and without the strokes all is as it was.
  StageCache fresh;
  EXPECT_EQ(run(test::ellipseScan(), recipe, fresh).faired->curves[2].sketched, after.faired->curves[2].sketched);
  EXPECT_EQ(run(test::ellipseScan(), {}, cache).contours->contours.size(), before.contours->contours.size());
  recipe.penStrokes[0].points[30].y() += 1.0;
  EXPECT_FALSE(run(test::ellipseScan(), recipe, cache).timing[indexOf(StageId::Contours)].fromCache);
}

TEST(PenDrawing, TheRecipeKeepsEveryPoint) {
  Recipe recipe = drawing();
  recipe.penStrokes[0].points[7] = Vec2(1.0 / 3.0, 2e-17);
  recipe.construct.method = ConstructMethod::ControlPolygon;
  recipe.construct.knots = SharpKnots::Order;
  recipe.construct.removal = PointRemoval::Tolerance;
  recipe.construct.removalTolerancePx = 0.7;
  PieceChoice own;
  own.anchorsPx = {Vec2(10.1, 20.2)};
  own.method = ConstructMethod::Bezier;
  recipe.choices = {own};
  const auto read = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, recipe);
  EXPECT_EQ(recipeToJson(Recipe{}).find("strokes"), std::string::npos);
}

TEST(PenDrawing, DamagedStrokesAreRefused) {
  const std::string head = R"({"format":"batten-recipe","version":1,)";
  for (const char* text :
       {R"("strokes":{}})", R"("strokes":[[1,2]]})", R"("strokes":[{"points":[[1]]}]})",
        R"("strokes":[{"points":[[1,2]]}]})", R"("strokes":[{"points":[[1,2],[3,4]],"closed":1}]})",
        R"("strokes":[{"points":[[1,2],[3,4]],"colour":1}]})", R"("page":[10,10]})", R"("page":"A4"})",
        R"("page":[1e99,10]})", R"("choices":[{"anchor":[1,2],"method":"magic"}]})"}) {
    const auto read = recipeFromJson(head + text);
    EXPECT_FALSE(read) << text;
    if (!read) {
      EXPECT_EQ(read.error().code, ErrorCode::BadParameter);
    }
  }
}

TEST(PenDrawing, ReportCountsThePointsOfThePolygon) {
  const Scan page = blankScan(test::kEllipseWidth, test::kEllipseHeight, 254.0);
  Recipe recipe = drawing();
  recipe.construct.method = ConstructMethod::ControlPolygon;
  recipe.construct.removalStepPx = 20.0;
  StageCache cache;
  const auto out = run(page, recipe, cache);
  const auto json = nlohmann::json::parse(reportToJson(page, recipe, out, {}));
  EXPECT_EQ(json["curves"][0]["kind"], "pen");
  EXPECT_EQ(json["curves"][0]["construct"]["polygon_points"]["before"], 60);
  const int after = json["curves"][0]["construct"]["polygon_points"]["after"];
  EXPECT_GT(after, 5);
  EXPECT_LT(after, 30);
  EXPECT_EQ(out.faired->curves[0].sketched.controlPointCount(), after);
}

TEST(PieceMethod, OneCurveCanBeConstructedInItsOwnWay) {
  StageCache cache;
  const Scan page = blankScan(test::kEllipseWidth, test::kEllipseHeight, 254.0);
  Recipe recipe = drawing();
  recipe.construct.method = ConstructMethod::Nurbs;
  const auto alike = run(page, recipe, cache);
  PieceChoice own;
  own.anchorsPx = {Vec2(190, 150)};
  own.method = ConstructMethod::ControlPolygon;
  recipe.choices = {own};
  const auto mixed = run(page, recipe, cache);
  ASSERT_FALSE(mixed.error);
  EXPECT_EQ(mixed.faired->curves[0].sketched.degree(), recipe.construct.degree);
  EXPECT_EQ(mixed.faired->curves[1].sketched, alike.faired->curves[1].sketched);
  EXPECT_TRUE(mixed.timing[indexOf(StageId::Segments)].fromCache);
  // The same by trying the method on the line alone.
  Recipe other;
  other.construct.method = ConstructMethod::ControlPolygon;
  const auto tried = constructLine(alike, other, 0, {});
  ASSERT_TRUE(tried);
  ASSERT_EQ(tried->size(), 1u);
  EXPECT_EQ(tried->front().sketched, mixed.faired->curves[0].sketched);
  EXPECT_FALSE(constructLine(alike, other, 7, {}));
  EXPECT_TRUE(lineInput(alike, -1).pieces.empty());
}

}  // namespace
}  // namespace batten
