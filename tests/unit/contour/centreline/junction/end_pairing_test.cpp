// SPDX-License-Identifier: GPL-3.0-or-later
// Which ends of a junction are one stroke: against junctions made of lines that are known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/contour/centreline/centreline.h"
#include "core/contour/centreline/junction/end_pairing.h"
#include "core/polyline/polyline_tools.h"
#include "tests/support/dense_page.h"
#include "tests/support/ink_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

using Pairs = std::vector<std::pair<int, int>>;
constexpr double kNodeRadius = 4.0, kUsualRadius = 2.0, kMostBendDeg = 40.0;

// An end that leaves the junction at the origin in this direction, `aside` px to its left.
MeetingEnd endTowards(double angleDeg, double radius = kUsualRadius, double aside = 0.0) {
  const double angle = angleDeg * std::numbers::pi / 180.0;
  const Vec2 out(std::cos(angle), std::sin(angle));
  return {0, kNodeRadius * out + aside * Vec2(-out.y(), out.x()), out, radius};
}

Pairs pairsOf(const std::vector<MeetingEnd>& ends) { return pairEnds(ends, {kNodeRadius, kUsualRadius, kMostBendDeg}); }

TEST(JunctionPairing, StrokesThatCrossGoStraightOn) {
  EXPECT_THAT(pairsOf({endTowards(0), endTowards(25), endTowards(180), endTowards(205)}),
              testing::UnorderedElementsAre(std::pair(0, 2), std::pair(1, 3)));
}

TEST(JunctionPairing, ThickGoesOnWithThick) {
  // Two Y of equal bends: what is as wide decides.
  EXPECT_EQ(pairsOf({endTowards(180, 5.0), endTowards(-12, 2.0), endTowards(12, 5.0)}), Pairs({{0, 2}}));
  EXPECT_EQ(pairsOf({endTowards(180, 2.0), endTowards(-12, 2.0), endTowards(12, 5.0)}), Pairs({{0, 1}}));
}

TEST(JunctionPairing, TheWholeJunctionIsLookedAt) {
  // 0 goes straight on to 2, but then 1 and 3, which bend by 38 degrees, would remain; by turns of 16 and 22 both go
  // on.
  const std::vector<MeetingEnd> ends = {endTowards(0), endTowards(22), endTowards(180), endTowards(164)};
  EXPECT_THAT(pairsOf(ends), testing::UnorderedElementsAre(std::pair(0, 3), std::pair(1, 2)));
}

// A bundle of three: the middle one is one with the lower on the left, with the upper on the right. As strokes of one
// width are no wider there, width does not tell that the outer ones change places.
TEST(JunctionPairing, SideBySideNoStrokeGoesOverToTheOther) {
  const std::vector<MeetingEnd> ends = {{0, {438, 665}, Vec2(-1.0, -0.09).normalized(), 1.5},
                                        {0, {438, 672}, Vec2(-1.0, -0.12).normalized(), 3.5},
                                        {0, {457, 666}, Vec2(1.0, 0.05).normalized(), 3.5},
                                        {0, {456, 675}, Vec2(1.0, 0.09).normalized(), 1.5}};
  EXPECT_EQ(pairEnds(ends, {9.0, 1.5, kMostBendDeg}), Pairs({{0, 2}, {1, 3}}));
}

TEST(JunctionPairing, AnEndThatMeetsNoneStaysAlone) {
  EXPECT_EQ(pairsOf({endTowards(0), endTowards(90), endTowards(180)}), Pairs({{0, 2}}));
  EXPECT_TRUE(pairsOf({endTowards(0), endTowards(90)}).empty());
  EXPECT_TRUE(pairsOf({endTowards(0)}).empty());
  EXPECT_TRUE(pairsOf({}).empty());
}

TEST(JunctionPairing, ManyEndsArePairedToo) {
  std::vector<MeetingEnd> ends;
  for (int i = 0; i < 16; ++i) ends.push_back(endTowards(22.5 * i));
  const Pairs pairs = pairsOf(ends);
  EXPECT_EQ(pairs.size(), 8u);
  for (const auto& [a, b] : pairs) EXPECT_EQ(b - a, 8);
}

// How lines of a width are found on a scan of them, by the middles of what is darker than half-way.
struct LinePage {
  double lineWidthPx;
  int width, height;
  std::uint32_t seed;
};

