// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_certainty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/contour/corner/corner_suggestions.h"
#include "core/contour/trace_contours.h"
#include "tests/support/angles.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

using test::kDeg;

constexpr double kScalePx = 14.0;

// A line of even steps that goes straight, turns by `angle` along an arc of `radius` px, and goes straight again.
std::vector<Vec2> bend(double angle, double radius, double leg) {
  std::vector<Vec2> points;
  Vec2 at(20.0, 200.0);
  double direction = 0.2;
  const auto go = [&](double length, double turn) {
    const int steps = std::max(1, static_cast<int>(std::lround(length)));
    for (int k = 0; k < steps; ++k) {
      direction += turn / (2.0 * steps);
      at += length / steps * Vec2(std::cos(direction), std::sin(direction));
      direction += turn / (2.0 * steps);
      points.push_back(at);
    }
  };
  go(leg, 0.0);
  if (radius > 0.0) {
    go(radius * std::abs(angle), angle);
  } else {
    direction += angle;
  }
  go(leg, 0.0);
  return points;
}

ContourSet setOf(std::vector<Vec2> points, ContourKind kind, double noisePx, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, noisePx);
  for (Vec2& p : points) p += Vec2(gauss(random), gauss(random));
  Contour contour;
  contour.kind = kind;
  contour.points = contourPoints(points, true);
  if (kind == ContourKind::Centreline)
    for (ContourPoint& p : contour.points) p.widthPx = 5.0f;
  measureContour(contour);
  ContourSet set;
  set.contours.push_back(std::move(contour));
  return set;
}

int certainOn(const ContourSet& set) {
  const auto found = suggestCorners(set, 28 * kDeg, kScalePx, {});
  return static_cast<int>(
      std::ranges::count_if(found, [](const CornerSuggestion& s) { return s.certainty >= kCertainCorner; }));
}

