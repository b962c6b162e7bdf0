// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/stroke_grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/construct/fair/fair_fit.h"
#include "core/curve/arc_length.h"

namespace batten {
namespace {

constexpr double kStrokeWidthPx = 14.0, kStrokeLengthPx = 1200.0;

/// Gaussian noise a px, of this standard deviation, that is alike over about a stroke's width.
std::vector<double> wandering(std::mt19937& random, int count, double sigmaPx) {
  constexpr double kAlikePx = 0.25 * kStrokeWidthPx;  // of the Gaussian that smooths white noise
  std::normal_distribution<double> normal;
  const int reach = static_cast<int>(3.0 * kAlikePx);
  std::vector<double> white(count + 2 * reach), out(count);
  for (double& w : white) w = normal(random);
  const double scale = sigmaPx * std::sqrt(2.0 * kAlikePx * std::sqrt(std::numbers::pi)) /
                       (kAlikePx * std::sqrt(2.0 * std::numbers::pi));
  for (int i = 0; i < count; ++i) {
    for (int k = -reach; k <= reach; ++k)
      out[i] += scale * white[i + reach + k] * std::exp(-0.5 * k * k / (kAlikePx * kAlikePx));
  }
  return out;
}

/// A stroke along a wide arch whose two borders wander by themselves.
ConstructContour sketched(double borderSigmaPx, std::uint32_t seed, bool hasWidths = true, double wavePx = 0.0) {
  std::mt19937 random(seed);
  const int count = static_cast<int>(kStrokeLengthPx);
  const std::vector<double> left = wandering(random, count, borderSigmaPx),
                            right = wandering(random, count, borderSigmaPx);
  std::normal_distribution<double> fine(0.0, 0.05);
  ConstructContour contour;
  contour.isStroke = true;
  ConstructPiece piece;
  for (int i = 0; i < count; ++i) {
    const double x = i, bow = 60.0 * std::sin(std::numbers::pi * x / kStrokeLengthPx);
    const double wave = wavePx * std::sin(2.0 * std::numbers::pi * x / 200.0);
    PiecePoint p;
    p.at = {x, 300.0 + bow + wave + 0.5 * (left[i] + right[i]) + fine(random)};
    p.sigmaPx = 0.1f;
    if (hasWidths) p.widthPx = static_cast<float>(kStrokeWidthPx + 0.004 * x + left[i] - right[i]);
    piece.points.push_back(p);
  }
  contour.pieces.push_back(std::move(piece));
  return contour;
}

int extremaOf(const ConstructContour& contour) {
  const auto fit = fairFit(contour, {}, {});
  if (!fit) {
    ADD_FAILURE() << fit.error().message;
    return 0;
  }
  return static_cast<int>(std::ranges::count_if(fit->front().report.extrema, &ExtremumNote::kept)) +
         fit->front().report.extremaInSharpFeatures;
}

TEST(StrokeGrain, IsTheScatterOfTheCentreOverAStrokesWidth) {
  std::vector<double> density;
  for (std::uint32_t seed = 1; seed <= 9; ++seed) density.push_back(strokeGrain(sketched(1.2, seed)).density);
  std::ranges::sort(density);
  // Half the difference of two borders: half the variance of one, over the length of its correlation.
  const double expected = 0.5 * 1.2 * 1.2 * 2.0 * 0.25 * kStrokeWidthPx * std::sqrt(std::numbers::pi);
  EXPECT_GT(density[4], 0.5 * expected);
  EXPECT_LT(density[4], 1.6 * expected);
}

TEST(StrokeGrain, ATaperIsNone) {
  const StrokeGrain grain = strokeGrain(sketched(0.0, 1));
  EXPECT_LT(grain.density, 1e-3);
  EXPECT_EQ(strokeGrain(sketched(1.2, 1, false)).density, 0.0);
}

TEST(StrokeGrain, IsNoShapeOfTheLine) {
  // The borders wander by more than a pixel: without the widths that is taken for the drawn line.
  int with = 0, without = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    with += extremaOf(sketched(1.2, seed));
    without += extremaOf(sketched(1.2, seed, false));
  }
  EXPECT_LE(with, 5 * 3) << "the arch has one";
  EXPECT_GT(without, 5 * 6);
}

TEST(StrokeGrain, AWaveThatWasDrawnStays) {
  // Six waves of 4 px in 200: both borders follow them, the width does not.
  const int drawn = extremaOf(sketched(1.2, 3, true, 4.0));
  EXPECT_GE(drawn, 10);
  EXPECT_LE(drawn, 16);
}

TEST(StrokeGrain, APenThatSwellsKeepsItsLine) {
  // Both borders move, one against the other: the centre is known as well as before.
  ConstructContour swelling = sketched(0.0, 5);
  std::mt19937 random(7);
  const auto swell = wandering(random, static_cast<int>(kStrokeLengthPx), 1.5);
  for (std::size_t i = 0; i < swell.size(); ++i)
    *swelling.pieces[0].points[i].widthPx += static_cast<float>(2.0 * swell[i]);
  EXPECT_LT(strokeGrain(swelling).density, 0.1) << "what the arch bends within three widths";
}

/// The outline of an ellipse that was filled with a pencil of kStrokeWidthPx.
ConstructContour filled(double sigmaPx, std::uint32_t seed, bool isPencil) {
  constexpr double kLongPx = 260.0, kShortPx = 150.0;
  std::mt19937 random(seed);
  const int count = static_cast<int>(std::numbers::pi * (kLongPx + kShortPx));
  const std::vector<double> off = wandering(random, count, sigmaPx);
  std::normal_distribution<double> fine(0.0, 0.05);
  ConstructContour contour;
  if (isPencil) contour.pencilPx = kStrokeWidthPx;
  ConstructPiece piece;
  piece.closed = true;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * i / count;
    const Vec2 along = Vec2(-kLongPx * std::sin(t), kShortPx * std::cos(t)).normalized();
    PiecePoint p;
    p.at = Vec2(kLongPx * std::cos(t), kShortPx * std::sin(t)) + (off[i] + fine(random)) * leftNormal(along);
    p.sigmaPx = 0.1f;
    piece.points.push_back(p);
  }
  contour.pieces.push_back(std::move(piece));
  return contour;
}