test::DenseScore scoreOf(const std::vector<std::vector<Vec2>>& lines, const LinePage& page, double tolerancePx,
                         double endsPx) {
  const auto& [lineWidthPx, width, height, seed] = page;
  const Scan scan = test::scanOfLines(test::coverageOf(lines, lineWidthPx, width, height), width, height, seed);
  BitImage ink(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ink.set(x, y, scan.grey.level(x, y) < 132.0);
  const auto set = centrelines(ink, scan.grey, {}, {});
  EXPECT_TRUE(set);
  std::vector<std::vector<Vec2>> found;
  if (set) {
    for (const Contour& c : set->contours) found.push_back(positionsOf(c.points));
  }
  return test::scoreDense(lines, found, tolerancePx, endsPx);
}

// Straight lines of 4 px that cross, or branch off, at a small angle: every one is found as one line.
TEST(JunctionPairing, LinesAtSmallAnglesAreWhole) {
  constexpr LinePage kPage{4.0, 640, 480, 3};
  for (const double angleDeg : {20.0, 26.0, 32.0, 40.0}) {
    for (const double firstDeg : {4.0, 37.0, 81.0}) {
      std::vector<std::vector<Vec2>> lines = test::hatchLines({320, 240}, firstDeg, 1, 1.0, 360.0, 0.0);
      lines.push_back(test::hatchLines({320, 240}, firstDeg + angleDeg, 1, 1.0, 360.0, 0.0).front());
      const test::DenseScore score = scoreOf(lines, kPage, 4.0, 12.0);
      EXPECT_EQ(score.whole, 2) << angleDeg << " degrees at " << firstDeg;
      EXPECT_EQ(score.bridges, 0) << angleDeg << " degrees at " << firstDeg;
    }
  }
}

// Two hatchings across one another: the crossings lie nearer than the discs of ink at them would allow for one
// crossing.
TEST(JunctionPairing, CrossHatchingIsWhole) {
  constexpr LinePage kPage{3.0, 480, 360, 4};
  for (const double spacingPx : {8.0, 9.0, 12.0}) {
    std::vector<std::vector<Vec2>> lines = test::hatchLines({240, 180}, 45.0, 14, spacingPx, 200.0, 0.0);
    const auto others = test::hatchLines({240, 180}, -45.0, 14, spacingPx, 200.0, 0.0);
    lines.insert(lines.end(), others.begin(), others.end());
    const test::DenseScore score = scoreOf(lines, kPage, 2.0, 6.0);
    EXPECT_GE(score.whole, 27) << spacingPx;
    EXPECT_EQ(score.bridges, 0) << spacingPx;
  }
}

// Two lines that share their ink for a while, and a third that crosses both there: all come out on the other side.
TEST(JunctionPairing, ThreeLinesThatShareTheirInkAreWhole) {
  constexpr LinePage kPage{4.0, 640, 480, 5};
  for (const double betweenDeg : {8.0, 10.0}) {
    for (const double offPx : {20.0, 40.0, 60.0}) {
      for (const double acrossDeg : {18.0, 25.0}) {
        const Vec2 crossing(320.0 + offPx, 240.0 - offPx * 0.5 * betweenDeg * std::numbers::pi / 180.0);
        std::vector<std::vector<Vec2>> lines;
        for (const auto& [through, deg] : {std::pair(Vec2(320.0, 240.0), -betweenDeg),
                                           std::pair(Vec2(320.0, 240.0), 0.0), std::pair(crossing, acrossDeg)})
          lines.push_back(test::hatchLines(through, deg, 1, 1.0, 520.0, 0.0).front());
        EXPECT_EQ(scoreOf(lines, kPage, 4.0, 14.0).whole, 3)
            << betweenDeg << " and " << acrossDeg << " degrees, " << offPx << " px aside";
      }
    }
  }
}

// A bold line across which thin ones lie is no ink of two: its middle is placed all along.
TEST(JunctionPairing, ABoldLineAcrossThinOnesKeepsItsMiddle) {
  constexpr int kAcross = 640, kDown = 320;
  std::vector<float> coverage =
      test::coverageOf(test::hatchLines({320, 160}, 3.0, 1, 1.0, 560.0, 900.0), 12.0, kAcross, kDown);
  std::vector<std::vector<Vec2>> thin;
  for (const double x : {280.0, 320.0, 360.0}) thin.push_back(test::hatchLines({x, 160}, 80.0, 1, 1.0, 220.0, 0.0)[0]);
  test::inkOver(coverage, test::coverageOf(thin, 3.0, kAcross, kDown));
  const Scan scan = test::scanOfLines(coverage, kAcross, kDown, 9);
  BitImage ink(kAcross, kDown);
  for (int y = 0; y < kDown; ++y)
    for (int x = 0; x < kAcross; ++x) ink.set(x, y, scan.grey.level(x, y) < 132.0);
  const auto set = centrelines(ink, scan.grey, {}, {});
  ASSERT_TRUE(set);
  const auto longest = std::ranges::max_element(set->contours, {}, &Contour::lengthPx);
  ASSERT_GT(longest->lengthPx, 500.0);
  const auto between = std::ranges::count_if(
      longest->points, [](const ContourPoint& p) { return p.refined && p.at.x() > 285.0 && p.at.x() < 355.0; });
  EXPECT_GT(between, 10) << "points placed between the thin lines";
}

// What the user says of one crossing holds there, though its ink is that of three lines.
TEST(JunctionPairing, AChoiceForOneCrossingLeavesTheOthers) {
  constexpr LinePage kPage{4.0, 640, 480, 5};
  std::vector<std::vector<Vec2>> lines;
  const Vec2 crossing(360.0, 240.0 - 40.0 * 0.5 * 10.0 * std::numbers::pi / 180.0);
  for (const auto& [through, deg] :
       {std::pair(Vec2(320.0, 240.0), -10.0), std::pair(Vec2(320.0, 240.0), 0.0), std::pair(crossing, 25.0)})
    lines.push_back(test::hatchLines(through, deg, 1, 1.0, 520.0, 0.0).front());
  const Scan scan =
      test::scanOfLines(test::coverageOf(lines, 4.0, kPage.width, kPage.height), kPage.width, kPage.height, kPage.seed);
  BitImage ink(kPage.width, kPage.height);
  for (int y = 0; y < kPage.height; ++y)
    for (int x = 0; x < kPage.width; ++x) ink.set(x, y, scan.grey.level(x, y) < 132.0);
  const auto own = centrelines(ink, scan.grey, {}, {});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->junctions.size(), 1u) << "all three are told at once";
  EdgeParams edges;
  edges.junctions.push_back({{320.0, 240.0}, {}});
  const auto chosen = centrelines(ink, scan.grey, edges, {});
  ASSERT_TRUE(chosen);
  EXPECT_GT(chosen->junctions.size(), 1u) << "every junction is one of its own again";
}

