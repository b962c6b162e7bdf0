// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include "core/contour/intent/contraction.h"
#include "core/contour/intent/intended_lines.h"
#include "core/contour/intent/merge_shares.h"
#include "core/contour/intent/side_edges.h"
#include "core/contour/intent/strip_mean.h"
#include "core/contour/intent/stroke_groups.h"
#include "core/contour/intent/stroke_pieces.h"
#include "core/polyline/polyline_tools.h"
#include "tests/support/angles.h"
#include "tests/support/overdrawn_page.h"
#include "tests/support/pen_lines.h"

namespace batten {
namespace {

using test::kPi;

constexpr double kIntentPenPx = 4.0;

Contour penLine(const std::vector<Vec2>& corners, bool closed = false) {
  return test::centreline(test::alongPolygon(corners, closed), closed, kIntentPenPx);
}

Contour curve(const std::function<Vec2(double)>& at, double from = 0.0, double to = 1.0) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 2000; ++i) points.push_back(at(from + (to - from) * i / 2000.0));
  std::vector<Vec2> even{points.front()};
  for (const Vec2& p : points)
    if ((p - even.back()).norm() >= 1.0) even.push_back(p);
  return test::centreline(even, false, kIntentPenPx);
}

// [px] Of every point of a line from a curve, the largest.
double farthestFrom(const std::function<Vec2(double)>& at, const Contour& line, double inset = 0.05) {
  double worst = 0.0;
  const int n = static_cast<int>(line.points.size());
  for (int i = static_cast<int>(inset * n); i < static_cast<int>((1.0 - inset) * n); ++i) {
    double nearest = 1e9;
    for (int k = 0; k <= 4000; ++k) nearest = std::min(nearest, (at(k / 4000.0) - line.points[i].at).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

// The same clusters by adding up all weights between clusters anew in every step.
std::vector<int> contractedPlainly(int nodes, const std::vector<WeightedPair>& pairs) {
  std::vector<int> name(nodes);
  std::iota(name.begin(), name.end(), 0);
  for (;;) {
    std::map<std::pair<int, int>, double> sums;
    for (const WeightedPair& p : pairs)
      if (name[p.a] != name[p.b]) sums[std::minmax(name[p.a], name[p.b])] += p.weight;
    const auto best = std::max_element(sums.begin(), sums.end(), [](auto& x, auto& y) { return x.second < y.second; });
    if (best == sums.end() || best->second <= 0.0) break;
    for (int& n : name)
      if (n == best->first.second) n = best->first.first;
  }
  std::map<int, int> numbers;
  for (int& n : name) n = numbers.try_emplace(n, static_cast<int>(numbers.size())).first->second;
  return name;
}

TEST(Intent, ContractionIsThatOfThePlainSums) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> weight(-5.0, 5.0);
  for (int trial = 0; trial < 60; ++trial) {
    const int nodes = 2 + trial % 23;
    std::vector<WeightedPair> pairs;
    for (int a = 0; a < nodes; ++a)
      for (int b = a + 1; b < nodes; ++b)
        if (random() % 3 == 0) pairs.push_back({a, b, weight(random)});
    const std::vector<int> expected = contractedPlainly(nodes, pairs);
    EXPECT_EQ(contractGreedily(nodes, pairs, {}), expected) << trial;
    std::shuffle(pairs.begin(), pairs.end(), random);
    for (WeightedPair& p : pairs) std::swap(p.a, p.b);
    EXPECT_EQ(contractGreedily(nodes, pairs, {}), expected) << trial << " in another order";
  }
}

TEST(Intent, LinesAreCutAtCornersEndsAndCrossings) {
  // An angle, a line that ends on its second leg, and one that crosses its first leg.
  const std::vector<Contour> lines{penLine({{50, 50}, {250, 50}, {250, 250}}), penLine({{255, 150}, {350, 150}}),
                                   penLine({{150, 20}, {150, 120}})};
  const StrokePieceSet set = cutIntoPieces(lines, kIntentPenPx, {});
  std::vector<int> pieces(3);
  for (const StrokePiece& p : set.pieces) ++pieces[p.line];
  EXPECT_EQ(pieces, (std::vector<int>{4, 1, 2}));
  EXPECT_EQ(std::ranges::count_if(set.links, [](const TraceLink& l) { return l.isCorner; }), 1);
  EXPECT_EQ(set.links.size(), 4u);
  int freeEnds = 0;
  double length = 0.0;
  for (const StrokePiece& p : set.pieces) {
    freeEnds += (p.strip.isFree[0] ? 1 : 0) + (p.strip.isFree[1] ? 1 : 0);
    length += p.strip.length() * kIntentPenPx;
    EXPECT_LT(p.firstPoint, p.lastPoint);
  }
  EXPECT_EQ(freeEnds, 5) << "all but the one that ends on a line";
  EXPECT_NEAR(length, 400.0 + 95.0 + 100.0, 0.03 * 595.0);
}

TEST(Intent, PiecesFollowEachOtherRoundARing) {
  const std::vector<Contour> lines{penLine({{100, 100}, {300, 100}, {300, 300}, {100, 300}}, true)};
  const StrokePieceSet set = cutIntoPieces(lines, kIntentPenPx, {});
  ASSERT_EQ(set.pieces.size(), 4u);
  EXPECT_EQ(set.links.size(), 4u);
  for (const TraceLink& link : set.links) {
    EXPECT_TRUE(link.isCorner);
    EXPECT_LT(
        (set.pieces[link.from / 2].strip.samples.back().at - set.pieces[link.to / 2].strip.samples.front().at).norm(),
        1e-9);
  }
  for (const StrokePiece& p : set.pieces) EXPECT_NEAR(p.strip.length(), 50.0, 2.0);
}

TEST(Intent, MeasuresOfTwoStraightParallelStrokes) {
  // 12 px apart are 3 widths; the second begins 80 px later and runs back.
  const std::vector<Contour> lines{penLine({{40, 100}, {440, 100}}), penLine({{440, 112}, {120, 112}})};
  const StrokePieceSet set = cutIntoPieces(lines, kIntentPenPx, {});
  ASSERT_EQ(set.pieces.size(), 2u);
  const std::vector<Strip> strips{set.pieces[0].strip, set.pieces[1].strip};
  const auto pairs = findStripPairs(strips, kSideReach, false, {});
  ASSERT_EQ(pairs.size(), 1u);
  const SideMeasures m = measureSide(pairs[0], {strips});
  EXPECT_NEAR(m.middle, 3.0, 1e-6);
  EXPECT_NEAR(m.least, 3.0, 1e-6);
  EXPECT_NEAR(m.most, 3.0, 1e-6);
  EXPECT_NEAR(m.parting, 0.0, 1e-6);
  EXPECT_NEAR(m.angleDeg, 0.0, 1e-3);
  EXPECT_NEAR(m.overlap, 81.0, 2.0);
  EXPECT_NEAR(m.shareA, 0.8, 0.03);
  EXPECT_NEAR(m.shareB, 1.0, 1e-9);
  EXPECT_FALSE(m.isCrossing);
  EXPECT_EQ(m.freeEndsBeside, 3) << "only the start of the longer lies beside nothing";
  EXPECT_TRUE(m.isWithin);
  EXPECT_EQ(overdrawnPlaces(set, pairs), 1);
}

// The mean of all pieces of some lines as one group.
std::vector<PieceMean> meanOfAll(const std::vector<Contour>& lines) {
  const StrokePieceSet set = cutIntoPieces(lines, kIntentPenPx, {});
  std::vector<Strip> strips;
  for (const StrokePiece& p : set.pieces) strips.push_back(p.strip);
  const auto pairs = findStripPairs(strips, kSideReach, true, {});
  const std::vector<bool> one = lookOverdrawn(set, pairs, 1.5);
  std::vector<int> all(set.pieces.size());
  std::iota(all.begin(), all.end(), 0);
  return PieceMeans(set, pairs, one).of(all);
}

Contour contourOf(const PieceMean& mean) {
  std::vector<Vec2> points;
  for (const StripSample& sample : mean.strip.samples) points.push_back(kIntentPenPx * sample.at);
  Contour c;
  c.points = contourPoints(points, false);
  measureContour(c);
  return c;
}

TEST(Intent, TheMeanOfASpiralWindsAsOftenAsItsStrokes) {
  // Three turns 44 px apart, in two strokes that cross each other, 6 px apart at most.
  const auto spiral = [](double shift) {
    return [shift](double t) {
      const double a = 6.0 * kPi * t, r = 40.0 + 44.0 * 3.0 * t + shift * std::cos(2.5 * a);
      return Vec2(300.0 + r * std::cos(a), 300.0 + r * std::sin(a));
    };
  };
  const std::vector<Contour> strokes{curve(spiral(3.0)), curve(spiral(-3.0), 1.0, 0.0)};
  const auto means = meanOfAll(strokes);
  ASSERT_FALSE(means.empty());
  const Contour mean = contourOf(means.front());
  EXPECT_NEAR(mean.lengthPx, curve(spiral(0.0)).lengthPx, 0.04 * mean.lengthPx);
  EXPECT_LT(farthestFrom(spiral(0.0), mean), 1.5);
}

TEST(Intent, TheMeanOfACurveThatCrossesItselfGoesStraightOn) {
  const auto eight = [](double shift) {
    return [shift](double t) {
      const double a = 0.3 + 5.8 * t;
      const Vec2 at(300.0 + 220.0 * std::sin(a), 300.0 + 200.0 * std::sin(a) * std::cos(a));
      const Vec2 tangent = Vec2(220.0 * std::cos(a), 200.0 * std::cos(2.0 * a)).normalized();
      return Vec2(at + shift * std::cos(4.0 * a) * leftNormal(tangent));
    };
  };
  const auto means = meanOfAll({curve(eight(3.0)), curve(eight(-3.0))});
  ASSERT_FALSE(means.empty());
  const Contour mean = contourOf(means.front());
  EXPECT_NEAR(mean.lengthPx, curve(eight(0.0)).lengthPx, 0.04 * mean.lengthPx);
  EXPECT_LT(farthestFrom(eight(0.0), mean), 2.0);
}

TEST(Intent, AForkIsNoOneLine) {
  // Two strokes that run together and part by far more than they are apart before.
  const auto upper = [](double t) { return Vec2(50.0 + 500.0 * t, 300.0 - 150.0 * std::max(0.0, t - 0.5) * 2.0); };
  const auto lower = [](double t) { return Vec2(50.0 + 500.0 * t, 304.0 + 150.0 * std::max(0.0, t - 0.5) * 2.0); };
  const auto means = meanOfAll({curve(upper), curve(lower)});
  for (const PieceMean& mean : means) {
    const Contour c = contourOf(mean);
    for (const ContourPoint& p : c.points) {
      const double t = (p.at.x() - 50.0) / 500.0;
      const double away = std::min(std::abs(p.at.y() - upper(t).y()), std::abs(p.at.y() - lower(t).y()));
      EXPECT_LT(away, 12.0) << "at " << p.at.x();
    }
  }
}

// Bundles with different distances between their strokes on one page.
std::vector<Contour> narrowAndWideBundles() {
  std::vector<test::PenPath> strokes;
  const auto narrow = test::cubicLine({60, 500}, {420, 560}, {200, 380}, {580, 420});
  const auto wide = test::cubicLine({60, 120}, {250, 40}, {400, 300}, {580, 140});
  for (unsigned k = 0; k < 4; ++k) {
    strokes.push_back(test::wanderAlong(narrow, 0.02 * k, 1.0 - 0.03 * k, 3.0, 11 + k));
    strokes.push_back(test::wanderAlong(wide, 0.03 * k, 1.0 - 0.02 * k, 9.0, 31 + k));
  }
  return test::traceOverdrawn(strokes, 0.0).contours;
}

TEST(Intent, BundlesOfDifferentWidthsBecomeOneLineEach) {
  const auto lines = intendedLines(narrowAndWideBundles(), kIntentPenPx, {}, {});
  ASSERT_TRUE(lines);
  EXPECT_EQ(lines->size(), 2u);
  const auto narrow = test::cubicLine({60, 500}, {420, 560}, {200, 380}, {580, 420});
  const auto wide = test::cubicLine({60, 120}, {250, 40}, {400, 300}, {580, 140});
  for (const Contour& line : *lines) {
    const double away = std::min(farthestFrom(narrow, line), farthestFrom(wide, line));
    EXPECT_LT(away, 12.0);
    EXPECT_GT(line.lengthPx, 450.0);
    for (const ContourPoint& p : line.points) {
      EXPECT_TRUE(std::isfinite(p.at.x()) && std::isfinite(p.at.y()));
    }
  }
}

TEST(Intent, TheSameLinesWithAnyNumberOfThreads) {
  const std::vector<Contour> strokes = narrowAndWideBundles();
  RunContext one;
  one.threads = 1;
  const auto alone = intendedLines(strokes, kIntentPenPx, {}, one), all = intendedLines(strokes, kIntentPenPx, {}, {});
  ASSERT_TRUE(alone && all);
  ASSERT_EQ(alone->size(), all->size());
  for (std::size_t i = 0; i < all->size(); ++i) EXPECT_EQ((*alone)[i].points, (*all)[i].points);
}

TEST(Intent, NothingWhenCancelled) {
  RunContext cancelledRun;
  cancelledRun.cancel.cancel();
  EXPECT_FALSE(intendedLines(narrowAndWideBundles(), kIntentPenPx, {}, cancelledRun));
}

TEST(Intent, CleanLinesHaveNoOtherMeaning) {
  std::vector<Contour> lines;
  for (int k = 0; k < 8; ++k) lines.push_back(penLine({{40, 60.0 + 14.0 * k}, {560, 60.0 + 14.0 * k}}));
  lines.push_back(penLine({{100, 250}, {500, 500}}));
  lines.push_back(penLine({{500, 250}, {100, 500}}));
  lines.push_back(penLine({{250, 250}, {350, 250}, {350, 350}, {250, 350}}, true));
  EXPECT_FALSE(intendedLines(lines, kIntentPenPx, {}, {}));
  EXPECT_FALSE(intendedLines({}, kIntentPenPx, {}, {}));
}

}  // namespace
}  // namespace batten
