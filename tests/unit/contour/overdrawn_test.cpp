// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn in several strokes, rendered here, so that it is known which lines were meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "core/contour/centreline.h"
#include "core/contour/polyline_tools.h"
#include "tests/support/angles.h"
#include "tests/support/render_page.h"
#include "tests/support/truth_shapes.h"

namespace batten {
namespace {

using test::kPi;
using MeantLine = std::function<Vec2(double)>;  // 0..1

constexpr double kPenPx = 4.0, kInkPx = 3.6;  // on paper, and as measured
constexpr int kPagePx = 640;

// One stroke along a line: from part `from` to part `to`, wavering about an offset to the side.
std::vector<Vec2> strokeAlong(const MeantLine& line, double from, double to, double offset, double waver,
                              double phase) {
  std::vector<Vec2> points;
  constexpr int kSteps = 1500;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps, t = from + (to - from) * part;
    const Vec2 along = line(t + 1e-4) - line(t - 1e-4);
    points.push_back(line(t) + (offset + waver * std::sin(phase + 5.0 * part)) * leftNormal(along.normalized()));
  }
  return points;
}

// A line in `count` strokes that each run over all of it, but for what they leave out or overshoot at the ends.
void drawOver(std::vector<std::vector<Vec2>>& strokes, const MeantLine& line, int count, double spreadPx,
              unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < count; ++k) {
    const double offset = count > 1 ? spreadPx * (static_cast<double>(k) / (count - 1) - 0.5) : 0.0;
    const double from = 0.03 * (unit(random) - 0.5), to = 1.0 + 0.03 * (unit(random) - 0.5);
    strokes.push_back(strokeAlong(line, from, to, offset, 0.15 * spreadPx, 2.0 * kPi * unit(random)));
  }
}

// The lines of a page with these strokes, merged where their middles are no farther apart than the distance.
std::vector<Contour> mergedLines(const std::vector<std::vector<Vec2>>& strokes, double distancePx) {
  std::vector<float> cover(static_cast<std::size_t>(kPagePx) * kPagePx, 0.0f);
  for (const auto& s : strokes) {
    const std::vector<float> one = test::strokeCoverage(s, false, kPenPx, kPagePx, kPagePx);
    for (std::size_t i = 0; i < cover.size(); ++i) cover[i] = std::max(cover[i], one[i]);
  }
  test::PageStyle style;
  style.paperLeft = style.paperRight = 240.0;
  style.inkLevel = 30.0;
  style.blurPx = 0.8;
  style.noise = 5.0;
  const GreyImage grey = test::renderPage(std::move(cover), kPagePx, kPagePx, style).grey;
  BitImage ink(kPagePx, kPagePx);
  for (int y = 0; y < kPagePx; ++y)
    for (int x = 0; x < kPagePx; ++x) ink.set(x, y, grey.level(x, y) < 135.0);
  EdgeParams params;
  params.mergeWidths = distancePx / kInkPx - 1.0;
  const Result<ContourSet> set = centrelines(ink, grey, params, {});
  EXPECT_TRUE(set);
  return set ? set->contours : std::vector<Contour>{};
}

double distanceTo(const Vec2& p, const std::vector<Vec2>& points) {
  double least = 1e9;
  for (const Vec2& q : points) least = std::min(least, (p - q).norm());
  return least;
}

// Share of the line within the distance of the points.
double coveredShare(const MeantLine& line, const std::vector<Vec2>& points, double withinPx) {
  int near = 0;
  for (int i = 0; i <= 200; ++i) near += distanceTo(line(i / 200.0), points) <= withinPx ? 1 : 0;
  return near / 201.0;
}

double shareOn(const Contour& found, const MeantLine& line, double withinPx) {
  std::vector<Vec2> samples;
  for (int i = -40; i <= 1040; ++i) samples.push_back(line(i / 1000.0));
  int near = 0;
  for (const Vec2& p : found.points) near += distanceTo(p, samples) <= withinPx ? 1 : 0;
  return near / static_cast<double>(found.points.size());
}

