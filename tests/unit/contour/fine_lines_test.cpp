// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/fine_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/contour/ink/ink_split.h"
#include "core/image/fine_page.h"
#include "core/image/threshold/binarize.h"
#include "tests/support/dense_page.h"

namespace batten {
namespace {

Contour ringOf(int points) {
  Contour ring;
  ring.kind = ContourKind::Outline;
  ring.closed = true;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    ContourPoint p;
    p.at = p.unrefined = Vec2(40.0 + 10.0 * std::cos(angle), 40.0 + 10.0 * std::sin(angle));
    ring.points.push_back(p);
  }
  return ring;
}

Contour onThePage(Contour fine) {
  ContourSet set;
  set.contours.push_back(std::move(fine));
  return fromFinePage(std::move(set)).contours.front();
}

TEST(FineLines, HaveAboutAPointAPixelOfThePage) {
  EXPECT_EQ(onThePage(ringOf(60)).points.size(), 30u);
  // The smallest outlines stay outlines.
  EXPECT_EQ(onThePage(ringOf(4)).points.size(), 4u);
}

/// A point that is kept is a point of a bridge if it was one, and of no other.
TEST(FineLines, KeepTheirBridges) {
  Contour ring = ringOf(40);
  ring.bridges = {{3, 3}, {6, 9}, {37, 39}};
  EXPECT_EQ(onThePage(ring).bridges, (std::vector<std::pair<int, int>>{{3, 4}, {19, 19}}));
}

/// What strokes of 2 px were drawn with is told by the scan: an enlargement of it is smoother.
TEST(FineLines, TellPencilFromPenAsTheScanShowsIt) {
  constexpr int kWidth = 640, kHeight = 480;
  for (const bool isPencil : {false, true}) {
    for (const std::uint32_t seed : {1u, 2u}) {
      const auto lines = test::hatchLines({320.0, 240.0}, 17.0, 12, 5.0, 300.0, 500.0);
      std::vector<float> cover = test::coverageOf(lines, 2.0, kWidth, kHeight);
      if (isPencil)
        test::grainCoverage(
            cover, kWidth, kHeight, [](double, double) { return 1.0; }, seed);
      const GreyImage grey = test::scanOfLines(std::move(cover), kWidth, kHeight, seed).grey;
      const auto thresholds = findThresholds(grey, {}, {}, {});
      ASSERT_TRUE(thresholds);
      const auto fine = finePage(grey, *binarize(grey, *thresholds, {}, {}), {}, {});
      ASSERT_TRUE(fine && *fine);
      const auto split = splitInk((*fine)->ink, *(*fine)->grey, {}, {}, &grey);
      ASSERT_TRUE(split && split->known);
      double pencil = 0.0, all = 0.0;
      for (int i = 0; i < std::ssize(split->known->paths); ++i) {
        const double length = split->known->paths[i].length();
        all += length;
        if (split->known->grain.isPencil(i)) pencil += length;
      }
      EXPECT_EQ(pencil, isPencil ? all : 0.0) << "seed " << seed << (isPencil ? ", pencil" : ", pen");
    }
  }
}

}  // namespace
}  // namespace batten
