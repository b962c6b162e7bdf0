// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of which it is known whether lines were drawn in several strokes, and which lines were intended.
#include "core/contour/merge/overdrawn_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/contour/merge/parallel_strokes.h"
#include "tests/support/angles.h"
#include "tests/support/overdrawn_page.h"

namespace batten {
namespace {

using test::cubicLine;
using test::IntendedLine;
using test::kPi;
using test::PenPath;
using test::straightLine;
using test::traceOverdrawn;

struct Suggested {
  double widths = 0.0;  // 0: none
  double share = 0.0;
};

Suggested suggested(const std::vector<PenPath>& strokes) {
  const ContourSet set = traceOverdrawn(strokes, 0.0);
  EXPECT_FALSE(set.contours.empty());
  EXPECT_GT(set.report.widthPx.value_or(0.0), 1.0);
  const auto overdrawn = findOverdrawnStrokes(set.contours, 21.0 * set.report.widthPx.value_or(0.0), {});
  const OverdrawnStrokes found = overdrawn.value_or(OverdrawnStrokes{});
  EXPECT_EQ(overdrawn.has_value(), found.distancePx > 0.0);
  EXPECT_EQ(overdrawn.has_value(), found.share > 0.0);
  EXPECT_LE(found.share, 1.0);
  return {std::max(0.0, found.distancePx / *set.report.widthPx - 1.0), found.share};
}

double nearestTo(const Vec2& p, const std::vector<Vec2>& points) {
  double least = 1e9;
  for (const Vec2& q : points) least = std::min(least, (p - q).norm());
  return least;
}

// As many lines as were intended, each of them covered by one.
bool areIntended(const std::vector<Contour>& found, const std::vector<IntendedLine>& intended, double withinPx) {
  if (found.size() != intended.size()) return false;
  return std::all_of(intended.begin(), intended.end(), [&](const IntendedLine& line) {
    return std::count_if(found.begin(), found.end(), [&](const Contour& c) {
             int near = 0;
             for (int i = 0; i <= 100; ++i)
               near += nearestTo(line(i / 100.0), positionsOf(c.points)) <= withinPx ? 1 : 0;
             return near >= 94;
           }) == 1;
  });
}

IntendedLine circleOf(double radius) {
  return [radius](double t) {
    return Vec2(320.0 + radius * std::cos(2.0 * kPi * t), 320.0 + radius * std::sin(2.0 * kPi * t));
  };
}

const IntendedLine kSCurve = cubicLine({60, 500}, {420, 560}, {200, 80}, {580, 120});

std::vector<PenPath> bundle(const IntendedLine& line, int count, double scatterPx, unsigned seed) {
  std::vector<PenPath> strokes;
  for (int k = 0; k < count; ++k)
    strokes.push_back(test::wanderAlong(line, 0.0, 1.0, scatterPx, 100 * seed + static_cast<unsigned>(k)));
  return strokes;
}

std::vector<PenPath> roundInArcs(int count, double scatterPx, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<PenPath> strokes;
  for (int k = 0; k < count; ++k)
    strokes.push_back(test::wanderAlong(circleOf(200.0), (k - 0.2 - 0.2 * unit(random)) / count,
                                        (k + 1.2 + 0.2 * unit(random)) / count, scatterPx,
                                        100 * seed + static_cast<unsigned>(k)));
  return strokes;
}

TEST(OverdrawnStrokes, ABundleBecomesOneLine) {
  int right = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    for (const double scatter : {6.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << "scatter " << scatter << " seed " << seed);
      const std::vector<PenPath> strokes = bundle(kSCurve, 3, scatter, seed);
      const Suggested s = suggested(strokes);
      EXPECT_LE(s.widths, 20.0);
      right += s.widths > 0.0 && areIntended(traceOverdrawn(strokes, s.widths).contours, {kSCurve}, 3.0 * scatter + 4.0)
                   ? 1
                   : 0;
    }
  }
  EXPECT_GE(right, 5);  // of 6
}

TEST(OverdrawnStrokes, ACircleOfArcsBecomesOneRing) {
  for (const unsigned seed : {1u, 2u}) {
    for (const double scatter : {6.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << "scatter " << scatter << " seed " << seed);
      const std::vector<PenPath> strokes = roundInArcs(6, scatter, seed);
      const Suggested s = suggested(strokes);
      ASSERT_GT(s.widths, 0.0);
      const auto merged = traceOverdrawn(strokes, s.widths).contours;
      ASSERT_EQ(merged.size(), 1u);
      EXPECT_TRUE(merged[0].closed);
    }
  }
}

// However wide the strokes of a line may scatter, the line beside it stays another.
TEST(OverdrawnStrokes, TwoBundlesStayTwoLines) {
  for (const double apart : {40.0, 70.0}) {
    for (const unsigned seed : {2u, 3u}) {
      SCOPED_TRACE(testing::Message() << apart << " px apart, seed " << seed);
      const IntendedLine one = cubicLine({60, 200}, {260, 120}, {380, 300}, {580, 200});
      const IntendedLine two = [one, apart](double t) { return Vec2(one(t) + Vec2(0.0, apart)); };
      std::vector<PenPath> strokes = bundle(one, 3, 5.0, seed);
      for (PenPath& more : bundle(two, 3, 5.0, seed + 10)) strokes.push_back(std::move(more));
      const Suggested s = suggested(strokes);
      ASSERT_GT(s.widths, 0.0);
      EXPECT_TRUE(areIntended(traceOverdrawn(strokes, s.widths).contours, {one, two}, 18.0));
    }
  }
}

void expectNone(const std::vector<IntendedLine>& lines) {
  std::vector<PenPath> strokes;
  for (const IntendedLine& line : lines) strokes.push_back(test::strokeAlong(line, 0.0, 1.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(suggested(strokes).widths, 0.0);
}

TEST(OverdrawnStrokes, NoneAmongSingleStrokes) {
  expectNone({cubicLine({120, 40}, {330, 120}, {230, 400}, {200, 600}),
              cubicLine({560, 60}, {470, 200}, {360, 290}, {225, 350}),
              cubicLine({320, 290}, {380, 420}, {440, 590}, {600, 560})});
  expectNone({circleOf(60.0), circleOf(80.0), circleOf(95.0), circleOf(140.0), circleOf(200.0), circleOf(212.0)});
  std::vector<IntendedLine> star, fan;
  for (int k = 0; k < 6; ++k) {
    const Vec2 d(std::cos(k * kPi / 6.0), std::sin(k * kPi / 6.0));
    star.push_back(straightLine(Vec2(320, 320) - 250.0 * d, Vec2(320, 320) + 250.0 * d));
  }
  for (int k = 0; k < 8; ++k)
    fan.push_back(
        cubicLine({100.0 + 8 * k, 560}, {120.0 + 14 * k, 400}, {140.0 + 30 * k, 300}, {150.0 + 45 * k, 80.0 + 6 * k}));
  expectNone(star);
  expectNone(fan);
  // A slim leaf on a stem.
  expectNone({cubicLine({60, 300}, {200, 200}, {400, 200}, {580, 300}),
              cubicLine({60, 300}, {200, 330}, {400, 330}, {580, 300}), straightLine({320, 60}, {320, 220})});
}

TEST(OverdrawnStrokes, NoneInAHatching) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<IntendedLine> byHand, slanted, shifting, crossed;
  for (int k = 0; k < 40; ++k) {
    const double a = 8.0 * normal(random), b = normal(random), c = 8.0 * normal(random), d = normal(random);
    byHand.push_back(straightLine({100.0 + a, 60.0 + 12 * k + b}, {540.0 + c, 80.0 + 12 * k + d}));
  }
  for (int k = 0; k < 28; ++k) {
    slanted.push_back(straightLine({60.0 + 12 * k, 100}, {160.0 + 12 * k, 400}));
    shifting.push_back(straightLine({100.0 + 6 * k, 60.0 + 14 * k}, {300.0 + 6 * k, 64.0 + 14 * k}));
  }
  for (int k = 0; k < 20; ++k) {
    crossed.push_back(straightLine({100, 60.0 + 20 * k}, {540, 120.0 + 20 * k}));
    crossed.push_back(straightLine({100.0 + 20 * k, 60}, {100.0 + 20 * k, 560}));
  }
  expectNone(byHand);
  expectNone(slanted);
  expectNone(shifting);
  expectNone(crossed);
}

TEST(OverdrawnStrokes, NothingToLookAt) {
  EXPECT_FALSE(findOverdrawnStrokes({}, 60.0, {}));
  EXPECT_TRUE(findParallelStrokes({Contour{}, Contour{}}, 3.0, 60.0, {}).empty()) << "lines without points";
  const ContourSet set = traceOverdrawn(roundInArcs(6, 6.0, 1), 0.0);
  ASSERT_TRUE(findOverdrawnStrokes(set.contours, 60.0, {}));
  RunContext stopped;
  stopped.cancel.cancel();
  EXPECT_FALSE(findOverdrawnStrokes(set.contours, 60.0, stopped));
  ContourSet outlines = set;
  for (Contour& c : outlines.contours) c.kind = ContourKind::Outline;
  EXPECT_FALSE(findOverdrawnStrokes(outlines.contours, 60.0, {}));
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = findOverdrawnStrokes(set.contours, 80.0, one);
  const auto b = findOverdrawnStrokes(set.contours, 80.0, four);
  ASSERT_TRUE(a && b);
  EXPECT_GT(a->share, 0.5) << "a ring of arcs that overlap";
  EXPECT_EQ(a->distancePx, b->distancePx);
  EXPECT_EQ(a->share, b->share);
}

}  // namespace
}  // namespace batten