// Every meant line is one of the lines found, and there are no others.
void expectMeant(const std::vector<Contour>& found, const std::vector<MeantLine>& meant, double withinPx) {
  EXPECT_EQ(found.size(), meant.size());
  for (std::size_t m = 0; m < meant.size(); ++m) {
    int matches = 0;
    for (const Contour& c : found)
      matches += coveredShare(meant[m], c.points, withinPx) >= 0.95 && shareOn(c, meant[m], withinPx) >= 0.95 ? 1 : 0;
    std::string shares;
    for (const Contour& c : found)
      shares += "  covers " + std::to_string(coveredShare(meant[m], c.points, withinPx)) + ", on it " +
                std::to_string(shareOn(c, meant[m], withinPx));
    EXPECT_EQ(matches, 1) << "line " << m << shares;
  }
}

MeantLine straight(const Vec2& a, const Vec2& b) {
  return [a, b](double t) { return Vec2(a + t * (b - a)); };
}

MeantLine cubic(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return [=](double t) {
    const double u = 1.0 - t;
    return Vec2(u * u * u * a + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * d);
  };
}

Vec2 beanAt(double t) {
  const double a = 2.0 * kPi * t, r = 190.0 + 45.0 * std::cos(a) - 30.0 * std::cos(2.0 * a + 0.7);
  return {320.0 + r * std::cos(a), 320.0 + r * std::sin(a)};
}

TEST(Overdrawn, AScriptKIsThreeLines) {
  const std::vector<MeantLine> k{cubic({120, 40}, {330, 120}, {230, 400}, {200, 600}),
                                 cubic({560, 60}, {470, 200}, {360, 290}, {225, 350}),
                                 cubic({320, 290}, {380, 420}, {440, 590}, {600, 560})};
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    SCOPED_TRACE(seed);
    std::vector<std::vector<Vec2>> strokes;
    drawOver(strokes, k[0], 2, 10.0, seed);
    drawOver(strokes, k[1], 3, 15.0, seed + 10);
    drawOver(strokes, k[2], 3, 15.0, seed + 20);
    expectMeant(mergedLines(strokes, 28.0), k, 9.0);
  }
}

TEST(Overdrawn, ABeanOfManyStrokesIsOneRing) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<std::vector<Vec2>> strokes;
    constexpr int kStrokes = 7;
    for (int k = 0; k < kStrokes; ++k) {
      const double from = (k - 0.25 - 0.1 * unit(random)) / kStrokes, to = (k + 1.25 + 0.1 * unit(random)) / kStrokes;
      strokes.push_back(strokeAlong(beanAt, from, to, 8.0 * (unit(random) - 0.5), 4.0, 6.0 * unit(random)));
    }
    const auto found = mergedLines(strokes, 28.0);
    ASSERT_EQ(found.size(), 1u) << seed;
    EXPECT_TRUE(found[0].closed);
    EXPECT_GE(coveredShare(beanAt, found[0].points, 9.0), 0.99);
    EXPECT_NEAR(found[0].lengthPx, polylineLength(strokeAlong(beanAt, 0.0, 1.0, 0.0, 0.0, 0.0), true), 40.0);
  }
}

// One stroke that goes round nearly three times and drifts.
TEST(Overdrawn, ABeanDrawnRoundAndRoundIsOneRing) {
  for (const double rounds : {1.2, 2.3, 2.8}) {
    std::vector<Vec2> stroke;
    constexpr int kSteps = 6000;
    for (int i = 0; i <= kSteps; ++i) {
      const double t = 0.15 + rounds * i / kSteps;
      const Vec2 p = beanAt(t), out = (p - Vec2(320, 320)).normalized();
      stroke.push_back(p + (5.0 * std::sin(3.7 * t) + 3.0 * std::sin(8.3 * t + 1.0)) * out);
    }
    const auto found = mergedLines({stroke}, 28.0);
    ASSERT_EQ(found.size(), 1u) << rounds;
    EXPECT_TRUE(found[0].closed) << rounds;
    EXPECT_GE(coveredShare(beanAt, found[0].points, 9.0), 0.99) << rounds;
  }
}

// Strokes that run together and part at both ends, by less than they may be apart.
TEST(Overdrawn, ABundleThatFansOutIsOneLine) {
  const MeantLine middle = cubic({60, 400}, {220, 300}, {420, 300}, {580, 380});
  std::vector<std::vector<Vec2>> strokes;
  for (const double side : {-1.0, 0.0, 1.0}) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 1500; ++i) {
      const double t = i / 1500.0, fan = 2.0 + 18.0 * std::pow(2.0 * std::abs(t - 0.5), 3.0);
      const Vec2 along = middle(t + 1e-4) - middle(t - 1e-4);
      points.push_back(middle(t) + side * fan * leftNormal(along.normalized()));
    }
    strokes.push_back(std::move(points));
  }
  const auto found = mergedLines(strokes, 36.0);
  expectMeant(found, {middle}, 5.0);
}

