// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/pen_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/contour/corner/corner_marks.h"

namespace batten {
namespace {

TEST(PenStroke, NeedsTwoDifferentPlaces) {
  EXPECT_FALSE(validate(PenStroke{{{0, 0}, {3, 4}}, false}));
  EXPECT_TRUE(validate(PenStroke{{}, false}));
  EXPECT_TRUE(validate(PenStroke{{{1, 1}, {1, 1}, {1, 1}}, false}));
  EXPECT_TRUE(validate(PenStroke{{{0, 0}, {3, 4}, {0, 0}}, true}));
  EXPECT_TRUE(validate(PenStroke{{{0, 0}, {std::nan(""), 4}}, false}));
  EXPECT_TRUE(validate(PenStroke{{{0, 0}, {std::numeric_limits<double>::infinity(), 4}}, false}));
}

TEST(PenContour, KeepsEveryDrawnPointAndFillsTheWayBetween) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> where(0.0, 300.0);
  for (const bool closed : {false, true}) {
    PenStroke stroke;
    stroke.closed = closed;
    double length = 0.0;
    for (int i = 0; i < 40; ++i) {
      stroke.points.emplace_back(where(random), where(random));
      if (i % 7 == 0) stroke.points.push_back(stroke.points.back());  // the pen rested
    }
    for (std::size_t i = 1; i < stroke.points.size(); ++i) length += (stroke.points[i] - stroke.points[i - 1]).norm();
    if (closed) length += (stroke.points.front() - stroke.points.back()).norm();
    const Contour contour = penContour(stroke);
    EXPECT_EQ(contour.kind, ContourKind::Pen);
    EXPECT_EQ(contour.closed, closed);
    EXPECT_NEAR(contour.lengthPx, length, 1e-9 * length);
    std::vector<Vec2> drawn;
    double along = 0.0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      if (contour.points[i].refined) drawn.push_back(contour.points[i].at);
      if (i == 0) continue;
      const double step = (contour.points[i].at - contour.points[i - 1].at).norm();
      EXPECT_LE(step, 1.0 + 1e-12);
      EXPECT_GT(step, 0.0);
      along += step;
    }
    auto expected = stroke.points;
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(drawn, expected);
    if (closed) along += (contour.points.front().at - contour.points.back().at).norm();
    EXPECT_NEAR(along, length, 1e-9 * length);
  }
}

TEST(PenContour, IsCutAtTheDrawnPointNearestToAMark) {
  // A right angle of five drawn points; the marks miss by a little, and one is out of reach.
  const PenStroke stroke{{{10, 10}, {60, 10}, {110, 10}, {110, 60}, {110, 110}}, false};
  const ContourSet set = withPenStrokes({}, std::vector<PenStroke>{stroke}, {200.0, 200.0}).value();
  const std::vector<CornerMark> marks = {{Vec2(104, 13)}, {Vec2(300, 300)}};
  for (const bool exact : {true, false}) {
    CornerParams params;
    params.exact = exact;
    const auto pieces = splitAtCorners(set, marks, params, {});
    ASSERT_TRUE(pieces);
    ASSERT_EQ(pieces->corners.size(), 1u);
    EXPECT_EQ(pieces->corners[0].positionPx, Vec2(110, 10));
    EXPECT_EQ(pieces->lostMarks, std::vector<int>{1});
    ASSERT_EQ(pieces->pieces.size(), 2u);
    EXPECT_EQ(pieces->pieces[0].points.back().at, Vec2(110, 10));
    EXPECT_EQ(pieces->pieces[1].points.front().at, Vec2(110, 10));
    EXPECT_EQ(pieces->pieces[0].points.front().at, Vec2(10, 10));
    EXPECT_EQ(pieces->pieces[1].points.back().at, Vec2(110, 110));
    for (const Piece& piece : pieces->pieces) {
      EXPECT_EQ(std::ranges::count(piece.points, true, &PiecePoint::refined), 3) << "the drawn points, corner included";
    }
    EXPECT_NEAR(pieces->pieces[0].lengthPx + pieces->pieces[1].lengthPx, 200.0, 1e-9);
  }
}

constexpr PageExtent kPenPage{100.0, 80.0};

// What the strokes of a drawing become on a page.
ContourSet onPage(const std::vector<PenStroke>& strokes) {
  const auto set = withPenStrokes({}, strokes, kPenPage);
  EXPECT_TRUE(set.has_value());
  return set.value_or(ContourSet{});
}

