// SPDX-License-Identifier: GPL-3.0-or-later
// Free ends that stop just before another line: on lines made by hand and on a page.

#include "core/contour/centreline/ends/near_ends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/image/bits/bit_disc.h"
#include "tests/support/dense_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

constexpr float kStrokePx = 6.0f;
constexpr double kGapWidths = 4.0;  // as by default

std::vector<Vec2> nearLine(const Vec2& from, const Vec2& to) {
  const int steps = static_cast<int>(std::ceil((to - from).norm()));
  std::vector<Vec2> line;
  for (int k = 0; k <= steps; ++k) line.push_back(from + (to - from) * (static_cast<double>(k) / steps));
  return line;
}

Contour stroke(const Vec2& from, const Vec2& to, bool isPencil = false) {
  Contour c;
  c.kind = ContourKind::Centreline;
  c.points = contourPoints(nearLine(from, to), true);
  for (ContourPoint& p : c.points) {
    p.widthPx = kStrokePx;
    if (!isPencil) p.sigmaPx = 0.05f;
  }
  measureContour(c);
  return c;
}

// The ink of strokes with round ends.
BitImage inkOf(const std::vector<Contour>& lines) {
  BitImage ink(400, 300);
  for (const Contour& c : lines)
    for (const ContourPoint& p : c.points) setDisc(ink, p.at, 0.5 * static_cast<double>(kStrokePx));
  return ink;
}

TEST(NearEnds, TwoEndsAtAnAngleMeetAtTheCorner) {
  // From the corner to the middle of a round end: half a width and the paper.
  std::vector<Contour> lines = {stroke({60.0, 100.0}, {196.0, 100.0}), stroke({200.0, 104.0}, {200.0, 240.0})};
  leadOverPaper(lines, inkOf(lines), kGapWidths, {});
  EXPECT_NEAR((lines[0].points.back().at - Vec2(200.0, 100.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((lines[1].points.front().at - Vec2(200.0, 100.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(lines[0].points.front().at, Vec2(60.0, 100.0));
  for (const Contour& c : lines) ASSERT_EQ(c.bridges.size(), 1u);
  EXPECT_EQ(lines[0].bridges[0].second, std::ssize(lines[0].points) - 1);
  EXPECT_EQ(lines[1].bridges[0].first, 0);
  EXPECT_FALSE(lines[0].points.back().refined);
  EXPECT_NEAR(lines[0].lengthPx, 140.0, 1e-6);
}

TEST(NearEnds, AnEndMeetsTheLineThatItPointsAt) {
  for (const bool isPencil : {false, true}) {
    const double paper = isPencil ? 2.0 : 0.75;  // widths
    for (const double share : {0.9, 1.1}) {
      const double way = (1.0 + share * paper) * static_cast<double>(kStrokePx);  // half a width at either side
      std::vector<Contour> lines = {stroke({-100.0, 100.0}, {200.0 - way, 100.0}, isPencil),
                                    stroke({190.0, 40.0}, {210.0, 160.0}, isPencil)};
      leadOverPaper(lines, inkOf(lines), kGapWidths, {});
      const double toLine = std::abs(cross((lines[1].points.back().at - lines[1].points[0].at).normalized(),
                                           Vec2(lines[0].points.back().at - lines[1].points[0].at)));
      if (share < 1.0) {
        EXPECT_NEAR(toLine, 0.0, 1e-6) << isPencil;
      } else {
        EXPECT_EQ(lines[0].points.back().at, Vec2(200.0 - way, 100.0)) << isPencil;
      }
      EXPECT_TRUE(lines[1].bridges.empty());
    }
  }
}

TEST(NearEnds, AShortStrokeAsOfALetterStays) {
  std::vector<Contour> lines = {stroke({82.0, 100.0}, {192.0, 100.0}), stroke({200.0, 40.0}, {200.0, 160.0})};
  leadOverPaper(lines, inkOf(lines), kGapWidths, {});
  EXPECT_EQ(lines[0].points.back().at, Vec2(192.0, 100.0));
}

TEST(NearEnds, NothingIsLaidWhereGapsAreNotBridged) {
  std::vector<Contour> lines = {stroke({60.0, 100.0}, {196.0, 100.0}), stroke({200.0, 104.0}, {200.0, 240.0})};
  leadOverPaper(lines, inkOf(lines), 0.0, {});
  EXPECT_EQ(lines[0].points.back().at, Vec2(196.0, 100.0));
}

TEST(NearEnds, EndsBesideOneAnotherStay) {
  std::vector<Contour> lines = {stroke({40.0, 100.0}, {195.0, 100.0}), stroke({50.0, 140.4}, {196.0, 101.3})};
  leadOverPaper(lines, inkOf(lines), kGapWidths, {});
  EXPECT_EQ(lines[0].points.back().at, Vec2(195.0, 100.0)) << "they would meet at 15 degrees";
  EXPECT_EQ(lines[1].points.back().at, Vec2(196.0, 101.3));
}

// A box drawn with four strokes that leave its corners open.
TEST(NearEnds, ABoxOfFourStrokesIsClosed) {
  constexpr int kBoxPageWidth = 420, kBoxPageHeight = 320;
  constexpr double kLeft = 80.0, kRight = 340.0, kTop = 60.0, kBottom = 260.0, kShort = 6.0;
  const std::vector<std::vector<Vec2>> sides = {nearLine({kLeft + kShort, kTop}, {kRight - kShort, kTop}),
                                                nearLine({kRight, kTop + kShort}, {kRight, kBottom - kShort}),
                                                nearLine({kRight - kShort, kBottom}, {kLeft + kShort, kBottom}),
                                                nearLine({kLeft, kBottom - kShort}, {kLeft, kTop + kShort})};
  const ContourSet set = tracedPage(
      test::scanOfLines(test::coverageOf(sides, 6.0, kBoxPageWidth, kBoxPageHeight), kBoxPageWidth, kBoxPageHeight, 3)
          .grey);
  ASSERT_EQ(set.contours.size(), 4u);
  for (const Vec2& corner : {Vec2(kLeft, kTop), Vec2(kRight, kTop), Vec2(kRight, kBottom), Vec2(kLeft, kBottom)}) {
    int ends = 0;
    for (const Contour& c : set.contours)
      for (const Vec2& at : {c.points.front().at, c.points.back().at}) ends += (at - corner).norm() < 0.5 ? 1 : 0;
    EXPECT_EQ(ends, 2) << corner.transpose();
  }
}

}  // namespace
}  // namespace batten
