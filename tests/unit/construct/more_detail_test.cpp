// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/construct/light/light_pieces.h"
#include "tests/support/asked_count.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

/// What a hand draws: a few bends, an edge that trembles or does not, and now and then a corner.
test::TruthPiece handLine(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double length = 150.0 + 250.0 * uniform(random), bend = 4.0 * uniform(random), wave = 9.0 * uniform(random),
               phase = 6.0 * uniform(random), tremble = uniform(random) < 0.5 ? 0.0 : 1.5 * uniform(random),
               corner = uniform(random) < 0.4 ? 2.0 * uniform(random) - 1.0 : 0.0, at = 0.3 + 0.4 * uniform(random);
  test::TruthPiece piece;
  const int steps = 3000;
  Vec2 p = Vec2::Zero();
  double angle = 6.28 * uniform(random);
  for (int i = 0; i <= steps; ++i) {
    const double f = static_cast<double>(i) / steps, s = f * length;
    const Vec2 way(std::cos(angle), std::sin(angle));
    piece.points.push_back(p + tremble * (0.6 * std::sin(0.31 * s) + 0.4 * std::sin(0.47 * s + 1.0)) * leftNormal(way));
    p += length / steps * way;
    angle += bend / steps * (0.4 + std::sin(wave * f + phase));
    if (std::abs(f - at) < 0.01) angle += corner * 50.0 / steps;
  }
  return piece;
}

test::TruthPiece handRing(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double radius = 25.0 + 40.0 * uniform(random), long_ = 1.0 + uniform(random), dent = 0.15 * uniform(random),
               tremble = uniform(random) < 0.5 ? 0.0 : 1.2 * uniform(random);
  test::TruthPiece piece;
  const int steps = 3000;
  for (int i = 0; i < steps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / steps;
    const double r = radius * (1.0 + dent * std::cos(3.0 * a)) + tremble * std::sin(41.0 * a);
    piece.points.emplace_back(long_ * r * std::cos(a), r * std::sin(a));
  }
  return piece;
}

/// How many lines: some by default, BATTEN_RANDOM_LINES where it is set.
int linesOfDetail() { return test::askedCount("BATTEN_RANDOM_LINES", 25); }

/// A curve of a smaller detail of so many control points, or fewer, is the curve of a larger one that needs more.
constexpr int kMostKept = 40;

TEST(MoreDetail, NeverGivesMoreControlPoints) {
  constexpr std::array kDetails = {0.0, 0.2, 0.4, 0.5};
  std::mt19937 random(616);
  int won = 0;
  for (int i = 0; i < linesOfDetail(); ++i) {
    const bool closed = i % 3 == 2;
    const NurbsCurve dense = test::denseCurve(closed ? handRing(random) : handLine(random), closed);
    ConstructContour contour;
    contour.pieces.resize(1);
    contour.pieces.front().closed = closed;
    contour.inkWidthPx = 24.0;
    int before = std::numeric_limits<int>::max();
    for (const double detail : kDetails) {
      ConstructParams params;
      params.detail = detail;
      std::vector<ConstructedPiece> made(1);
      made.front().curve = dense;
      ASSERT_TRUE(makePiecesLight(made, contour, params, {}));
      ASSERT_TRUE(made.front().report.light);
      const LightNote& light = *made.front().report.light;
      const int points = light.found ? light.points : dense.controlPointCount();
      if (before <= kMostKept) {
        EXPECT_LE(points, before) << "line " << i << ", detail " << detail;
      }
      won += points < before ? 1 : 0;
      before = points;
    }
  }
  EXPECT_GT(won, 3 * linesOfDetail() / 2) << "detail hardly ever spares a control point";
}

/// How soon a search for fewer control points is given up, and what it tries, shows here: of 6542 in the dense curves.
TEST(LightLines, DrawnByHandNeedFewControlPoints) {
  constexpr int kKnownToDo = 3800, kLinesOfSeed = 40;
  int points = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < kLinesOfSeed; ++i) {
      const bool closed = i % 4 == 3;
      const NurbsCurve dense = test::denseCurve(closed ? handRing(random) : handLine(random), closed);
      const auto light = makeLight(dense, closed, LightOptions{}, {});
      ASSERT_TRUE(light);
      points += light->curve.controlPointCount();
    }
  }
  EXPECT_LE(points, kKnownToDo);
}

}  // namespace
}  // namespace batten
