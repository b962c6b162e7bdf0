// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/merge_advice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/pipeline/run/pipeline.h"
#include "tests/support/overdrawn_page.h"

namespace batten {
namespace {

const test::IntendedLine kIntended = test::cubicLine({60, 500}, {420, 560}, {200, 80}, {580, 120});

Scan bundlePage() {
  std::vector<test::PenPath> strokes;
  for (const unsigned seed : {101u, 102u, 103u}) strokes.push_back(test::wanderAlong(kIntended, 0.0, 1.0, 10.0, seed));
  return test::overdrawnScan(strokes);
}

TEST(MergeAdvice, SaysHowManyStrokesBecomeHowManyLines) {
  const Scan scan = bundlePage();
  StageCache cache;
  Recipe recipe;
  const auto advice = adviseMerge(scan, recipe, cache, {});
  ASSERT_TRUE(advice) << advice.error().message;
  ASSERT_TRUE(advice->widths);
  EXPECT_GT(*advice->widths, 0.0);
  EXPECT_GT(advice->strokes, 1);
  EXPECT_EQ(advice->lines, 1);
  EXPECT_EQ(describe(*advice).find("stroke width") != std::string::npos, true) << describe(*advice);
  EXPECT_NE(describe(*advice).find(std::to_string(advice->strokes) + " strokes become 1 line."), std::string::npos)
      << describe(*advice);
  // What the recipe with that strength gives, is what was said.
  recipe.edges.mergeWidths = *advice->widths;
  PipelineRequest request;
  request.upTo = StageId::Contours;
  const auto out = runPipeline(scan, recipe, cache, request, {});
  ASSERT_TRUE(out.contours);
  EXPECT_EQ(out.contours->contours.size(), 1u);
  // And what the recipe says already makes no difference.
  const auto again = adviseMerge(scan, recipe, cache, {});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->widths, advice->widths);
  EXPECT_EQ(again->strokes, advice->strokes);
  // Nor does how many lines it keeps.
  recipe.contours.maxCount = 1;
  const auto few = adviseMerge(scan, recipe, cache, {});
  ASSERT_TRUE(few);
  EXPECT_EQ(few->widths, advice->widths);
  EXPECT_EQ(few->strokes, advice->strokes);
}

TEST(MergeAdvice, SaysWhenMergingWouldNotHelp) {
  EXPECT_EQ(describe({std::nullopt, 5, 5, 0.3}),
            "Some strokes overlap, but merging them would not reduce the number of lines.");
}

TEST(MergeAdvice, TheKeyIsOfWhatItDependsOn) {
  const Scan scan = bundlePage();
  Recipe recipe;
  const ContentHash key = mergeAdviceKey(scan, recipe);
  recipe.edges.mergeWidths = 5.0;
  recipe.contours.maxCount = 7;
  recipe.fairing.toleranceMm *= 2.0;
  EXPECT_EQ(mergeAdviceKey(scan, recipe), key);
  recipe.edges.mode = EdgeMode::Outline;
  EXPECT_NE(mergeAdviceKey(scan, recipe), key);
}

TEST(MergeAdvice, NoneForSingleStrokesAndOutlines) {
  const Scan scan = test::overdrawnScan({test::strokeAlong(kIntended, 0.0, 1.0, 0.0, 0.0, 0.0)});
  StageCache cache;
  Recipe recipe;
  const auto advice = adviseMerge(scan, recipe, cache, {});
  ASSERT_TRUE(advice);
  EXPECT_FALSE(advice->widths);
  EXPECT_EQ(advice->strokes, 1);
  EXPECT_EQ(describe(*advice), "No overdrawn strokes were found.");
  recipe.edges.mode = EdgeMode::Outline;
  const auto outlines = adviseMerge(bundlePage(), recipe, cache, {});
  ASSERT_TRUE(outlines);
  EXPECT_FALSE(outlines->widths);
  EXPECT_EQ(outlines->strokes, 0);
  EXPECT_EQ(describe(*outlines), "No centre lines are traced, so there are no strokes to merge.");
}

TEST(MergeAdvice, SaysWhyThereIsNone) {
  StageCache cache;
  const auto empty = adviseMerge(test::overdrawnScan({}), {}, cache, {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::NoCurve);
  RunContext stopped;
  stopped.cancel.cancel();
  const auto none = adviseMerge(bundlePage(), {}, cache, stopped);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::Cancelled);
}

TEST(MergeAdvice, SameWithAnyNumberOfThreads) {
  const Scan scan = bundlePage();
  StageCache first, second;
  RunContext one, five;
  one.threads = 1;
  five.threads = 5;
  const auto a = adviseMerge(scan, {}, first, one), b = adviseMerge(scan, {}, second, five);
  ASSERT_TRUE(a && b);
  ASSERT_GT(a->widths, 0.0);
  EXPECT_EQ(a->widths, b->widths);
  EXPECT_EQ(a->lines, b->lines);
  EXPECT_EQ(a->share, b->share);
}

}  // namespace
}  // namespace batten
