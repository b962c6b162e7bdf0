// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/coarse_run.h"

#include <gtest/gtest.h>

#include "core/curve/nurbs_curve.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/large_page.h"

namespace batten {
namespace {

TEST(CoarseRun, LeavesSmallPagesAloneAndMakesLargeOnesThreeMillionPixels) {
  EXPECT_EQ(coarseFactor(2480, 3200), 1);
  for (const auto& [width, height] : {std::pair(7016, 4960), {20000, 20000}, {3000, 2700}, {60000, 200}}) {
    const int factor = coarseFactor(width, height);
    EXPECT_GT(factor, 1);
    EXPECT_LE(1.0 * width * height, 3e6 * factor * factor);
    EXPECT_GT(1.0 * width * height, 3e6 * (factor - 1) * (factor - 1)) << "no smaller than need be";
  }
}

TEST(CoarseRun, AveragesSquaresOfThePage) {
  Scan scan;
  scan.grey = GreyImage(7, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) scan.grey.row(y)[x] = static_cast<std::uint16_t>(1000 * y + 10 * x);
  scan.dpi = 600.0;
  EXPECT_EQ(coarsePage(scan, 2, {}).fileHash, ContentHash{}) << "pixels of no file stand for themselves";
  scan.fileHash = HashBuilder().text("a file").finish();
  scan.page.number = 3;
  const Scan coarse = coarsePage(scan, 2, {});
  EXPECT_EQ(coarse.page, scan.page) << "the pages of a file are told apart";
  ASSERT_EQ(coarse.grey.width, 3);
  ASSERT_EQ(coarse.grey.height, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(coarse.grey.row(y)[x], 1000 * 2 * y + 500 + 10 * 2 * x + 5);
  EXPECT_EQ(coarse.dpi, 300.0);
  EXPECT_NE(coarse.fileHash, scan.fileHash);
  // White stays white, however many pixels are averaged.
  scan.grey = GreyImage(40, 40);
  EXPECT_EQ(coarsePage(scan, 13, {}).grey.row(1)[1], 0xffff);
}

TEST(CoarseRun, LeavesPagesOfTheLowestResolutionsAlone) {
  Scan scan;
  scan.grey = GreyImage(4000, 3000);
  Recipe recipe;
  recipe.dpi = 1.5;
  EXPECT_EQ(coarseFactor(scan, recipe), 1) << "below 1 dpi nothing is computed";
  recipe.dpi = 300.0;
  EXPECT_EQ(coarseFactor(scan, recipe), 2);
}

// A page with its corner somewhere in the model: what was imported lies where the full page has it.
TEST(CoarseRun, ImportedLinesLieWhereTheFullPageHasThem) {
  constexpr int kWidth = 4000, kHeight = 3001, kFactor = 2;
  const Scan scan = blankScan(kWidth, kHeight, 254.0);
  Recipe recipe;
  recipe.dpi = 254.0;
  recipe.page = BlankPage{kWidth, kHeight, 1200.0, -350.0};
  ImportedLine line;
  line.curves = {{NurbsCurve::make(1, {0, 0, 1, 1}, {Vec2(1250, -300), Vec2(1500, -200)}).value()}};
  recipe.imports.push_back({"line.dxf", "mm", {line}});
  StageCache cache, coarseCache;
  const PipelineOutput full = runPipeline(scan, recipe, cache, {}, {});
  const PipelineOutput coarse =
      runPipeline(coarsePage(scan, kFactor, {}), coarseRecipe(recipe, scan, kFactor), coarseCache, {}, {});
  ASSERT_TRUE(full.contours);
  ASSERT_TRUE(coarse.contours) << (coarse.error ? coarse.error->message : "");
  const Vec2 expected = full.contours->contours.at(0).points.front().at;
  EXPECT_LT((kFactor * coarse.contours->contours.at(0).points.front().at - expected).norm(), 1e-6);
  const Vec2 shown = coarseFrame(coarse.frame, kFactor).pointToImage(Vec2(1250, -300));
  EXPECT_LT((shown - expected).norm(), 1e-6);
}

TEST(CoarseRun, PlacesAndLengthsInPixelsShrinkAndMillimetresStay) {
  Recipe recipe;
  ASSERT_TRUE(setParameter(recipe, "threshold.speck_area", "80"));
  ASSERT_TRUE(setParameter(recipe, "contours.min_length", "60"));
  recipe.fairing.toleranceMm = 0.4;
  recipe.cornerMarks = {{Vec2(40, 80), 1.5}};
  recipe.regions = {rectangleRegion({4, 8}, {40, 80})};
  recipe.penStrokes = {{{Vec2(4, 4), Vec2(40, 44)}, false}};
  recipe.curveNumbers = {3, {{3, {Vec2(1, 2)}}}};
  Scan scan;
  scan.grey = GreyImage(100, 100);
  scan.dpi = 600.0;
  const Recipe coarse = coarseRecipe(recipe, scan, 4);
  EXPECT_FALSE(validate(coarse));
  EXPECT_EQ(coarse.dpi, 150.0);
  EXPECT_EQ(coarse.threshold.speckArea, 5);
  EXPECT_EQ(coarse.contours.minLengthPx, 15.0);
  EXPECT_EQ(coarse.fairing.toleranceMm, 0.4);
  EXPECT_EQ(coarse.cornerMarks[0].positionPx, Vec2(10, 20));
  EXPECT_EQ(coarse.cornerMarks[0].roundMm, 1.5);
  EXPECT_EQ(coarse.regions[0].cornersPx[0], recipe.regions[0].cornersPx[0] / 4);
  EXPECT_EQ(coarse.penStrokes[0].points[1], Vec2(10, 11));
  EXPECT_TRUE(coarse.curveNumbers.curves.empty());
  // All ends of all ranges stay within them.
  for (const Parameter& p : parameterTable()) {
    if (p.type != ParameterType::Real && p.type != ParameterType::Integer) continue;
    for (const double value : {p.minimum, p.maximum}) {
      Recipe one;
      ASSERT_TRUE(p.set(one, std::to_string(value)) || p.type == ParameterType::Integer) << p.name;
      EXPECT_FALSE(validate(coarseRecipe(one, scan, 4))) << p.name << " " << value;
    }
  }
}

TEST(CoarseRun, ItsCurvesLieOnThoseOfTheFullPage) {
  const Scan scan = test::largePage(1210, 805, 6, 5);
  StageCache cache;
  PipelineRequest request;
  request.needEdges = false;
  const PipelineOutput full = runPipeline(scan, {}, cache, request, {});
  ASSERT_FALSE(full.error) << full.error->message;
  constexpr int kFactor = 3;
  const Scan page = coarsePage(scan, kFactor, {});
  const PipelineOutput coarse = runPipeline(page, coarseRecipe({}, scan, kFactor), cache, request, {});
  ASSERT_FALSE(coarse.error) << coarse.error->message;
  EXPECT_EQ(coarse.faired->curves.size(), full.faired->curves.size());
  const PageFrame frame = coarseFrame(coarse.frame, kFactor);
  for (const TracedCurve& curve : coarse.faired->curves) {
    for (int i = 5; i <= 95; ++i) {
      const NurbsCurve& shape = curve.sketched;
      const Vec2 px = frame.pointToImage(shape.point(shape.start() + (shape.end() - shape.start()) * i / 100.0));
      double nearest = 1e9;
      for (const TracedCurve& other : full.faired->curves) {
        const NurbsCurve& own = other.sketched;
        for (int k = 0; k <= 2000; ++k)
          nearest = std::min(
              nearest,
              (full.frame.pointToImage(own.point(own.start() + (own.end() - own.start()) * k / 2000.0)) - px).norm());
      }
      ASSERT_LT(nearest, 1.0 * kFactor) << "curve " << curve.piece << " at " << i;
    }
  }
}

}  // namespace
}  // namespace batten