TEST(PenStrokes, AreCutToThePage) {
  const ContourSet set = onPage({{{{-1e6, 40.0}, {1e6, 40.0}}, false}});
  ASSERT_EQ(set.contours.size(), 1u);
  const Contour& line = set.contours[0];
  EXPECT_NEAR(line.lengthPx, 100.0, 1e-6);
  EXPECT_LE(line.points.size(), 102u);
  EXPECT_NEAR((line.points.front().at - Vec2(0.0, 40.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((line.points.back().at - Vec2(100.0, 40.0)).norm(), 0.0, 1e-6);
  EXPECT_NE(set.report.note.find("1 pen stroke leaves the page"), std::string::npos) << set.report.note;
}

TEST(PenStrokes, KeepTheirLongestPartWhereTheyLeaveThePageAndComeBack) {
  // 30 px on the page, out over the right border, back in for 60 px.
  const ContourSet set = onPage({{{{70.0, 20.0}, {130.0, 20.0}, {130.0, 50.0}, {40.0, 50.0}}, false}});
  EXPECT_NEAR(set.contours.at(0).lengthPx, 60.0, 1e-9);
  EXPECT_NEAR((set.contours[0].points.back().at - Vec2(40.0, 50.0)).norm(), 0.0, 1e-9);
  // A ring that hangs over the upper border, begun on the page: one line from border to border.
  const ContourSet ring = onPage({{{{30.0, 20.0}, {30.0, -20.0}, {60.0, -20.0}, {60.0, 20.0}}, true}});
  const Contour& open = ring.contours.at(0);
  EXPECT_FALSE(open.closed);
  EXPECT_NEAR(open.lengthPx, 20.0 + 30.0 + 20.0, 1e-9);
  EXPECT_NEAR(open.points.front().at.y(), 0.0, 1e-9);
  EXPECT_NEAR(open.points.back().at.y(), 0.0, 1e-9);
}

TEST(PenStrokes, KeepTheirPlaceWhenTheyAreLeftOut) {
  const ContourSet set = onPage({{{{-50.0, 10.0}, {-10.0, 60.0}}, false}, {{{10.0, 10.0}, {90.0, 10.0}}, false}});
  ASSERT_EQ(set.contours.size(), 2u);
  EXPECT_TRUE(set.contours[0].points.empty());
  EXPECT_NEAR(set.contours[1].lengthPx, 80.0, 1e-9);
  EXPECT_NE(set.report.note.find("1 pen stroke is outside the page"), std::string::npos) << set.report.note;
  const auto pieces = splitAtCorners(set, {}, {}, {});
  ASSERT_TRUE(pieces.has_value());
  ASSERT_EQ(pieces->pieces.size(), 1u);
  EXPECT_EQ(pieces->pieces[0].contour, 1);
  const auto none = withPenStrokes({}, std::vector<PenStroke>{{{{-50.0, 10.0}, {-10.0, 60.0}}, false}}, kPenPage);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::NoCurve);
}

TEST(PenStrokes, OfADrawingHaveALimitTogether) {
  constexpr PageExtent kLargePage{20'000.0, 20'000.0};
  std::vector<PenStroke> strokes(80, PenStroke{{{0.0, 0.0}, {20'000.0, 20'000.0}}, false});
  strokes.push_back({{{0.0, 0.0}, {0.0, 100.0}}, false});
  const auto set = withPenStrokes({}, strokes, kLargePage);
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), strokes.size());
  std::ptrdiff_t points = 0;
  int leftOut = 0;
  for (const Contour& contour : set->contours) {
    points += std::ssize(contour.points);
    leftOut += contour.points.empty() ? 1 : 0;
  }
  EXPECT_LE(points, kMostPenPoints);
  EXPECT_GT(points, kMostPenPoints / 2);
  EXPECT_GT(leftOut, 10);
  EXPECT_FALSE(set->contours.back().points.empty()) << "a short stroke still has room";
  EXPECT_NE(set->report.note.find(std::to_string(leftOut) + " pen strokes are left out"), std::string::npos)
      << set->report.note;
}

TEST(PenStrokes, ThatRunToAndFroCountByTheirLength) {
  constexpr PageExtent kLargePage{20'000.0, 20'000.0};
  constexpr int kTurns = 10'000;
  PenStroke zigzag;
  for (int i = 0; i < kTurns; ++i) zigzag.points.emplace_back(20'000.0 * (i % 2), 2.0 * i);
  const std::vector<PenStroke> strokes{zigzag, {{{0.0, 0.0}, {20'000.0, 20'000.0}}, false}};
  const auto set = withPenStrokes({}, strokes, kLargePage);
  ASSERT_TRUE(set.has_value());
  EXPECT_TRUE(set->contours[0].points.empty());
  EXPECT_FALSE(set->contours[1].points.empty());
  EXPECT_NE(set->report.note.find("1 pen stroke is left out"), std::string::npos) << set->report.note;
  const auto none = withPenStrokes({}, std::vector<PenStroke>{zigzag}, kLargePage);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("1 pen stroke is left out"), std::string::npos) << none.error().message;
}

TEST(PenStrokes, BeyondTheLargestNumberAreLeftOut) {
  constexpr int kTooMany = 7;
  std::vector<PenStroke> strokes(kMostPenStrokes + kTooMany, PenStroke{{{10.0, 10.0}, {13.0, 10.0}}, false});
  strokes.front().points = {{-50.0, 10.0}, {-10.0, 10.0}};  // beside the page: takes no room
  const ContourSet set = onPage(strokes);
  ASSERT_EQ(set.contours.size(), strokes.size());
  EXPECT_EQ(std::ranges::count_if(set.contours, [](const Contour& line) { return !line.points.empty(); }),
            kMostPenStrokes);
  EXPECT_NE(set.report.note.find(std::to_string(kTooMany - 1) + " pen strokes are left out"), std::string::npos)
      << set.report.note;
}

}  // namespace
}  // namespace batten