TEST(Overdrawn, NeighboursStayTwoLines) {
  constexpr double kDistance = 18.0;
  // Side by side, half a distance farther apart than strokes of one line may be.
  std::vector<MeantLine> meant{straight({60, 300}, {580, 280}),
                               straight({60, 300 + 1.5 * kDistance + 7.0}, {580, 280 + 1.5 * kDistance + 7.0})};
  std::vector<std::vector<Vec2>> strokes;
  drawOver(strokes, meant[0], 2, 7.0, 1);
  drawOver(strokes, meant[1], 2, 7.0, 2);
  expectMeant(mergedLines(strokes, kDistance), meant, 3.5);
  // Coming as near as strokes of one line, and parting again.
  meant = {cubic({60, 120}, {260, 345}, {380, 345}, {580, 120}), cubic({60, 490}, {260, 272}, {380, 272}, {580, 490})};
  strokes.clear();
  drawOver(strokes, meant[0], 2, 7.0, 3);
  drawOver(strokes, meant[1], 2, 7.0, 4);
  expectMeant(mergedLines(strokes, kDistance), meant, 4.0);
}

TEST(Overdrawn, BundlesCross) {
  for (const double angle : {90.0, 60.0, 40.0, 25.0}) {
    SCOPED_TRACE(angle);
    const double half = 0.5 * angle * kPi / 180.0;
    const Vec2 centre(320, 320), d(std::cos(half), std::sin(half)), e(std::cos(half), -std::sin(half));
    const std::vector<MeantLine> meant{straight(centre - 270.0 * d, centre + 270.0 * d),
                                       straight(centre - 270.0 * e, centre + 270.0 * e)};
    std::vector<std::vector<Vec2>> strokes;
    drawOver(strokes, meant[0], 3, 14.0, 5);
    drawOver(strokes, meant[1], 3, 14.0, 6);
    expectMeant(mergedLines(strokes, 22.0), meant, 7.5);
  }
}

// A single stroke that overshoots where the others turn goes; the line goes on with the others.
TEST(Overdrawn, WhatOvershootsGoes) {
  const MeantLine turning = [](double t) {
    const double a = -0.5 * kPi + 1.3 * kPi * t;
    return Vec2(320.0 + 200.0 * std::cos(a), 320.0 + 200.0 * std::sin(a));
  };
  std::vector<std::vector<Vec2>> strokes;
  drawOver(strokes, turning, 2, 7.0, 8);
  const Vec2 from = turning(0.35), along = (turning(0.351) - turning(0.35)).normalized();
  std::vector<Vec2> tangent;
  for (double s = -90.0; s <= 85.0; s += 0.25) tangent.push_back(from + s * along + 4.0 * leftNormal(along));
  strokes.push_back(std::move(tangent));
  expectMeant(mergedLines(strokes, 28.0), {turning}, 7.0);
}

// The mean has no step and no wave where a stroke of the bundle begins or ends.
TEST(Overdrawn, TheMeanIsFairWhereStrokesBegin) {
  const MeantLine line = straight({40, 320}, {600, 320});
  std::vector<std::vector<Vec2>> strokes{strokeAlong(line, 0.0, 1.0, 0.0, 0.0, 0.0),
                                         strokeAlong(line, 0.3, 0.7, 8.0, 0.0, 0.0),
                                         strokeAlong(line, 0.5, 1.0, -7.0, 0.0, 0.0)};
  const auto found = mergedLines(strokes, 22.0);
  ASSERT_EQ(found.size(), 1u);
  double steepest = 0.0, turning = 0.0, last = 0.0;
  const auto& p = found[0].points;
  constexpr std::size_t kStep = 20;
  for (std::size_t i = kStep; i < p.size(); i += kStep) {
    const Vec2 way = p[i] - p[i - kStep];
    const double slope = std::atan(way.y() / way.x());
    if (i > kStep) turning += std::abs(slope - last);
    steepest = std::max(steepest, std::abs(slope));
    last = slope;
    EXPECT_NEAR(p[i].y(), 320.0, 8.5);
  }
  EXPECT_LT(steepest, 0.1);
  EXPECT_LT(turning, 0.6);
}

}  // namespace
}  // namespace batten
