// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/explain/explanation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/document/report.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/threshold/binarize.h"
#include "tests/support/label_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

/// A page with two lines, a solid and nothing else.
struct Drawing {
  Scan scan;
  Recipe recipe;
  PipelineOutput out;

  Drawing() {
    test::LabelPage page(500, 400);
    page.begin(false);
    page.line({{40, 60}, {460, 80}}, 5.0);
    page.line({{40, 330}, {460, 350}}, 5.0);
    page.begin(true);
    page.area({test::circle({250, 200}, 60)});
    scan = test::renderPage(std::vector<float>(500 * 400, 0.0f), 500, 400, test::cleanPage());
    scan.grey = page.grey(1);
    StageCache cache;
    out = runPipeline(scan, recipe, cache, {}, {});
  }
  Explanation explain() const {
    const auto explanation = explainPage(scan, recipe, out, {});
    EXPECT_TRUE(explanation);
    return explanation ? *explanation : Explanation{};
  }
  /// Moves every point of the straight curve nearest to the top by this many px down.
  void shiftTopLine(double px) {
    FairedSet moved = *out.faired;
    for (TracedCurve& c : moved.curves) {
      if (out.frame.pointToImage(c.faired.controlPoints().front()).y() > 100) continue;
      std::vector<Vec2> points(c.faired.controlPoints().begin(), c.faired.controlPoints().end());
      for (Vec2& p : points) p.y() -= out.frame.lengthToModel(px);
      c.faired =
          NurbsCurve::make(c.faired.degree(), {c.faired.knots().begin(), c.faired.knots().end()}, points).value();
    }
    out.faired = std::make_shared<FairedSet>(moved);
  }
  void exclude(bool top) {
    FairedSet some = *out.faired;
    for (TracedCurve& c : some.curves) {
      const double y = out.frame.pointToImage(c.faired.controlPoints().front()).y();
      c.included = top ? y > 100 : y > 100 && y < 300;
    }
    out.faired = std::make_shared<FairedSet>(some);
  }
};

TEST(Explanation, CurvesOnTheirInkExplainItAll) {
  const Drawing drawing;
  ASSERT_TRUE(drawing.out.faired);
  const Explanation e = drawing.explain();
  EXPECT_GT(e.explained, 0.995);
  EXPECT_NEAR(e.explained + e.missed, 1.0, 1e-12);
  EXPECT_EQ(e.invented, 0.0);
  EXPECT_TRUE(e.inventions.empty());
  EXPECT_TRUE(e.note.empty()) << e.note;
  EXPECT_NEAR(e.curvesPx, 2 * 420.0 + 2 * 60.0 * 3.1416, 15.0);
}

TEST(Explanation, TheMarginOfTheScannerIsNoInkToExplain) {
  Drawing drawing;
  const Explanation before = drawing.explain();
  for (int y = 0; y < 400; ++y) {
    for (int x = 492; x < 500; ++x) drawing.scan.grey.row(y)[x] = 20 * GreyImage::kGreyUnit;
  }
  const Explanation e = drawing.explain();
  EXPECT_NEAR(static_cast<double>(e.referencePx), static_cast<double>(before.referencePx), 400.0);
  EXPECT_GT(e.explained, 0.99);
}

TEST(Explanation, TheEdgeOfASheetIsNoInkToExplain) {
  Drawing drawing;
  for (int y = 366; y < 400; ++y) {
    for (int x = 0; x < 500; ++x) drawing.scan.grey.row(y)[x] = static_cast<std::uint16_t>(257 * (y < 369 ? 90 : 205));
  }
  StageCache cache;
  drawing.out = runPipeline(drawing.scan, drawing.recipe, cache, {}, {});
  ASSERT_TRUE(drawing.out.contours);
  EXPECT_EQ(drawing.out.contours->contours.size(), 3u);
  ASSERT_EQ(drawing.out.contours->sheetEdges.size(), 1u);
  EXPECT_GT(drawing.explain().explained, 0.98);
}

