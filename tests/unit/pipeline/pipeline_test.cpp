// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/pipeline.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/document/report.h"
#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/piece_choices.h"
#include "tests/support/render_page.h"
#include "tests/unit/pipeline/ellipse_scan.h"

namespace batten {
namespace {

PipelineOutput run(const Recipe& recipe, StageCache& cache, int threads = 1, StageId upTo = StageId::Faired) {
  RunContext context;
  context.threads = threads;
  PipelineRequest request;
  request.upTo = upTo;
  return runPipeline(test::ellipseScan(), recipe, cache, request, context);
}

/// First stage that did not come from the cache.
std::optional<StageId> firstRerun(const PipelineOutput& out) {
  for (const StageId stage : kStages) {
    if (!out.timing[indexOf(stage)].fromCache) return stage;
  }
  return std::nullopt;
}

TEST(Pipeline, TracesAnEllipseIntoTheModelFrame) {
  StageCache cache;
  const auto out = run({}, cache);
  ASSERT_FALSE(out.error) << out.error->message;
  ASSERT_EQ(out.faired->curves.size(), 1u);
  const TracedCurve& curve = out.faired->curves.front();
  EXPECT_TRUE(curve.closed);
  EXPECT_EQ(curve.faired, curve.sketched);
  EXPECT_GT(curve.sketchedFigures.fromPoints.count, 100);
  // The truth, sampled densely, as an independent oracle: every point of it lies on the curve, y up. Half a pixel is
  // what any construction keeps; how near they really come is measured elsewhere.
  const auto truth = test::truthShape("ellipse", test::kEllipseWidth, test::kEllipseHeight).outline();
  for (std::size_t i = 0; i < truth.size(); i += 50) {
    EXPECT_LT(closestPoint(curve.sketched, out.frame.pointToModel(truth[i])).distance, 0.5 * out.frame.mmPerPx);
  }
}

TEST(Pipeline, RunsOnlyWhatAChangeAffects) {
  StageCache cache;
  ASSERT_FALSE(run({}, cache).error);
  EXPECT_EQ(firstRerun(run({}, cache)), std::nullopt);
  const auto after = [&](auto change) {
    Recipe recipe;
    change(recipe);
    return firstRerun(run(recipe, cache));
  };
  EXPECT_EQ(after([](Recipe& r) { r.log.factor = 60.0; }), std::nullopt);
  EXPECT_EQ(after([](Recipe& r) { r.threshold.grid[3] = 100.0; }), StageId::Thresholds);
  EXPECT_EQ(after([](Recipe& r) { r.filter.iterations = 3; }), StageId::Filtered);
  EXPECT_EQ(after([](Recipe& r) { r.contours.minLengthPx = 55.0; }), StageId::Contours);
  EXPECT_EQ(after([](Recipe& r) { r.cornerMarks = {{Vec2(200, 50)}}; }), StageId::Pieces);
  EXPECT_EQ(after([](Recipe& r) { r.refusedCornersPx = {Vec2(200, 50)}; }), StageId::Pieces);
  EXPECT_EQ(after([](Recipe& r) { r.corners.automatic = false; }), StageId::Pieces);
  EXPECT_EQ(after([](Recipe& r) { r.segments.spacingPx = 30.0; }), StageId::Segments);
  EXPECT_EQ(after([](Recipe& r) { r.construct.derivativeMagnitude = 1.1; }), StageId::Curves);
  EXPECT_EQ(after([](Recipe& r) { r.dpi = 200.0; }), StageId::Curves);
  EXPECT_EQ(after([](Recipe& r) { r.fairing.mode = FairingMode::Tolerance; }), StageId::Faired);
}

TEST(Pipeline, GivesTheSameWithAnyThreadsAndAnyCache) {
  Recipe recipe;
  recipe.fairing.mode = FairingMode::Target;
  StageCache warm, cold;
  const auto one = run(recipe, warm, 1);
  const auto again = run(recipe, warm, 1);
  const auto four = run(recipe, cold, 4);
  ASSERT_FALSE(one.error) << one.error->message;
  ASSERT_EQ(one.faired->curves.size(), four.faired->curves.size());
  for (std::size_t i = 0; i < one.faired->curves.size(); ++i) {
    EXPECT_EQ(one.faired->curves[i].faired, four.faired->curves[i].faired);
    EXPECT_EQ(one.faired->curves[i].faired, again.faired->curves[i].faired);
  }
}

TEST(Pipeline, StopsWhereAskedAndTellsOfEveryStage) {
  StageCache cache;
  std::vector<StageId> told;
  PipelineRequest request;
  request.upTo = StageId::Pieces;
  request.needEdges = false;
  request.stageReady = [&](StageId stage, const PipelineOutput&) { told.push_back(stage); };
  const auto out = runPipeline(test::ellipseScan(), {}, cache, request, {});
  EXPECT_EQ(told,
            (std::vector{StageId::Thresholds, StageId::Binary, StageId::Filtered, StageId::Contours, StageId::Pieces}));
  EXPECT_EQ(out.edges, nullptr);
  EXPECT_EQ(out.segments, nullptr);
  EXPECT_FALSE(out.error);
}

TEST(Pipeline, CancelsWithoutStoring) {
  StageCache cache;
  RunContext context;
  context.cancel.cancel();
  const auto out = runPipeline(test::ellipseScan(), {}, cache, {}, context);
  ASSERT_TRUE(out.error);
  EXPECT_EQ(out.error->code, ErrorCode::Cancelled);
  EXPECT_EQ(cache.bytesUsed(), 0u);
  // Cancelled half way: what was finished before stays valid.
  RunContext later;
  PipelineRequest request;
  request.stageReady = [&](StageId stage, const PipelineOutput&) {
    if (stage == StageId::Contours) later.cancel.cancel();
  };
  const auto half = runPipeline(test::ellipseScan(), {}, cache, request, later);
  ASSERT_TRUE(half.error);
  EXPECT_EQ(half.error->code, ErrorCode::Cancelled);
  EXPECT_NE(half.contours, nullptr);
  EXPECT_EQ(half.pieces, nullptr);
}

TEST(Pipeline, AnEmptyPageGivesNoCurveAndABadRecipeIsRefused) {
  Scan empty = test::ellipseScan();
  empty.fileHash = {};
  empty.grey = GreyImage(200, 100);
  StageCache cache;
  const auto out = runPipeline(empty, {}, cache, {}, {});
  ASSERT_TRUE(out.error);
  EXPECT_EQ(out.error->code, ErrorCode::NoCurve);
  Recipe bad;
  bad.fairing.toleranceMm = -1.0;
  const auto refused = runPipeline(test::ellipseScan(), bad, cache, {}, {});
  ASSERT_TRUE(refused.error);
  EXPECT_EQ(refused.error->code, ErrorCode::BadParameter);
}

TEST(Pipeline, TheScaleOfTheModelFollowsTheResolution) {
  StageCache cache;
  Recipe a, b;
  a.dpi = 100.0;
  b.dpi = 300.0;
  const auto coarse = run(a, cache), fine = run(b, cache);
  ASSERT_FALSE(coarse.error || fine.error);
  EXPECT_NEAR(coarse.faired->curves[0].sketchedFigures.lengthMm / fine.faired->curves[0].sketchedFigures.lengthMm, 3.0,
              1e-4);
  EXPECT_DOUBLE_EQ(coarse.frame.mmPerPx, 0.254);
}

TEST(Pipeline, OwnChoicesActOnTheNearestPieceOnly) {
  Recipe recipe;
  recipe.cornerMarks = {{Vec2(200, 40)}, {Vec2(200, 260)}};
  recipe.corners.snapDistancePx = 60.0;
  StageCache cache;
  const auto cut = run(recipe, cache);
  ASSERT_FALSE(cut.error) << cut.error->message;
  ASSERT_EQ(cut.pieces->pieces.size(), 2u);
  PieceChoice choice;
  choice.anchorsPx = {anchorOf(cut.pieces->pieces[1]) + Vec2(3.0, 0.0)};
  choice.mode = FairingMode::Tolerance;
  choice.toleranceMm = 0.05;
  recipe.choices = {choice};
  const auto out = run(recipe, cache);
  ASSERT_FALSE(out.error);
  EXPECT_EQ(out.faired->curves[0].fairingUsed.mode, FairingMode::None);
  EXPECT_EQ(out.faired->curves[1].fairingUsed.mode, FairingMode::Tolerance);
  EXPECT_EQ(out.faired->curves[1].fairingUsed.toleranceMm, 0.05);
  EXPECT_LE(out.faired->curves[1].fairing.maxDeviationMm, 0.05);
  const ChoiceOwners owners = assignChoices(*out.pieces, recipe.choices);
  EXPECT_EQ(owners.ofPiece[1], 0u);
  EXPECT_EQ(owners.ofPiece[0], std::nullopt);
  recipe.choices[0].included = false;
  const auto without = run(recipe, cache);
  EXPECT_TRUE(without.faired->curves[0].included);
  EXPECT_FALSE(without.faired->curves[1].included);
}

TEST(Pipeline, TwoChoicesForOnePieceGiveTheSameFromTheCacheAndFromScratch) {
  StageCache warm;
  Recipe recipe;
  const auto plain = run(recipe, warm);
  ASSERT_FALSE(plain.error);
  PieceChoice method, nearer;
  method.anchorsPx = {anchorOf(plain.pieces->pieces[0]) + Vec2(0.0, 8.0)};
  method.method = ConstructMethod::Bezier;
  nearer.anchorsPx = {anchorOf(plain.pieces->pieces[0])};
  nearer.mode = FairingMode::Tolerance;
  recipe.choices = {method};
  ASSERT_FALSE(run(recipe, warm).error);
  recipe.choices = {method, nearer};
  const auto cached = run(recipe, warm);
  ASSERT_FALSE(cached.error);
  EXPECT_EQ(firstRerun(cached), StageId::Faired) << "what is no method does not construct again";
  StageCache cold;
  const auto fresh = run(recipe, cold);
  ASSERT_FALSE(fresh.error);
  EXPECT_EQ(cached.faired->curves[0].sketched, fresh.faired->curves[0].sketched);
  EXPECT_EQ(cached.faired->curves[0].faired, fresh.faired->curves[0].faired);
  EXPECT_EQ(fresh.faired->curves[0].fairingUsed.mode, FairingMode::Tolerance);
  EXPECT_FALSE(fresh.faired->curves[0].sketched == plain.faired->curves[0].sketched) << "the method counts, too";
}

TEST(Pipeline, InkFollowedInItsOwnWayIsTracedAnew) {
  StageCache cache;
  const auto whole = run({}, cache);
  ASSERT_FALSE(whole.error);
  const Contour& line = whole.contours->contours[0];
  ASSERT_EQ(line.kind, ContourKind::Outline);
  Recipe recipe;
  recipe.edges.mode = EdgeMode::Centreline;
  ASSERT_FALSE(run(recipe, cache).contours) << "a blot has no middle";
  recipe.edges.choices = {{line.points[10].unrefined, EdgeMode::Outline}};
  const auto own = run(recipe, cache);
  ASSERT_TRUE(own.contours);
  EXPECT_TRUE(own.contours->contours[0].points == line.points);
  EXPECT_EQ(own.contours->contours[0].traceMode, recipe.edges.choices[0]);
  recipe.edges.mode = EdgeMode::Automatic;
  recipe.edges.choices[0].mode = EdgeMode::Centreline;
  const auto kept = run(recipe, cache);
  ASSERT_TRUE(kept.contours);
  EXPECT_EQ(kept.contours->contours[0].kind, ContourKind::Outline) << "it must not vanish";
  EXPECT_NE(kept.contours->report.note.find("traced by its outline"), std::string::npos);
  recipe.edges.choices[0].positionPx = Vec2(-500, -500);
  const auto nowhere = run(recipe, cache);
  ASSERT_TRUE(nowhere.contours);
  EXPECT_NE(nowhere.contours->report.note.find("there is no ink"), std::string::npos);
}

TEST(Pipeline, ARegionTracesOnlyWhatLiesInside) {
  StageCache cache;
  const auto whole = run({}, cache);
  ASSERT_FALSE(whole.error);
  ASSERT_EQ(whole.contours->contours.size(), 1u);
  Recipe recipe;
  recipe.regions = {rectangleRegion({0, 0}, {200, 300})};
  const auto half = run(recipe, cache);
  ASSERT_FALSE(half.error) << half.error->message;
  ASSERT_EQ(half.contours->contours.size(), 1u);
  EXPECT_FALSE(half.contours->contours[0].closed);
  EXPECT_NEAR(half.contours->contours[0].lengthPx / whole.contours->contours[0].lengthPx, 0.5, 0.05);
  for (const ContourPoint& p : half.contours->contours[0].points) EXPECT_LT(p.at.x(), 200.0);
  recipe.regions = {rectangleRegion({0, 0}, {4, 4})};
  const auto none = run(recipe, cache);
  ASSERT_TRUE(none.error);
  EXPECT_EQ(none.error->code, ErrorCode::NoCurve);
  EXPECT_NE(none.error->message.find("region"), std::string::npos);
}

TEST(Pipeline, ChoicesOutliveAThresholdThatMovesAndComesBack) {
  StageCache cache;
  Recipe recipe;
  const auto before = run(recipe, cache);
  ASSERT_FALSE(before.error);
  PieceChoice choice;
  choice.anchorsPx = {anchorOf(before.pieces->pieces[0])};
  choice.included = false;
  recipe.choices = {choice};
  recipe.extremumChoices = {{before.pieces->pieces[0].points[5].at, true}};
  recipe.cornerMarks = {{Vec2(200, 40)}};
  recipe.corners.snapDistancePx = 60.0;
  const auto chosen = run(recipe, cache);
  ASSERT_FALSE(chosen.error);
  ASSERT_EQ(chosen.pieces->corners.size(), 1u);
  // Slightly moved: the same line, a little elsewhere. Everything still holds.
  Recipe moved = recipe;
  moved.threshold.mode = ThresholdMode::Manual;
  for (const double level : {90.0, 150.0, 190.0}) {
    moved.threshold.manualLevel = level;
    const auto out = run(moved, cache);
    ASSERT_FALSE(out.error) << level;
    EXPECT_EQ(out.pieces->corners.size(), 1u) << level;
    for (const TracedCurve& c : out.faired->curves) EXPECT_FALSE(c.included) << level;
    EXPECT_EQ(assignExtremumChoices(*out.pieces, moved)[0].size(), 1u) << level;
  }
  // So far that the line is gone: nothing to choose from, and nothing forgotten.
  moved.threshold.manualLevel = 1.0;
  EXPECT_TRUE(run(moved, cache).error);
  moved.threshold = recipe.threshold;
  EXPECT_EQ(moved, recipe);
  const auto back = run(moved, cache);
  EXPECT_FALSE(back.faired->curves[0].included);
  EXPECT_EQ(back.pieces->corners.size(), 1u);
}

TEST(Report, HoldsStagesCurvesAndTargetsWithoutNaN) {
  StageCache cache;
  Recipe recipe;
  recipe.fairing.mode = FairingMode::Target;
  const auto out = run(recipe, cache);
  ASSERT_FALSE(out.error);
  ReportExtras extras;
  extras.peakMemoryBytes = 123;
  auto targets = targetsFor(out.faired->curves[0], {});
  ASSERT_TRUE(targets);
  extras.targets.push_back(std::move(targets));
  const auto json = nlohmann::json::parse(reportToJson(test::ellipseScan(), recipe, out, extras));
  EXPECT_EQ(json["stages"].size(), kStages.size());
  ASSERT_EQ(json["curves"].size(), 1u);
  const auto& curve = json["curves"][0];
  EXPECT_EQ(curve["targets"].size(), 6u);
  EXPECT_EQ(curve["sketched"]["control_points"], out.faired->curves[0].sketched.controlPointCount());
  const double px = curve["faired"]["deviation_from_points"]["rms"]["px"],
               mm = curve["faired"]["deviation_from_points"]["rms"]["mm"];
  EXPECT_NEAR(px * out.frame.mmPerPx, mm, 1e-12);
  EXPECT_EQ(json["peak_memory_bytes"], 123);
  EXPECT_FALSE(curve["fairing"]["stopped"].get<std::string>().empty());
}

TEST(Report, SaysThatTooManyCurvesAreNotCompared) {
  StageCache cache;
  auto out = run({}, cache);
  ASSERT_FALSE(out.error);
  const auto report = [&](std::size_t count) {
    FairedSet many;
    many.curves.assign(count, out.faired->curves[0]);
    out.faired = std::make_shared<const FairedSet>(std::move(many));
    return nlohmann::json::parse(reportToJson(test::ellipseScan(), {}, out, {}));
  };
  const auto few = report(3), more = report(61);
  EXPECT_FALSE(few.contains("most_alike_note"));
  EXPECT_TRUE(few["curves"][0].contains("most_alike"));
  EXPECT_NE(more.value("most_alike_note", "").find("61"), std::string::npos);
  EXPECT_FALSE(more["curves"][0].contains("most_alike"));
}

}  // namespace
}  // namespace batten
