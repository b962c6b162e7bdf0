// SPDX-License-Identifier: GPL-3.0-or-later
// Paper that lines are drawn around stays in sight, however near its junctions are to one another.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/centreline/stroke_path.h"
#include "core/contour/edge_params.h"
#include "core/contour/ink/ink_split.h"
#include "core/contour/trace_contours.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

constexpr int kLoopSidePx = 200;
constexpr double kLoopStrokePx = 8.0, kLoopDegree = 0.017453292519943295;

std::vector<float> stroke(const std::vector<Vec2>& line, bool isClosed = false, double widthPx = kLoopStrokePx) {
  return test::strokeCoverage(line, isClosed, widthPx, kLoopSidePx, kLoopSidePx);
}

std::vector<Vec2> ellipse(const Vec2& centre, double rx, double ry) {
  std::vector<Vec2> line;
  for (int k = 0; k < 360; k += 4)
    line.push_back(centre + Vec2(rx * std::cos(k * kLoopDegree), ry * std::sin(k * kLoopDegree)));
  return line;
}

/// [px] from a place to the nearest point of the lines that a page gives.
class LoopLines {
 public:
  LoopLines(const test::InkPage& page, const PaperBackground* paper) {
    auto set = traceContours(page.ink, page.grey, {}, {}, {}, {.paper = paper});
    EXPECT_TRUE(set) << (set ? "" : set.error().message);
    if (set) contours_ = std::move(set->contours);
  }
  double distance(const Vec2& at) const {
    double least = 1e9;
    for (const Contour& c : contours_)
      for (const ContourPoint& p : c.points) least = std::min(least, (p.at - at).norm());
    return least;
  }
  const std::vector<Contour>& contours() const { return contours_; }

 private:
  std::vector<Contour> contours_;
};

TEST(SmallLoops, ARingThatABarPartsKeepsBothItsSides) {
  // The bar is so short that its two junctions could be one.
  constexpr double kAwayPx = 1.5;
  const Vec2 centre(100.0, 100.0);
  for (const double rx : {13.0, 15.0, 17.0}) {
    for (const double ry : {7.4, 8.5, 10.0, 11.0}) {
      const LoopLines lines(
          test::scannedInks({stroke(ellipse(centre, rx, ry), true), stroke({{100.0, 20.0}, {100.0, 100.0 + ry}})},
                            kLoopSidePx, kLoopSidePx, 4.0),
          nullptr);
      for (const double at : {40.0, 140.0, 180.0, 220.0, 320.0}) {
        const Vec2 on = centre + Vec2(rx * std::cos(at * kLoopDegree), ry * std::sin(at * kLoopDegree));
        EXPECT_LT(lines.distance(on), kAwayPx) << rx << " x " << ry << " at " << at;
      }
      EXPECT_LT(lines.distance(centre), kAwayPx) << rx << " x " << ry;
    }
  }
}

TEST(SmallLoops, AnEightCrossesItself) {
  // A lemniscate: the bows meet at a place whose ink is broader than long.
  std::vector<Vec2> eight;
  for (int k = 0; k < 360; k += 3) {
    const double t = k * kLoopDegree;
    eight.push_back(Vec2(100.0, 100.0) +
                    60.0 / (1.0 + std::sin(t) * std::sin(t)) * Vec2(std::sin(t) * std::cos(t), std::cos(t)));
  }
  const LoopLines lines(test::scannedInks({stroke(eight, true)}, kLoopSidePx, kLoopSidePx, 4.0), nullptr);
  ASSERT_EQ(lines.contours().size(), 1u);
  EXPECT_TRUE(lines.contours().front().closed);
}

TEST(SmallLoops, ThreeLinesThroughOnePlaceAreOneCrossing) {
  // The triangle between them is narrower than their ink.
  const test::InkPage page =
      test::scannedInks({stroke({{20.0, 96.0}, {180.0, 96.0}}), stroke({{60.0, 20.0}, {140.0, 180.0}}),
                         stroke({{146.0, 20.0}, {60.0, 180.0}})},
                        kLoopSidePx, kLoopSidePx, 4.0);
  const LoopLines lines(page, nullptr);
  ASSERT_EQ(lines.contours().size(), 3u);
  for (const Contour& c : lines.contours()) EXPECT_GT(c.lengthPx, 140.0);
}

PaperBackground paperOfLoops() {
  PaperBackground paper;
  paper.columns = paper.rows = (kLoopSidePx + paper.cellPx - 1) / paper.cellPx;
  paper.grey.assign(static_cast<std::size_t>(paper.columns * paper.rows), 240.0f);
  return paper;
}

/// Two rails on a page of pen lines, with a shadow between them on one stretch, which a threshold of an eighth of their
/// depth takes for ink.
test::InkPage shadedRails(double lengthPx) {
  constexpr double kPaper = 240.0, kThreshold = 210.0 / 8.0;
  constexpr float kShadow = 0.2f;
  const double from = 100.0 - 0.5 * lengthPx, to = 100.0 + 0.5 * lengthPx;
  std::vector<float> inks =
      test::fillCoverage({{from, 91.0}, {to, 91.0}, {to, 109.0}, {from, 109.0}}, kLoopSidePx, kLoopSidePx);
  for (float& ink : inks) ink *= kShadow;
  for (const double y : {20.0, 45.0, 91.0, 109.0, 150.0, 175.0})
    test::inkOver(inks, stroke({{20.0, y}, {180.0, y}}, false, 5.0));
  test::InkPage page;
  page.grey = test::renderPage(std::move(inks), kLoopSidePx, kLoopSidePx, test::penPage(2.0)).grey;
  page.ink = BitImage(kLoopSidePx, kLoopSidePx);
  for (int y = 0; y < kLoopSidePx; ++y)
    for (int x = 0; x < kLoopSidePx; ++x) page.ink.set(x, y, page.grey.level(x, y) < kPaper - kThreshold);
  return page;
}

TEST(ClosedPaper, RailsArePartedWhereAShadowJoinsThem) {
  constexpr double kLength = 12.0;
  const test::InkPage page = shadedRails(kLength);
  const PaperBackground paper = paperOfLoops();
  const auto closed = splitInk(page.ink, page.grey, {}, {});
  const auto open = splitInk(page.ink, page.grey, {}, {}, nullptr, &paper);
  ASSERT_TRUE(closed && open);
  EXPECT_TRUE(closed->strokes.at(100, 100));
  EXPECT_FALSE(open->strokes.at(100, 100) || open->shapes.at(100, 100));
  for (const int y : {91, 109}) EXPECT_TRUE(open->strokes.at(100, y)) << y;
}

}  // namespace
}  // namespace batten
