// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/construct/light/light_curve.h"
#include "core/construct/light/light_pieces.h"
#include "core/curve/curvature.h"
#include "tests/support/asked_count.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

constexpr double kWobble = 0.05;  // [px]
constexpr double kInkWidth = 24.0;

/// Some by default, BATTEN_RANDOM_LINES where it is set.
int wheels() { return test::askedCount("BATTEN_RANDOM_LINES", 60); }

/// A circle as a pen and a scanner leave it: a few waves of a twentieth of a pixel, some of which are counted as
/// extrema of the curvature and some are not.
NurbsCurve wobblyCircle(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double radius = 30.0 + 170.0 * uniform(random);
  struct Wave {
    int count;
    double height, phase;
  };
  std::vector<Wave> waves;
  for (int count = 2; count <= 5; ++count)
    waves.push_back({count, kWobble * uniform(random), 2.0 * std::numbers::pi * uniform(random)});
  test::TruthPiece piece;
  constexpr int kSteps = 6000;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSteps;
    double r = radius;
    for (const Wave& wave : waves) r += wave.height * std::cos(wave.count * a + wave.phase);
    piece.points.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  return test::denseCurve(piece, true);
}

ConstructedPiece lightPieceOf(const NurbsCurve& dense, bool closed, double detail) {
  ConstructContour contour;
  contour.pieces.resize(1);
  contour.pieces.front().closed = closed;
  contour.inkWidthPx = kInkWidth;
  ConstructParams params;
  params.detail = detail;
  std::vector<ConstructedPiece> made(1);
  made.front().curve = dense;
  if (!makePiecesLight(made, contour, params, {}) || !made.front().report.light) throw std::runtime_error("not made");
  return std::move(made.front());
}

TEST(LightExtrema, AWobblyCircleHasNoMoreThanBefore) {
  int light = 0;
  for (int seed = 1; seed <= wheels(); ++seed) {
    const NurbsCurve dense = wobblyCircle(static_cast<unsigned>(seed));
    const ConstructedPiece made = lightPieceOf(dense, true, 0.0);
    EXPECT_LE(countedExtrema(made.curve, true), countedExtrema(dense, true)) << "circle " << seed;
    light += made.report.light->found ? 1 : 0;
  }
  EXPECT_GE(10 * light, 9 * wheels()) << "circles stay dense";
}

/// A long side that all but does not bend, its curvature rising in two steps by less than an extremum is counted from:
/// of a shape ten times its size one would be seen.
NurbsCurve risingSide(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr double kLength = 3000.0;
  constexpr int kSteps = 6000;
  const double first = 0.1 + 0.3 * uniform(random), second = 0.6 + 0.3 * uniform(random), steep = 20.0;
  const double rise = 0.45 * kExtremumProminence / kLength, start = 4.0 * rise * (uniform(random) - 0.5);
  test::TruthPiece piece;
  piece.points.push_back(Vec2::Zero());
  double angle = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double f = (i + 0.5) / kSteps, step = kLength / kSteps;
    const double kappa = start + 0.5 * rise * (2.0 + std::tanh(steep * (f - first)) + std::tanh(steep * (f - second)));
    angle += 0.5 * step * kappa;
    piece.points.push_back(piece.points.back() + step * Vec2(std::cos(angle), std::sin(angle)));
    angle += 0.5 * step * kappa;
  }
  return test::denseCurve(piece, false);
}

TEST(LightExtrema, ASideThatAllButDoesNotBendGetsNoneThatAWholeShapeWouldShow) {
  for (int seed = 1; seed <= wheels(); ++seed) {
    const NurbsCurve dense = risingSide(static_cast<unsigned>(seed));
    const double fine = 0.1 * kExtremumProminence / extent(dense);
    const ConstructedPiece made = lightPieceOf(dense, false, 0.0);
    EXPECT_LE(curvatureExtrema(made.curve, fine, false).size(), curvatureExtrema(dense, fine, false).size())
        << "side " << seed;
    EXPECT_TRUE(made.report.light->found) << "side " << seed;
  }
}

/// A line without deviations larger than the tolerance keeps its extrema: none may come in.
TEST(LightExtrema, DetailAddsNone) {
  for (int seed = 1; seed <= wheels() / 4; ++seed) {
    const NurbsCurve dense = wobblyCircle(static_cast<unsigned>(seed));
    for (const double detail : {0.1, 0.2, 0.3}) {
      const ConstructedPiece made = lightPieceOf(dense, true, detail);
      EXPECT_LE(countedExtrema(made.curve, true), countedExtrema(dense, true))
          << "circle " << seed << ", detail " << detail;
    }
  }
}

TEST(LightNote, CountsControlPointsAsTheListDoes) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const NurbsCurve dense = wobblyCircle(seed);
    for (const double detail : {0.0, 1.0}) {
      const ConstructedPiece made = lightPieceOf(dense, true, detail);
      EXPECT_EQ(made.report.light->points, made.curve.controlPointCount()) << "circle " << seed;
      EXPECT_EQ(made.report.light->pointsBefore, dense.controlPointCount()) << "circle " << seed;
    }
  }
}

}  // namespace
}  // namespace batten