TEST(StrokeGrain, OfAFilledShapeIsNoShapeOfItsOutline) {
  int with = 0, without = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    with += extremaOf(filled(0.8, seed, true));
    without += extremaOf(filled(0.8, seed, false));
  }
  EXPECT_LE(with, 5 * 14) << "the ellipse has four";
  EXPECT_GT(without, 5 * 40);
}

TEST(StrokeGrain, ACurveDoesNotSwingOutWherePointsAreMissing) {
  // A quarter of the points was not placed, and the rest scatters: no part of the curve leaves what there is.
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    ConstructContour contour = filled(3.0, seed, true);
    std::vector<PiecePoint>& points = contour.pieces[0].points;
    for (std::size_t i = points.size() / 2; i < 3 * points.size() / 4; ++i) points[i].refined = false;
    const auto fit = fairFit(contour, {}, {});
    ASSERT_TRUE(fit);
    for (const CurveSample& sample : sampleByArcLength(fit->front().curve, 400)) {
      double nearest = 1e9;
      for (const PiecePoint& p : points) nearest = std::min(nearest, (p.at - sample.point).norm());
      EXPECT_LT(nearest, kStrokeWidthPx + 1.0) << "seed " << seed;
    }
  }
}

TEST(StrokeGrain, ABendOfAnOutlineIsNone) {
  EXPECT_LT(strokeGrain(filled(0.0, 1, true)).sigmaPx, 0.1);
  EXPECT_GT(strokeGrain(filled(0.8, 1, true)).sigmaPx, 0.3);
  EXPECT_EQ(strokeGrain(filled(0.8, 1, false)).sigmaPx, 0.0);
}

TEST(StrokeGrain, MergedStrokesHaveNone) {
  ConstructContour merged = sketched(1.2, 1);
  for (PiecePoint& p : merged.pieces[0].points) p.spreadPx = 3.0f;
  EXPECT_EQ(strokeGrain(merged).density, 0.0);
}

}  // namespace
}  // namespace batten