TEST(CornerCertainty, SharpTurnsWithLongSidesAreCertain) {
  int found = 0, all = 0;
  for (const ContourKind kind : {ContourKind::Outline, ContourKind::Centreline}) {
    for (const double degrees : {40.0, 60.0, 90.0, 130.0, -75.0}) {
      for (unsigned seed = 1; seed <= 4; ++seed) {
        found += certainOn(setOf(bend(degrees * kDeg, 0.0, 150.0), kind, 0.05, seed)) == 1 ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GE(found, 0.95 * all) << "of " << all;
}

// A sketching hand rounds a corner somewhat; a pen that draws such a rounding means it.
TEST(CornerCertainty, APencilMayRoundACornerMoreThanAPen) {
  constexpr double kRadiusWidths = 1.95, kWidthPx = 5.0;  // as setOf() has it
  int ofPencil = 0, ofPen = 0, all = 0;
  for (const double degrees : {80.0, 90.0, -80.0}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      ContourSet set =
          setOf(bend(degrees * kDeg, kRadiusWidths * kWidthPx, 150.0), ContourKind::Centreline, 0.05, seed);
      ofPencil += certainOn(set) == 1 ? 1 : 0;
      for (ContourPoint& p : set.contours.front().points) p.sigmaPx = 0.05f;
      ofPen += certainOn(set);
      ++all;
    }
  }
  EXPECT_GE(ofPencil, 0.9 * all) << "of " << all;
  EXPECT_LE(ofPen, 0.1 * all);
}

// A pixel-sharp corner whose tip the neighbourhood filter took: what is left there was not located on the grey values,
// and the place that turns most lies beside the tip.
TEST(CornerCertainty, CornersWithoutTheirTipsAreCertain) {
  constexpr double kLegPx = 150.0, kStepPx = 0.98;
  int found = 0, all = 0;
  for (const double cut : {3.5, 4.0, 4.5}) {
    for (int phase = 0; phase < 8; ++phase) {
      std::vector<Vec2> points;
      int firstGuess = 0, guesses = 0;
      for (double s = 0.125 * phase * kStepPx; s < kLegPx - cut; s += kStepPx) points.emplace_back(0.0, s);
      firstGuess = static_cast<int>(points.size());
      for (double t = 0.4; t < cut - 0.4; t += 0.67, ++guesses) points.emplace_back(1.0 + 0.8 * t, kLegPx - cut + t);
      for (double s = cut; s < kLegPx; s += kStepPx) points.emplace_back(s, kLegPx);
      ContourSet set = setOf(points, ContourKind::Outline, 0.003, 1);
      for (int i = 0; i < guesses; ++i) set.contours[0].points[firstGuess + i].refined = false;
      found += certainOn(set) == 1 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_EQ(found, all);
}

// A rounding is a bend that someone drew, from three widths of the stroke or of the blur on.
TEST(CornerCertainty, RoundedTurnsAreNot) {
  for (const ContourKind kind : {ContourKind::Outline, ContourKind::Centreline}) {
    const double unit = kind == ContourKind::Outline ? 3.0 : 5.0;
    for (const double degrees : {45.0, 60.0, 90.0, 120.0}) {
      for (const double radius : {3.5 * unit, 5.0 * unit, 10.0 * unit}) {
        EXPECT_EQ(certainOn(setOf(bend(degrees * kDeg, radius, 150.0), kind, 0.05, 3)), 0)
            << degrees << " degrees, radius " << radius;
      }
    }
  }
}

// Without located points nothing was seen of the sides of a tip.
TEST(CornerCertainty, RoundedTurnsOfPixelBordersAreNot) {
  for (const double degrees : {60.0, 90.0, 120.0}) {
    for (const double radius : {7.5, 9.0, 10.5}) {
      ContourSet set = setOf(bend(degrees * kDeg, radius, 150.0), ContourKind::Outline, 0.05, 3);
      for (ContourPoint& p : set.contours[0].points) p.refined = false;
      EXPECT_EQ(certainOn(set), 0) << degrees << " degrees, radius " << radius;
    }
  }
}

TEST(CornerCertainty, SlightTurnsAndShortSidesAreNot) {
  for (const double degrees : {12.0, 20.0, 27.0})
    EXPECT_EQ(certainOn(setOf(bend(degrees * kDeg, 0.0, 150.0), ContourKind::Outline, 0.05, 5)), 0) << degrees;
  // The hook at the end of a stroke is no corner of the line.
  std::vector<Vec2> hook = bend(60.0 * kDeg, 0.0, 150.0);
  hook.resize(150 + 11);
  EXPECT_EQ(certainOn(setOf(hook, ContourKind::Centreline, 0.05, 5)), 0);
}

// A zigzag as pencil on rough paper leaves it: every turn turns back at once.
TEST(CornerCertainty, DentsAreNot) {
  std::vector<Vec2> points;
  for (int i = 0; i < 600; ++i) {
    const double within = i % 40 / 20.0;
    points.emplace_back(i, 100.0 + 8.0 * (within < 1.0 ? within : 2.0 - within));
  }
  EXPECT_EQ(certainOn(setOf(points, ContourKind::Centreline, 0.05, 7)), 0);
}

TEST(CornerCertainty, LiesBetweenNoneAndOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> turn(-3.0, 3.0), leg(3.0, 80.0), radius(0.0, 20.0);
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec2> points = bend(turn(random), radius(random), leg(random));
    for (const CornerSuggestion& s :
         suggestCorners(setOf(points, ContourKind::Outline, 0.3, static_cast<unsigned>(k)), 20 * kDeg, kScalePx, {})) {
      EXPECT_GE(s.certainty, 0.0);
      EXPECT_LE(s.certainty, 1.0);
    }
  }
}

// Ragged ink is looked at in the scale of its raggedness: the corners of the shape count, its bristles do not.
TEST(CornerCertainty, RaggedBordersAreNotShattered) {
  int corners = 0, elsewhere = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss(0.0, 1.0);
    std::vector<Vec2> square;
    for (int i = 0; i < 300; ++i) square.emplace_back(i, 0);
    for (int i = 0; i < 300; ++i) square.emplace_back(300, i);
    for (int i = 300; i > 0; --i) square.emplace_back(i, 300);
    for (int i = 300; i > 0; --i) square.emplace_back(0, i);
    // Dents of about a pixel, some pixels long: white noise under a running mean.
    const int n = static_cast<int>(square.size());
    std::vector<Vec2> white(square.size()), ragged = square;
    for (Vec2& w : white) w = Vec2(gauss(random), gauss(random));
    for (int i = 0; i < n; ++i)
      for (int k = -3; k <= 3; ++k) ragged[i] += 0.4 * white[(i + k + n) % n];
    ContourSet set = setOf(ragged, ContourKind::Outline, 0.0, 1);
    set.contours.front().closed = true;
    measureContour(set.contours.front());
    for (const CornerSuggestion& s : suggestCorners(set, 28 * kDeg, kScalePx, {})) {
      if (s.certainty < kCertainCorner) continue;
      const auto nearEnd = [](double v) { return std::min(std::abs(v), std::abs(v - 300.0)) < 8.0; };
      ++(nearEnd(s.positionPx.x()) && nearEnd(s.positionPx.y()) ? corners : elsewhere);
    }
  }
  EXPECT_EQ(elsewhere, 0);
  EXPECT_GE(corners, 5);  // of 20
}

}  // namespace
}  // namespace batten
