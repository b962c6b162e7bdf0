// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of which it is known what is a stroke and what a shape, traced by default.
#include "core/contour/ink/ink_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/centreline/on_ink.h"
#include "core/contour/trace_contours.h"
#include "core/image/bits/bit_steps.h"
#include "tests/support/label_page.h"

namespace batten {
namespace {

const Vec2 kCentre(150.0, 150.0);
constexpr double kWheelRadius = 60.0, kPen = 5.0;

// A black disc with a round hole; a line runs into it from the right and another from below.
test::LabelPage wheel() {
  test::LabelPage page(420, 420);
  page.begin(true);
  page.area({test::circle(kCentre, kWheelRadius), test::circle(kCentre, 20.0)});
  page.begin(false);
  page.line({kCentre + Vec2(50, 0), Vec2(400, 150)}, kPen);
  page.begin(false);
  page.line({kCentre + Vec2(0, 50), Vec2(150, 400)}, kPen);
  return page;
}

ContourSet traced(const test::LabelPage& page, const EdgeParams& edges = {}, const ContourParams& params = {}) {
  auto set = traceContours(page.ink(1), page.grey(1), edges, params, {});
  EXPECT_TRUE(set.has_value()) << (set ? "" : set.error().message);
  return set ? std::move(*set) : ContourSet{};
}

std::vector<const Contour*> linesOf(const ContourSet& set, ContourKind kind) {
  std::vector<const Contour*> found;
  for (const Contour& c : set.contours) {
    if (c.kind == kind) found.push_back(&c);
  }
  return found;
}

double fromCentre(const Vec2& p) { return (p - kCentre).norm(); }

TEST(InkSplit, ASolidIsFollowedByItsBorderAndItsLinesEndAtTheRim) {
  const ContourSet set = traced(wheel());
  const auto borders = linesOf(set, ContourKind::Outline), lines = linesOf(set, ContourKind::Centreline);
  ASSERT_EQ(borders.size(), 2u);
  EXPECT_FALSE(borders[0]->hole);
  EXPECT_TRUE(borders[1]->hole) << "holes of shapes are followed by default";
  for (const ContourPoint& p : borders[0]->points) EXPECT_NEAR(fromCentre(p.at), kWheelRadius, 1.0);
  for (const ContourPoint& p : borders[1]->points) EXPECT_NEAR(fromCentre(p.at), 20.0, 0.5);
  EXPECT_EQ(borders[0]->bridges.size(), 2u) << "the mouths of both lines";
  for (const auto& [first, last] : borders[0]->bridges) {
    EXPECT_NEAR((borders[0]->points[first].at - borders[0]->points[last].at).norm(), kPen, 7.0);
    for (int i = first; i <= last; ++i) EXPECT_FALSE(borders[0]->points[i].refined);
  }
  ASSERT_EQ(lines.size(), 2u);
  for (const Contour* line : lines) {
    double nearest = 1e9, farthest = 0.0;
    for (const ContourPoint& p : line->points) {
      nearest = std::min(nearest, fromCentre(p.at));
      farthest = std::max(farthest, fromCentre(p.at));
      EXPECT_LT(std::min(std::abs(p.at.x() - 150.0), std::abs(p.at.y() - 150.0)), 0.6);
    }
    EXPECT_NEAR(nearest, kWheelRadius, 3.0) << "a T at the rim";
    EXPECT_NEAR(farthest, 252.5, 3.5);
  }
}

// Two lines of a pen that meet at an angle; the pen filled the corner between them.
test::LabelPage filledCorner() {
  test::LabelPage page(420, 420);
  page.begin(false);
  page.line({Vec2(60, 380), Vec2(150, 60)}, kPen);
  page.line({Vec2(150, 60), Vec2(380, 60)}, kPen);
  page.line({Vec2(132, 125), Vec2(200, 60)}, kPen);
  page.begin(true);
  page.area({{Vec2(150, 60), Vec2(132, 125), Vec2(200, 60)}});
  return page;
}

TEST(InkSplit, WhatStrokesEncloseAndFillIsFollowedAlongItsBorder) {
  const ContourSet set = traced(filledCorner());
  bool isFollowed = false;
  for (const Contour* border : linesOf(set, ContourKind::Outline)) {
    double left = 1e9, right = 0.0;
    for (const ContourPoint& p : border->points) {
      left = std::min(left, p.at.x());
      right = std::max(right, p.at.x());
    }
    isFollowed = isFollowed || (left < 160.0 && right > 165.0);
  }
  EXPECT_TRUE(isFollowed);
}

// A crossing of a thin and a thick line, a Y and a T of one pen: ink that the lines explain.
TEST(InkSplit, JunctionsOfStrokesAreNoFillings) {
  test::LabelPage page(420, 420);
  page.begin(false);
  page.line({Vec2(40, 60), Vec2(380, 120)}, 9.0);
  page.line({Vec2(200, 30), Vec2(180, 200)}, kPen);
  page.line({Vec2(60, 380), Vec2(150, 300)}, kPen);
  page.line({Vec2(150, 300), Vec2(60, 240)}, kPen);
  page.line({Vec2(150, 300), Vec2(380, 300)}, kPen);
  page.line({Vec2(300, 300), Vec2(300, 390)}, kPen);
  EXPECT_TRUE(linesOf(traced(page), ContourKind::Outline).empty());
}

struct Fan {
  int lines;
  double spreadDeg, apartPx;  // from the first to the last; between their meeting points along a circle
};

// Lines that cross nearly in one point, at angles of 15 to 45 degrees: the ink is up to four pens wide there, but most
// of its border are the lines themselves.
TEST(InkSplit, CrossingsOfManyStrokesAreNoShapes) {
  for (const Fan& fan :
       {Fan{3, 30.0, 0.0}, Fan{3, 40.0, 3.0}, Fan{4, 70.0, 2.0}, Fan{5, 144.0, 3.0}, Fan{6, 150.0, 2.0}}) {
    test::LabelPage page(420, 420);
    page.begin(false);
    for (int i = 0; i < fan.lines; ++i) {
      const double angle = std::numbers::pi / 180.0 * (20.0 + fan.spreadDeg * i / (fan.lines - 1));
      const Vec2 at = Vec2(210, 210) + fan.apartPx * Vec2(std::cos(3.0 * angle), std::sin(3.0 * angle));
      const Vec2 half = 180.0 * Vec2(std::cos(angle), std::sin(angle));
      page.line({at - half, at + half}, kPen);
    }
    EXPECT_TRUE(linesOf(traced(page), ContourKind::Outline).empty()) << fan.lines << " lines over " << fan.spreadDeg;
  }
}

// The same fans of a thicker pen, on a page that is mostly thin lines.
TEST(InkSplit, CrossingsOfThickStrokesAmongThinOnesAreNoShapes) {
  for (const Fan& fan : {Fan{4, 36.0, 2.0}, Fan{4, 40.0, 3.0}, Fan{5, 70.0, 2.0}, Fan{5, 80.0, 2.0}, Fan{5, 100.0, 2.0},
                         Fan{6, 110.0, 2.0}, Fan{6, 150.0, 2.0}}) {
    test::LabelPage page(900, 800);
    page.begin(false);
    for (int i = 0; i < 12; ++i) page.line({Vec2(480, 20 + 60 * i), Vec2(880, 30 + 60 * i)}, 3.0);
    for (int i = 0; i < fan.lines; ++i) {
      const double angle = std::numbers::pi / 180.0 * (20.0 + fan.spreadDeg * i / (fan.lines - 1));
      const Vec2 at = Vec2(200, 210) + 1.6 * fan.apartPx * Vec2(std::cos(3.0 * angle), std::sin(3.0 * angle));
      const Vec2 half = 170.0 * Vec2(std::cos(angle), std::sin(angle));
      page.line({at - half, at + half}, 9.0);
    }
    EXPECT_TRUE(linesOf(traced(page), ContourKind::Outline).empty()) << fan.lines << " lines over " << fan.spreadDeg;
  }
}

// A stub that was drawn twice, hardly longer than it is wide, on a line and at its end.
TEST(InkSplit, ShortDoubledStrokesAreNoFillings) {
  for (const double apart : {3.0, 4.0}) {
    for (const double length : {10.0, 12.0, 14.0}) {
      test::LabelPage page(420, 420);
      page.begin(false);
      page.line({Vec2(40, 240), Vec2(390, 240)}, kPen);
      page.line({Vec2(200, 240), Vec2(200, 240 - length)}, kPen);
      page.line({Vec2(200 + apart, 240), Vec2(200 + apart, 240 - length)}, kPen);
      page.line({Vec2(40, 100), Vec2(390, 100)}, kPen);
      page.line({Vec2(390 - length, 100 - apart), Vec2(390, 100 - apart)}, kPen);
      page.line({Vec2(390 - length, 100 + apart), Vec2(390, 100)}, kPen);
      EXPECT_TRUE(linesOf(traced(page), ContourKind::Outline).empty()) << apart << ", " << length;
    }
  }
}

// Two lines of a thicker pen that cross twice at a shallow angle, among thin lines: where they run together the ink is
// far wider than most lines of the page, but it is a ribbon that lines run through.
TEST(InkSplit, RibbonsOfStrokesHaveNoOutlinesWithin) {
  for (const double width : {9.0, 10.0, 11.0}) {
    for (const double sway : {14.0, 16.0, 18.0}) {
      const double apart = width + 3.0;
      test::LabelPage page(520, 420);
      page.begin(false);
      for (int i = 0; i < 8; ++i) page.line({Vec2(30, 200 + 25 * i), Vec2(480, 190 + 25 * i)}, kPen);
      page.line({Vec2(40, 80), Vec2(240, 80 + sway), Vec2(480, 80)}, width);
      page.line({Vec2(40, 80 + apart), Vec2(240, 80 + apart - sway), Vec2(480, 80 + apart)}, width);
      EXPECT_TRUE(linesOf(traced(page), ContourKind::Outline).empty()) << width << ", " << sway;
    }
  }
}

// A dot of four pens where four lines meet stays one.
TEST(InkSplit, DotsOnCrossingsStayShapes) {
  test::LabelPage page(420, 420);
  page.begin(false);
  page.line({Vec2(60, 210), Vec2(360, 210)}, kPen);
  page.line({Vec2(210, 60), Vec2(210, 360)}, kPen);
  page.begin(true);
  page.area({test::circle(Vec2(210, 210), 2.0 * kPen)});
  EXPECT_EQ(linesOf(traced(page), ContourKind::Outline).size(), 1u);
}

// The same of thick lines, on a page that is mostly thin ones.
TEST(InkSplit, DotsOnCrossingsOfThickStrokesStayShapes) {
  test::LabelPage page(900, 800);
  page.begin(false);
  for (int i = 0; i < 12; ++i) page.line({Vec2(480, 20 + 60 * i), Vec2(880, 30 + 60 * i)}, 3.0);
  page.line({Vec2(60, 210), Vec2(360, 210)}, 9.0);
  page.line({Vec2(210, 60), Vec2(210, 360)}, 9.0);
  page.begin(true);
  page.area({test::circle(Vec2(210, 210), 18.0)});
  EXPECT_EQ(linesOf(traced(page), ContourKind::Outline).size(), 1u);
}

TEST(InkSplit, HolesGoWhereTheyAreNotWanted) {
  EdgeParams edges;
  edges.internal = InnerBorders::Off;
  const ContourSet set = traced(wheel(), edges);
  EXPECT_EQ(linesOf(set, ContourKind::Outline).size(), 1u);
  EXPECT_EQ(set.report.droppedHoles, 1);
}

TEST(InkSplit, AChoiceTurnsItsRegionAndNotThePieceOfInk) {
  EdgeParams edges;
  edges.choices = {{Vec2(300, 150), EdgeMode::Outline}};
  const ContourSet set = traced(wheel(), edges);
  const auto lines = linesOf(set, ContourKind::Centreline);
  ASSERT_EQ(lines.size(), 1u) << "the line below stays one";
  EXPECT_LT(std::abs(lines[0]->points.front().at.x() - 150.0), 3.0);
  EXPECT_FALSE(lines[0]->traceMode);
  const auto borders = linesOf(set, ContourKind::Outline);
  ASSERT_EQ(borders.size(), 2u);
  double farthest = 0.0;
  for (const ContourPoint& p : borders[0]->points) farthest = std::max(farthest, p.at.x());
  EXPECT_NEAR(farthest, 402.5, 1.5);
}

TEST(InkSplit, AChoiceLivesOnWhenTheInkGrows) {
  const test::LabelPage page = wheel();
  EdgeParams edges;
  edges.choices = {{Vec2(300, 150), EdgeMode::Outline}};
  for (const double reach : {0.0, 1.0}) {
    BitImage ink = page.ink(1);
    if (reach > 0.0) ink = grown(ink, 1, {});
    const auto set = traceContours(ink, page.grey(1), edges, {}, {});
    ASSERT_TRUE(set);
    EXPECT_EQ(linesOf(*set, ContourKind::Centreline).size(), 1u) << reach;
    EXPECT_TRUE(set->report.note.find("No ink") == std::string::npos) << set->report.note;
  }
}

TEST(InkSplit, RegionsAreConnectedPartsOfOneKind) {
  EdgeParams edges;
  edges.choices = {{Vec2(300, 150), EdgeMode::Automatic}};
  const test::LabelPage page = wheel();
  const auto split = splitInk(page.ink(1), page.grey(1), edges, {});
  ASSERT_TRUE(split);
  const auto disc = pieceAt(split->regions, 100, 150), right = pieceAt(split->regions, 300, 150),
             below = pieceAt(split->regions, 150, 300);
  ASSERT_TRUE(disc && right && below);
  EXPECT_NE(*disc, *right);
  EXPECT_NE(*right, *below);
  EXPECT_EQ(pieceAt(split->regions, 200, 150), disc);
  EXPECT_FALSE(pieceAt(split->regions, 150, 150)) << "paper";
  EXPECT_NEAR(split->penPx.value_or(0.0), kPen, 1.5) << "told on whole pixels";
}

// Lines of 2.5 and 6 widths beside long ones, with a thin and a broad pen.
TEST(InkSplit, TheShortestLineIsCountedInWidths) {
  for (const double pen : {3.0, 9.0}) {
    test::LabelPage page(600, 400);
    page.begin(false);
    page.line({Vec2(50, 60), Vec2(550, 60)}, pen);
    page.line({Vec2(50, 120), Vec2(50 + 7.0 * pen, 120)}, pen);
    const auto found = [&](double widths, double px) {
      ContourParams params;
      params.minWidths = widths;
      params.minLengthPx = px;
      return traced(page, {}, params).contours.size();
    };
    EXPECT_EQ(found(3.0, 0.0), 2u) << pen;
    EXPECT_EQ(found(16.0, 0.0), 1u) << pen;
    EXPECT_EQ(found(3.0, 12.0 * pen), 1u) << pen;
  }
}

TEST(InkSplit, WhatIsLeftOutIsTold) {
  test::LabelPage page(600, 400);
  page.begin(false);
  page.line({Vec2(50, 60), Vec2(550, 60)}, 6.0);
  page.line({Vec2(50, 120), Vec2(90, 120)}, 6.0);
  ContourParams params;
  params.minWidths = 10.0;
  EXPECT_NE(traced(page, {}, params).report.note.find("short line was dropped"), std::string::npos);
  EdgeParams old;
  old.strokeWidth = 0.05;
  EXPECT_NE(traced(page, old).report.note.find("edges.stroke_width has no effect"), std::string::npos);
  EXPECT_EQ(traced(page).report.note, "");
}

// A straight line over a gap in the ink, announced or not.
TEST(OnInk, ALineIsCutWhereItRunsOverPaperUnannounced) {
  BitImage ink(300, 40);
  for (int y = 18; y < 22; ++y) {
    for (int x = 10; x < 290; ++x) ink.set(x, y, x < 120 || x >= 160);
  }
  Contour line;
  line.kind = ContourKind::Centreline;
  for (int i = 0; i <= 270; ++i) {
    const Vec2 at(12.0 + i, 20.0);
    line.points.push_back({.at = at, .unrefined = at, .refined = true, .widthPx = 4.0f});
  }
  const auto cut = keepOnInk({line}, ink);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_NEAR(cut[0].points.back().at.x(), 120.0, 3.0);
  EXPECT_NEAR(cut[1].points.front().at.x(), 160.0, 3.0);
  line.bridges = {{106, 150}};
  const auto whole = keepOnInk({line}, ink);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].points.size(), line.points.size());
  // A bridge that leads nowhere is no part of a line.
  for (int x = 160; x < 290; ++x) {
    for (int y = 18; y < 22; ++y) ink.set(x, y, false);
  }
  const auto end = keepOnInk({line}, ink);
  ASSERT_EQ(end.size(), 1u);
  EXPECT_NEAR(end[0].points.back().at.x(), 120.0, 3.0);
  EXPECT_TRUE(end[0].bridges.empty());
}

TEST(OnInk, AClosedLineOpensWhereThereIsNoInk) {
  BitImage ink(200, 200);
  Contour ring;
  ring.kind = ContourKind::Centreline;
  ring.closed = true;
  for (int i = 0; i < 360; ++i) {
    const double a = i * std::numbers::pi / 180.0;
    const Vec2 at = Vec2(100, 100) + 70.0 * Vec2(std::cos(a), std::sin(a));
    ring.points.push_back({.at = at, .unrefined = at, .refined = true, .widthPx = 3.0f});
    if (i < 80 || i > 110) ink.set(static_cast<int>(at.x()), static_cast<int>(at.y()), true);
  }
  const auto open = keepOnInk({ring}, ink);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_FALSE(open[0].closed);
  EXPECT_NEAR(open[0].lengthPx, 70.0 * 2.0 * std::numbers::pi * 329.0 / 360.0, 8.0);
}

}  // namespace
}  // namespace batten