// A stroke crosses two others that lie close together, where a third one ends on the first of them: between the two the
// skeleton of all is one short edge, whose own direction tells nothing.
TEST(JunctionPairing, AStraightStrokeGoesOnThroughTwoJunctionsCloseTogether) {
  const Vec2 crossing(209.0, 198.0), along = Vec2(0.63, 0.776).normalized();
  const Vec2 from = crossing - 140.0 * along, to = crossing + 110.0 * along;
  int whole = 0, all = 0;
  for (const double widthPx : {3.0, 5.0}) {
    const auto isWhole = [&](const Contour& c) {
      double begin = std::numeric_limits<double>::infinity(), end = begin, off = 0.0;
      for (const ContourPoint& p : c.points) {
        begin = std::min(begin, (p.at - from).norm());
        end = std::min(end, (p.at - to).norm());
        off = std::max(off, awayFromSegment(p.at, from, to).norm());
      }
      return begin < widthPx && end < widthPx && off < 1.0;
    };
    for (const double belowWidths : {2.0, 2.33, 2.67, 3.0, 3.67}) {
      for (const double shiftPx : {-3.0, -1.0, 0.0, 2.0}) {
        const Vec2 foot(crossing.x() + shiftPx, crossing.y());
        const double otherY = crossing.y() + belowWidths * widthPx;
        const std::vector<std::vector<Vec2>> lines = {{from, to},
                                                      {{foot.x(), 110.0}, foot},
                                                      {{150.0, 202.0}, {270.0, 193.0}},
                                                      {{100.0, otherY}, {420.0, otherY - 3.0}}};
        const Scan scan = test::scanOfLines(test::coverageOf(lines, widthPx, 480, 360), 480, 360, 7);
        const ContourSet set = tracedPage(scan.grey);
        whole += std::ranges::any_of(set.contours, isWhole) ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GE(whole, 0.9 * all) << "of " << all;
}

}  // namespace
}  // namespace batten