// A line that is too faint for the reference is seen along its length all the same.
TEST(Explanation, AFaintLineIsNotInvented) {
  Drawing drawing;
  drawing.shiftTopLine(35.0);
  EXPECT_GT(drawing.explain().invented, 0.3) << "over paper";
  test::LabelPage faint(500, 400);
  faint.begin(false);
  faint.line({{40, 95}, {460, 115}}, 5.0);
  const BitImage line = faint.ink(1);
  constexpr int kFaint = 20;  // [grey]
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 500; ++x) {
      if (line.at(x, y)) drawing.scan.grey.row(y)[x] -= kFaint * GreyImage::kGreyUnit;
    }
  }
  const Explanation e = drawing.explain();
  EXPECT_EQ(e.invented, 0.0);
  EXPECT_GT(e.missed, 0.05) << "the ink that the curve left";
}

// At the lower contrast of the reference a faint line runs together with the tone around it and is no line any more.
TEST(Explanation, WhatIsInkByDefaultIsInkToExplain) {
  Drawing drawing;
  test::LabelPage toned(500, 400), lined(500, 400);
  toned.begin(true);
  toned.area({{{60, 100}, {180, 100}, {180, 300}, {60, 300}}});
  lined.begin(false);
  lined.line({{80, 120}, {160, 280}}, 5.0);
  const BitImage tone = toned.ink(1), line = lined.ink(1);
  constexpr int kTone = 38, kLine = 30;  // [grey]
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 500; ++x) {
      // The tone has no edge: it fades over 50 px.
      const double inside = std::min({x - 60, 180 - x, y - 100, 300 - y}) / 50.0;
      const int depth =
          (tone.at(x, y) ? static_cast<int>(kTone * std::clamp(inside, 0.0, 1.0)) : 0) + (line.at(x, y) ? kLine : 0);
      drawing.scan.grey.row(y)[x] -= depth * GreyImage::kGreyUnit;
    }
  }
  const auto thresholds = findThresholds(drawing.scan.grey, {}, {}, {});
  ASSERT_TRUE(thresholds);
  const auto ink = binarize(drawing.scan.grey, *thresholds, {}, {});
  ASSERT_TRUE(ink);
  ASSERT_TRUE(ink->at(120, 200)) << "the faint line";
  FairedSet none = *drawing.out.faired;
  for (TracedCurve& c : none.curves) c.included = false;
  drawing.out.faired = std::make_shared<FairedSet>(none);
  EXPECT_EQ(without(*ink, drawing.explain().missedInk).count(), 0);
}

TEST(Explanation, InkWithoutACurveIsMissed) {
  Drawing drawing;
  const auto all = static_cast<double>(drawing.explain().referencePx);
  drawing.exclude(true);
  const Explanation e = drawing.explain();
  // A line of 5 px, which is up to 2 px wider at low contrast.
  EXPECT_GT(e.missed, 421.0 * 5.0 / all);
  EXPECT_LT(e.missed, 425.0 * 7.0 / all);
  EXPECT_EQ(e.missedInk.count(), std::llround(e.missed * all));
  EXPECT_TRUE(e.missedInk.at(250, 70));
  EXPECT_FALSE(e.missedInk.at(250, 200));
  EXPECT_NE(e.note.find("threshold.strength"), std::string::npos) << e.note;
  // A curve that stands for several strokes need not cover them: no threshold would help.
  drawing.recipe.edges.intent = true;
  const std::string note = drawing.explain().note;
  EXPECT_EQ(note.find("threshold.strength"), std::string::npos) << note;
  EXPECT_NE(note.find("edges.intent=false"), std::string::npos) << note;
}

TEST(Explanation, ACurveBesideItsInkIsInvented) {
  Drawing drawing;
  drawing.shiftTopLine(4.0);  // half the width of the line is still ink
  EXPECT_EQ(drawing.explain().invented, 0.0);
  drawing.shiftTopLine(10.0);
  const Explanation e = drawing.explain();
  EXPECT_NEAR(e.invented, 420.0 / e.curvesPx, 0.02);
  ASSERT_EQ(e.inventions.size(), 1u);
  EXPECT_NEAR(e.inventions[0].lengthPx, 420.0, 15.0);
  EXPECT_FALSE(e.note.empty());
}

