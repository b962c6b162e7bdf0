// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn in several strokes, rendered here, so that it is known which lines were intended.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/polyline/polyline_tools.h"
#include "tests/support/angles.h"
#include "tests/support/overdrawn_page.h"

namespace batten {
namespace {

using test::beanAt;
using test::cubicLine;
using test::drawOver;
using test::IntendedLine;
using test::kPi;
using test::mergedLines;
using test::straightLine;
using test::strokeAlong;

double distanceTo(const Vec2& p, const std::vector<Vec2>& points) {
  double least = 1e9;
  for (const Vec2& q : points) least = std::min(least, (p - q).norm());
  return least;
}

// Share of the line within the distance of the points.
double coveredShare(const IntendedLine& line, const std::vector<Vec2>& points, double withinPx) {
  int near = 0;
  for (int i = 0; i <= 200; ++i) near += distanceTo(line(i / 200.0), points) <= withinPx ? 1 : 0;
  return near / 201.0;
}

double shareOn(const Contour& found, const IntendedLine& line, double withinPx) {
  std::vector<Vec2> samples;
  for (int i = -40; i <= 1040; ++i) samples.push_back(line(i / 1000.0));
  int near = 0;
  for (const Vec2& p : positionsOf(found.points)) near += distanceTo(p, samples) <= withinPx ? 1 : 0;
  return near / static_cast<double>(found.points.size());
}

// Every intended line is one of the lines found, and there are no others.
void expectIntended(const std::vector<Contour>& found, const std::vector<IntendedLine>& intended, double withinPx) {
  EXPECT_EQ(found.size(), intended.size());
  for (std::size_t m = 0; m < intended.size(); ++m) {
    int matches = 0;
    for (const Contour& c : found)
      matches += coveredShare(intended[m], positionsOf(c.points), withinPx) >= 0.95 &&
                         shareOn(c, intended[m], withinPx) >= 0.95
                     ? 1
                     : 0;
    std::string shares;
    for (const Contour& c : found)
      shares += "  covers " + std::to_string(coveredShare(intended[m], positionsOf(c.points), withinPx)) + ", on it " +
                std::to_string(shareOn(c, intended[m], withinPx));
    EXPECT_EQ(matches, 1) << "line " << m << shares;
  }
}

TEST(Overdrawn, AScriptKIsThreeLines) {
  const std::vector<IntendedLine> k{cubicLine({120, 40}, {330, 120}, {230, 400}, {200, 600}),
                                    cubicLine({560, 60}, {470, 200}, {360, 290}, {225, 350}),
                                    cubicLine({320, 290}, {380, 420}, {440, 590}, {600, 560})};
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    SCOPED_TRACE(seed);
    std::vector<std::vector<Vec2>> strokes;
    drawOver(strokes, k[0], 2, 10.0, seed);
    drawOver(strokes, k[1], 3, 15.0, seed + 10);
    drawOver(strokes, k[2], 3, 15.0, seed + 20);
    expectIntended(mergedLines(strokes, 28.0), k, 9.0);
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
    EXPECT_GE(coveredShare(beanAt, positionsOf(found[0].points), 9.0), 0.99);
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
    EXPECT_GE(coveredShare(beanAt, positionsOf(found[0].points), 9.0), 0.99) << rounds;
  }
}

// Strokes that run together and part at both ends, by less than they may be apart.
TEST(Overdrawn, ABundleThatFansOutIsOneLine) {
  const IntendedLine middle = cubicLine({60, 400}, {220, 300}, {420, 300}, {580, 380});
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
  expectIntended(found, {middle}, 5.0);
}

TEST(Overdrawn, NeighboursStayTwoLines) {
  constexpr double kDistance = 18.0;
  // Side by side, half a distance farther apart than strokes of one line may be.
  std::vector<IntendedLine> intended{
      straightLine({60, 300}, {580, 280}),
      straightLine({60, 300 + 1.5 * kDistance + 7.0}, {580, 280 + 1.5 * kDistance + 7.0})};
  std::vector<std::vector<Vec2>> strokes;
  drawOver(strokes, intended[0], 2, 7.0, 1);
  drawOver(strokes, intended[1], 2, 7.0, 2);
  expectIntended(mergedLines(strokes, kDistance), intended, 3.5);
  // Coming as near as strokes of one line, and parting again.
  intended = {cubicLine({60, 120}, {260, 345}, {380, 345}, {580, 120}),
              cubicLine({60, 490}, {260, 272}, {380, 272}, {580, 490})};
  strokes.clear();
  drawOver(strokes, intended[0], 2, 7.0, 3);
  drawOver(strokes, intended[1], 2, 7.0, 4);
  expectIntended(mergedLines(strokes, kDistance), intended, 4.0);
}

TEST(Overdrawn, BundlesCross) {
  for (const double angle : {90.0, 60.0, 40.0, 25.0}) {
    SCOPED_TRACE(angle);
    const double half = 0.5 * angle * kPi / 180.0;
    const Vec2 centre(320, 320), d(std::cos(half), std::sin(half)), e(std::cos(half), -std::sin(half));
    const std::vector<IntendedLine> intended{straightLine(centre - 270.0 * d, centre + 270.0 * d),
                                             straightLine(centre - 270.0 * e, centre + 270.0 * e)};
    std::vector<std::vector<Vec2>> strokes;
    drawOver(strokes, intended[0], 3, 14.0, 5);
    drawOver(strokes, intended[1], 3, 14.0, 6);
    expectIntended(mergedLines(strokes, 22.0), intended, 7.5);
  }
}

// A single stroke that overshoots where the others turn goes; the line goes on with the others.
TEST(Overdrawn, WhatOvershootsGoes) {
  const IntendedLine turning = [](double t) {
    const double a = -0.5 * kPi + 1.3 * kPi * t;
    return Vec2(320.0 + 200.0 * std::cos(a), 320.0 + 200.0 * std::sin(a));
  };
  std::vector<std::vector<Vec2>> strokes;
  drawOver(strokes, turning, 2, 7.0, 8);
  const Vec2 from = turning(0.35), along = (turning(0.351) - turning(0.35)).normalized();
  std::vector<Vec2> tangent;
  for (double s = -90.0; s <= 85.0; s += 0.25) tangent.push_back(from + s * along + 4.0 * leftNormal(along));
  strokes.push_back(std::move(tangent));
  expectIntended(mergedLines(strokes, 28.0), {turning}, 7.0);
}

// The mean has no step and no wave where a stroke of the bundle begins or ends.
TEST(Overdrawn, TheMeanIsFairWhereStrokesBegin) {
  const IntendedLine line = straightLine({40, 320}, {600, 320});
  std::vector<std::vector<Vec2>> strokes{strokeAlong(line, 0.0, 1.0, 0.0, 0.0, 0.0),
                                         strokeAlong(line, 0.3, 0.7, 8.0, 0.0, 0.0),
                                         strokeAlong(line, 0.5, 1.0, -7.0, 0.0, 0.0)};
  const auto found = mergedLines(strokes, 22.0);
  ASSERT_EQ(found.size(), 1u);
  double steepest = 0.0, turning = 0.0, last = 0.0;
  const std::vector<Vec2> p = positionsOf(found[0].points);
  constexpr std::size_t kStep = 20;
  for (std::size_t i = kStep; i < p.size(); i += kStep) {
    const Vec2 chord = p[i] - p[i - kStep];
    const double slope = std::atan(chord.y() / chord.x());
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
