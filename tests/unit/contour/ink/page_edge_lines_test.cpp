// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of sheets and margins of scanners are no lines of a drawing; what a drawing has near the border of its page is.

#include "core/contour/ink/page_edge_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace batten {
namespace {

constexpr int kWholeWidth = 1000, kWholeHeight = 800;

Contour borderLine(const Vec2& from, const Vec2& to, double bow = 0.0) {
  constexpr int kSteps = 100;
  std::vector<Vec2> points;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    points.push_back(from + t * (to - from) + Vec2::Constant(4.0 * bow * t * (1.0 - t)));
  }
  Contour c;
  c.kind = ContourKind::Centreline;
  c.points = contourPoints(points, true);
  for (ContourPoint& p : c.points) p.widthPx = 3.0f;
  measureContour(c);
  return c;
}

GreyImage whole(double level) {
  GreyImage page(kWholeWidth, kWholeHeight);
  std::fill(page.pixels.begin(), page.pixels.end(), static_cast<std::uint16_t>(257.0 * level));
  return page;
}

int droppedOf(std::vector<Contour> lines, const GreyImage& page = whole(230.0)) {
  ContourSet set;
  set.contours = std::move(lines);
  dropPageEdgeLines(set, page);
  return set.report.droppedMargins;
}

const Contour kDrawnBend = borderLine({300.0, 300.0}, {700.0, 500.0}, 40.0);

TEST(PageEdgeLines, TheEdgeOfASheetIsDroppedAlongEverySide) {
  EXPECT_EQ(droppedOf({borderLine({12.0, 100.0}, {16.0, 700.0}), kDrawnBend}), 1);
  EXPECT_EQ(droppedOf({borderLine({988.0, 100.0}, {985.0, 700.0}), kDrawnBend}), 1);
  EXPECT_EQ(droppedOf({borderLine({100.0, 14.0}, {900.0, 10.0}), kDrawnBend}), 1);
  EXPECT_EQ(droppedOf({borderLine({100.0, 790.0}, {900.0, 784.0}), kDrawnBend}), 1);
}

// The edge lies 8 px from the border there, and 22 px at its other end.
TEST(PageEdgeLines, ASheetThatLiesAskewIsComparedWithItsEdgeBesideTheDrawing) {
  const Contour askew = borderLine({8.0, 100.0}, {22.0, 700.0});
  EXPECT_EQ(droppedOf({askew, borderLine({26.0, 120.0}, {200.0, 300.0})}), 1);
  EXPECT_EQ(droppedOf({askew, borderLine({26.0, 650.0}, {200.0, 300.0})}), 0);
}

TEST(PageEdgeLines, TheDrawingStaysInOrder) {
  const Contour second = borderLine({200.0, 600.0}, {800.0, 650.0});
  ContourSet set;
  set.contours = {kDrawnBend, borderLine({12.0, 100.0}, {16.0, 700.0}), second};
  dropPageEdgeLines(set, whole(230.0));
  ASSERT_EQ(set.contours.size(), 2u);
  EXPECT_EQ(set.contours[0].points, kDrawnBend.points);
  EXPECT_EQ(set.contours[1].points, second.points);
}

TEST(PageEdgeLines, TheShadowAlongAnEdgeIsOneToo) {
  Contour shadow = borderLine({8.0, 100.0}, {10.0, 700.0});
  const Contour back = borderLine({15.0, 700.0}, {12.0, 100.0});
  shadow.points.insert(shadow.points.end(), back.points.begin(), back.points.end());
  shadow.kind = ContourKind::Outline, shadow.closed = true;
  EXPECT_EQ(droppedOf({shadow, kDrawnBend}), 1);
}

TEST(PageEdgeLines, WhatTheUserChoseAndTheOnlyLineStay) {
  Contour edge = borderLine({12.0, 100.0}, {16.0, 700.0});
  EXPECT_EQ(droppedOf({edge}), 0);
  edge.traceMode.emplace();
  EXPECT_EQ(droppedOf({edge, kDrawnBend}), 0);
}