// A pencil's grain fades into the paper. Of its points no noise is known apart from the grain.
TEST(Explanation, APencilIsHeldAgainstLessThanAPen) {
  Drawing drawing;
  EXPECT_EQ(drawing.explain().leastExplained, kLeastExplainedPen);
  ContourSet lines = *drawing.out.contours;
  for (Contour& c : lines.contours) {
    for (ContourPoint& p : c.points) p.sigmaPx.reset();
  }
  drawing.out.contours = std::make_shared<ContourSet>(lines);
  EXPECT_EQ(drawing.explain().leastExplained, kLeastExplainedPencil);
  // What misses its limit says which; the report holds the same.
  drawing.exclude(true);
  const Explanation e = drawing.explain();
  EXPECT_FALSE(e.isExplained());
  EXPECT_NE(e.note.find("less than 92.0 %"), std::string::npos) << e.note;
  ReportExtras extras;
  extras.explanation = e;
  const auto json = nlohmann::json::parse(reportToJson(drawing.scan, {}, drawing.out, extras));
  EXPECT_EQ(json["explanation"]["note"], e.note);
  EXPECT_EQ(json["explanation"]["least_explained"], kLeastExplainedPencil);
}

TEST(Explanation, ADeclaredBridgeIsNotInvented) {
  Drawing drawing;
  drawing.shiftTopLine(14.0);
  ContourSet lines = *drawing.out.contours;
  for (Contour& c : lines.contours) {
    if (c.points.front().at.y() > 100) continue;
    for (ContourPoint& p : c.points) p.at.y() += 14.0;
    c.bridges = {{0, static_cast<int>(c.points.size()) - 1}};
  }
  drawing.out.contours = std::make_shared<ContourSet>(lines);
  EXPECT_LT(drawing.explain().invented, 0.01);
}

/// What the outer border of a ring alone explains, its radius 120 px.
double explainedByOuterBorder(double innerRadiusPx) {
  Drawing drawing;
  test::LabelPage page(500, 400);
  page.begin(true);
  page.area({test::circle({250, 200}, 120), test::circle({250, 200}, innerRadiusPx)});
  drawing.scan.grey = page.grey(2);
  drawing.recipe.edges.mode = EdgeMode::Outline;
  StageCache cache;
  drawing.out = runPipeline(drawing.scan, drawing.recipe, cache, {}, {});
  FairedSet outer = *drawing.out.faired;
  for (TracedCurve& c : outer.curves) c.included = !drawing.out.contours->contours[c.contour].hole;
  drawing.out.faired = std::make_shared<FairedSet>(outer);
  return drawing.explain().explained;
}

TEST(Explanation, AnOutlineAroundPaperExplainsItsBorderOnly) {
  EXPECT_LT(explainedByOuterBorder(90.0), 0.2) << "more paper than ink";
}

TEST(Explanation, AnOutlineAroundShadingWithAHighlightExplainsIt) { EXPECT_GT(explainedByOuterBorder(60.0), 0.97); }

TEST(Explanation, StandsInTheReportWhereAsked) {
  const Drawing drawing;
  ReportExtras extras;
  EXPECT_FALSE(nlohmann::json::parse(reportToJson(drawing.scan, {}, drawing.out, extras)).contains("explanation"));
  extras.explanation = drawing.explain();
  const auto json = nlohmann::json::parse(reportToJson(drawing.scan, {}, drawing.out, extras));
  EXPECT_GT(json["explanation"]["explained"].get<double>(), 0.99);
  EXPECT_EQ(json["explanation"]["invented"].get<double>(), 0.0);
}

TEST(Explanation, ACancelledRunSaysSo) {
  const Drawing drawing;
  RunContext context;
  context.cancel.cancel();
  const auto e = explainPage(drawing.scan, drawing.recipe, drawing.out, context);
  ASSERT_FALSE(e);
  EXPECT_EQ(e.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
