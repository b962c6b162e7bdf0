// SPDX-License-Identifier: GPL-3.0-or-later
// Junctions whose strokes the user pairs, and those that are doubtful: against lines that are known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contour/centreline/junction/doubtful_pairings.h"
#include "core/contour/trace_contours.h"
#include "tests/support/dense_page.h"

namespace batten {
namespace {

constexpr int kPageWidth = 480, kPageHeight = 360;
constexpr double kNodeRadiusPx = 4.0, kUsualRadiusPx = 2.0, kBendLimitDeg = 40.0;

MeetingEnd meetingTowards(double angleDeg, double radius = kUsualRadiusPx) {
  const double angle = angleDeg * std::numbers::pi / 180.0;
  const Vec2 out(std::cos(angle), std::sin(angle));
  return {0, kNodeRadiusPx * out, out, radius};
}

JunctionPairings pairingsOf(const std::vector<MeetingEnd>& ends) {
  const PairingScale scale{kNodeRadiusPx, kUsualRadiusPx, kBendLimitDeg};
  return findPairings(ends, pairEnds(ends, scale), scale);
}

TEST(JunctionPairings, TheRuleComesFirstThenTheNextBestAndNoneLast) {
  const JunctionPairings cross =
      pairingsOf({meetingTowards(0), meetingTowards(80), meetingTowards(180), meetingTowards(260)});
  ASSERT_EQ(cross.pairings.size(), 4u);
  EXPECT_EQ(cross.pairings[0], EndPairs({{0, 2}, {1, 3}}));
  // The ends of an obtuse angle bend by 80, those of an acute one by 100.
  EXPECT_EQ(cross.pairings[1], EndPairs({{0, 3}, {1, 2}}));
  EXPECT_EQ(cross.pairings[2], EndPairs({{0, 1}, {2, 3}}));
  EXPECT_TRUE(cross.pairings[3].empty());
  EXPECT_FALSE(cross.isDoubtful);
  EXPECT_NEAR(cross.cost, 0.0, 1e-6);

  const JunctionPairings branch = pairingsOf({meetingTowards(0), meetingTowards(180), meetingTowards(70)});
  ASSERT_EQ(branch.pairings.size(), 4u);
  EXPECT_EQ(branch.pairings[0], EndPairs({{0, 1}}));
  EXPECT_FALSE(branch.isDoubtful);
}

TEST(JunctionPairings, AForkOfEqualTinesIsDoubtful) {
  EXPECT_TRUE(pairingsOf({meetingTowards(180), meetingTowards(11), meetingTowards(-12)}).isDoubtful);
  EXPECT_FALSE(pairingsOf({meetingTowards(180), meetingTowards(0), meetingTowards(38)}).isDoubtful);
  // What is as wide decides without doubt.
  EXPECT_FALSE(pairingsOf({meetingTowards(180, 5.0), meetingTowards(11, 5.0), meetingTowards(-12, 1.5)}).isDoubtful);
}

struct CrossedPage {
  BitImage ink;
  GreyImage grey;
};

// Two lines of 4 px that cross at the middle of the page; darker than `level` is ink.
CrossedPage crossing(double angleDeg, double level = 132.0) {
  std::vector<std::vector<Vec2>> lines = test::hatchLines({240, 180}, 10.0, 1, 1.0, 300.0, 0.0);
  lines.push_back(test::hatchLines({240, 180}, 10.0 + angleDeg, 1, 1.0, 300.0, 0.0).front());
  CrossedPage page{
      BitImage(kPageWidth, kPageHeight),
      test::scanOfLines(test::coverageOf(lines, 4.0, kPageWidth, kPageHeight), kPageWidth, kPageHeight, 3).grey};
  for (int y = 0; y < kPageHeight; ++y)
    for (int x = 0; x < kPageWidth; ++x) page.ink.set(x, y, page.grey.level(x, y) < level);
  return page;
}

// A place on the first (0) or the second (1) line, so far from the crossing. [px]
Vec2 placeOn(int line, double angleDeg, double away) {
  const double angle = (10.0 + line * angleDeg) * std::numbers::pi / 180.0;
  return Vec2(240, 180) + away * Vec2(std::cos(angle), std::sin(angle));
}

ContourSet tracedBy(const CrossedPage& page, const EdgeParams& params) {
  const auto set = traceContours(page.ink, page.grey, params, {}, {});
  EXPECT_TRUE(set);
  return set ? *set : ContourSet{};
}

// Whether one line passes both places.
bool isOneLine(const ContourSet& set, const Vec2& a, const Vec2& b) {
  return std::ranges::any_of(set.contours, [&](const Contour& c) {
    double toA = std::numeric_limits<double>::infinity(), toB = toA;
    for (const ContourPoint& p : c.points) {
      toA = std::min(toA, (p.at - a).norm());
      toB = std::min(toB, (p.at - b).norm());
    }
    return std::max(toA, toB) < 2.0;
  });
}

// The strokes turn off where they meet, instead of crossing.
JunctionChoice turningOff(double angleDeg) {
  return {
      {243, 178},
      {{placeOn(0, angleDeg, 40), placeOn(1, angleDeg, 40)}, {placeOn(0, angleDeg, -40), placeOn(1, angleDeg, -40)}}};
}

TEST(JunctionChoices, StrokesGoOnAsTheUserPairsThem) {
  const double angle = 50.0;
  const CrossedPage page = crossing(angle);
  const ContourSet plain = tracedBy(page, {});
  ASSERT_EQ(plain.junctions.size(), 1u);
  EXPECT_LT((plain.junctions[0].positionPx - Vec2(240, 180)).norm(), 2.0);
  EXPECT_EQ(plain.junctions[0].branchesPx.size(), 4u);
  EXPECT_FALSE(plain.junctions[0].isDoubtful);
  EXPECT_EQ(doubtfulCount(plain), 0);
  EXPECT_TRUE(isOneLine(plain, placeOn(0, angle, 100), placeOn(0, angle, -100)));

  EdgeParams params;
  params.junctions = {turningOff(angle)};
  const ContourSet turned = tracedBy(page, params);
  ASSERT_EQ(turned.junctions.size(), 1u);
  EXPECT_EQ(turned.junctions[0].choice, 0);
  EXPECT_EQ(turned.junctions[0].pairings, plain.junctions[0].pairings) << "what the rule says stays known";
  EXPECT_TRUE(isOneLine(turned, placeOn(0, angle, 100), placeOn(1, angle, 100)));
  EXPECT_TRUE(isOneLine(turned, placeOn(0, angle, -100), placeOn(1, angle, -100)));
  EXPECT_FALSE(isOneLine(turned, placeOn(0, angle, 100), placeOn(0, angle, -100)));
  EXPECT_TRUE(turned.report.note.empty()) << turned.report.note;

  params.junctions = {turningOff(angle), {{240, 180}, {}}};
  const ContourSet open = tracedBy(page, params);
  EXPECT_EQ(open.contours.size(), 4u) << "the last choice counts";
  EXPECT_TRUE(open.report.note.empty()) << open.report.note;
  params.junctions = {{{240, 180}, {{{20, 20}, placeOn(0, angle, 30)}}}};
  const std::string leftOut = tracedBy(page, params).report.note;
  EXPECT_NE(leftOut.find("was left out"), std::string::npos) << leftOut;
  params.junctions = {{{240, 180}, {{placeOn(0, angle, 30), placeOn(0, angle, -30)}}}};
  EXPECT_EQ(tracedBy(page, params).contours.size(), 3u) << "one stroke goes through, the other two end";
}

TEST(JunctionChoices, AChoiceLivesOnWhenTheThresholdMoves) {
  EdgeParams params;
  params.junctions = {turningOff(35.0)};
  for (const double level : {90.0, 110.0, 132.0, 160.0, 185.0}) {
    const ContourSet set = tracedBy(crossing(35.0, level), params);
    EXPECT_TRUE(isOneLine(set, placeOn(0, 35.0, 100), placeOn(1, 35.0, 100))) << level;
    EXPECT_TRUE(isOneLine(set, placeOn(0, 35.0, -100), placeOn(1, 35.0, -100))) << level;
    EXPECT_TRUE(set.report.note.empty()) << set.report.note;
  }
}

TEST(JunctionChoices, AChoiceWithoutAJunctionChangesNothingAndIsTold) {
  const CrossedPage page = crossing(50.0);
  const ContourSet plain = tracedBy(page, {});
  EdgeParams params;
  params.junctions = {{{100, 300}, {{{90, 300}, {110, 300}}}}};
  const ContourSet set = tracedBy(page, params);
  EXPECT_THAT(set.report.note, testing::HasSubstr("(100, 300)"));
  ASSERT_EQ(set.contours.size(), plain.contours.size());
  for (std::size_t i = 0; i < set.contours.size(); ++i) EXPECT_EQ(set.contours[i].points, plain.contours[i].points);
  params.junctions = {{{std::nan(""), 0.0}, {}}};
  EXPECT_FALSE(traceContours(page.ink, page.grey, params, {}, {}));
  params.junctions = {{{100, 300}, {{{90, std::nan("")}, {110, 300}}}}};
  EXPECT_FALSE(traceContours(page.ink, page.grey, params, {}, {}));
}

}  // namespace
}  // namespace batten