TEST(PageEdgeLines, LinesOfADrawingNearTheBorderStay) {
  EXPECT_EQ(droppedOf({borderLine({12.0, 300.0}, {14.0, 480.0}), kDrawnBend}), 0) << "short";
  EXPECT_EQ(droppedOf({borderLine({40.0, 100.0}, {40.0, 700.0}), kDrawnBend}), 0) << "far from the border";
  EXPECT_EQ(droppedOf({borderLine({6.0, 100.0}, {6.0, 700.0}, 24.0), kDrawnBend}), 0) << "bent";
  EXPECT_EQ(droppedOf({borderLine({100.0, 785.0}, {900.0, 785.0}), borderLine({500.0, 400.0}, {500.0, 783.0})}), 0)
      << "the ground that something stands on";
  EXPECT_EQ(droppedOf({borderLine({12.0, 12.0}, {12.0, 788.0}), borderLine({12.0, 12.0}, {988.0, 12.0}),
                       borderLine({988.0, 12.0}, {988.0, 788.0}), borderLine({12.0, 788.0}, {988.0, 788.0})}),
            0)
      << "a frame";
  EXPECT_EQ(droppedOf({borderLine({16.0, 100.0}, {16.0, 700.0}), borderLine({6.0, 300.0}, {6.0, 350.0})}), 0)
      << "something is drawn beyond";
}

/// Paper of 230 above y = 735 and a table of 210 below: the edge of the sheet, 65 px from the border.
GreyImage sheetOnTable() {
  GreyImage page = whole(230.0);
  for (int y = 735; y < kWholeHeight; ++y) std::fill_n(page.row(y), kWholeWidth, static_cast<std::uint16_t>(257 * 210));
  return page;
}

const std::vector<Contour> kEdgeInPieces = {borderLine({60.0, 734.0}, {200.0, 736.0}), kDrawnBend,
                                            borderLine({240.0, 735.0}, {420.0, 735.0}),
                                            borderLine({425.0, 733.0}, {435.0, 737.0})};

TEST(PageEdgeLines, TheEdgeOfASheetFartherInsideIsDroppedWithItsPieces) {
  EXPECT_EQ(droppedOf(kEdgeInPieces, sheetOnTable()), 3);
  EXPECT_EQ(droppedOf(kEdgeInPieces), 0) << "a line on paper";
}

/// Paper of 230 that dims towards x = 926.
GreyImage bookWithGutter() {
  GreyImage page = whole(230.0);
  for (int y = 0; y < kWholeHeight; ++y) {
    for (int x = 0; x < kWholeWidth; ++x) {
      const double level = 230.0 - 60.0 * std::exp(-std::fabs(x - 926.0) / 8.0);
      page.row(y)[x] = static_cast<std::uint16_t>(257.0 * level);
    }
  }
  return page;
}

// The other page of the book has a number.
TEST(PageEdgeLines, TheGutterOfABookIsDroppedWithItsPieces) {
  const GreyImage page = bookWithGutter();
  const std::vector<Contour> gutter = {borderLine({930.0, 2.0}, {928.0, 380.0}), kDrawnBend,
                                       borderLine({928.0, 386.0}, {922.0, 798.0}),
                                       borderLine({970.0, 780.0}, {972.0, 790.0})};
  EXPECT_EQ(droppedOf(gutter, page), 2);
  EXPECT_EQ(droppedOf(gutter), 0) << "a line on flat paper";
  std::vector<Contour> touched = gutter;
  touched.push_back(borderLine({500.0, 600.0}, {925.0, 640.0}));
  EXPECT_EQ(droppedOf(touched, page), 0) << "something is drawn up to it";
  touched = gutter;
  touched.push_back(borderLine({905.0, 383.0}, {918.0, 383.0}));
  EXPECT_EQ(droppedOf(touched, page), 0) << "something stands in the gap";
  EXPECT_EQ(droppedOf({borderLine({930.0, 30.0}, {922.0, 796.0}), kDrawnBend}, page), 0) << "begins on the paper";
  EXPECT_EQ(droppedOf({borderLine({850.0, 2.0}, {850.0, 798.0}), kDrawnBend}, page), 0) << "far from the border";
}

TEST(PageEdgeLines, WhatIsDrawnAlongAToneStays) {
  std::vector<Contour> lines = kEdgeInPieces;
  lines.push_back(borderLine({300.0, 760.0}, {360.0, 790.0}));
  EXPECT_EQ(droppedOf(lines, sheetOnTable()), 0) << "a line beyond the longer piece; the other is short";
  const Contour bowed = borderLine({60.0, 735.0}, {760.0, 735.0}, 14.0);
  GreyImage page = whole(230.0);
  for (const ContourPoint& p : bowed.points) {
    for (int x = static_cast<int>(p.at.x()) - 8; x < static_cast<int>(p.at.x()) + 8; ++x)
      for (int y = static_cast<int>(p.at.y()); y < kWholeHeight; ++y)
        page.row(y)[x] = static_cast<std::uint16_t>(257 * 190);
  }
  EXPECT_EQ(droppedOf({bowed, kDrawnBend}, page), 0) << "a shaded form";
}

}  // namespace
}  // namespace batten
