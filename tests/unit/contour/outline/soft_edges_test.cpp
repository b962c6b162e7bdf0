// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/soft_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/contour/outline/crack_contours.h"
#include "core/contour/outline/edge_fade.h"
#include "core/contour/outline/subpixel_edges.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

constexpr int kPage = 480;
constexpr double kPaper = 230.0, kContrast = 100.0;
const Vec2 kDiscCentre(240.3, 239.6);

double normalCdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// A disc; its tone falls inward as exp(-d / fade), 0 = it does not. The blur of a disc moves the half level inward by
/// blur^2 / (2 radius); but for that the edge is blurred like a straight one.
GreyImage softDisc(double radius, double blur, double fadePx, double noise, unsigned seed,
                   const Vec2& middle = kDiscCentre) {
  GreyImage grey(kPage, kPage);
  std::mt19937 random(seed);
  std::normal_distribution<double> deviate(0.0, 1.0);
  const double part = fadePx > 0.0 ? blur / fadePx : 0.0;
  for (int y = 0; y < kPage; ++y) {
    for (int x = 0; x < kPage; ++x) {
      const double d = radius - 0.5 * blur * blur / radius - std::hypot(x + 0.5 - middle.x(), y + 0.5 - middle.y());
      const double fade = fadePx > 0.0 ? std::exp(0.5 * part * part - d / fadePx) : 1.0;
      const double level = kPaper - kContrast * fade * normalCdf(d / blur - part) + noise * deviate(random);
      grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * GreyImage::kGreyUnit));
    }
  }
  return grey;
}

/// The outline of a page at half its contrast; as it is placed on the scan itself when `soft` is false.
Contour outlineOf(const GreyImage& grey, bool soft) {
  auto set = crackContours(test::thresholdMask(grey, kPaper - 0.5 * kContrast), false, 40.0, {});
  std::sort(set->contours.begin(), set->contours.end(),
            [](const Contour& a, const Contour& b) { return a.lengthPx > b.lengthPx; });
  set->contours.resize(1);
  refineOutline(set->contours[0], grey, {});
  if (soft) refineSoftOutlines(*set, grey, {});
  return set->contours[0];
}

struct Misses {
  double bias = 0.0, rms = 0.0;
};

Misses fromCircle(const Contour& c, double radius) {
  Misses m;
  for (const Vec2& p : positionsOf(c.points)) {
    const double e = (p - kDiscCentre).norm() - radius;
    m.bias += e / static_cast<double>(c.points.size());
    m.rms += e * e / static_cast<double>(c.points.size());
  }
  m.rms = std::sqrt(m.rms);
  return m;
}

TEST(RefineSoftOutlines, EdgesOverManyPixelsAreFoundThroughNoise) {
  for (const double blur : {3.0, 5.0, 8.0}) {
    const GreyImage grey = softDisc(150.0, blur, 0.0, 6.0, 5);
    const Contour before = outlineOf(grey, false), after = outlineOf(grey, true);
    const Misses was = fromCircle(before, 150.0), is = fromCircle(after, 150.0);
    printf("blur %.0f: rms %.3f -> %.3f, bias %.3f, blur found %.2f\n", blur, was.rms, is.rms, is.bias,
           after.blurPx.value_or(0.0));
    EXPECT_LE(is.rms, 0.55 * was.rms);
    // An arc of 1 px tells its place to noise / contrast * sqrt(2 sqrt(pi) blur), of some px as long as the copy's.
    EXPECT_LE(is.rms, 6.0 / kContrast * std::sqrt(3.545 * blur));
    EXPECT_LE(std::abs(is.bias), 0.01 * blur);
    EXPECT_NEAR(after.blurPx.value_or(0.0), blur, 0.12 * blur);
    for (const ContourPoint& p : after.points) ASSERT_TRUE(p.sigmaPx);
    EXPECT_NEAR(after.lengthPx, 2.0 * 3.14159265 * 150.0, 15.0);
  }
}

TEST(RefineSoftOutlines, TighterCurvesAreNotShifted) {
  const Contour c = outlineOf(softDisc(60.0, 4.0, 0.0, 2.0, 7), true);
  EXPECT_LE(std::abs(fromCircle(c, 60.0).bias), 0.04);
}

TEST(RefineSoftOutlines, SmallSoftDotsKeepTheirSize) {
  for (const double radius : {15.0, 24.0}) {
    const GreyImage grey = softDisc(radius, 4.4, 0.0, 1.0, 3);
    const double was = fromCircle(outlineOf(grey, false), radius).bias;
    const double is = fromCircle(outlineOf(grey, true), radius).bias;
    printf("radius %.0f: bias %.3f -> %.3f\n", radius, was, is);
    EXPECT_LE(std::abs(is), std::max(0.15, std::abs(was)));
  }
}

TEST(RefineSoftOutlines, AFadingToneIsNotFoundTooFarOutside) {
  const GreyImage grey = softDisc(150.0, 4.0, 90.0, 2.0, 5);
  const double is = fromCircle(outlineOf(grey, true), 150.0).bias;
  printf("fading and soft: bias %.3f\n", is);
  EXPECT_LE(std::abs(is), 0.06);
}

TEST(RefineSoftOutlines, SharpEdgesStayAsTheyAre) {
  const GreyImage grey = softDisc(150.0, 0.9, 0.0, 6.0, 5);
  EXPECT_TRUE(outlineOf(grey, true).points == outlineOf(grey, false).points);
}

TEST(RefineSoftOutlines, AreTheSameWithAnyNumberOfThreads) {
  GreyImage grey = softDisc(80.0, 5.0, 80.0, 6.0, 5, {130.2, 140.7});
  for (const Vec2& middle : {Vec2(330.4, 120.3), Vec2(250.6, 350.1)}) {
    const GreyImage other = softDisc(90.0, 5.0, 80.0, 6.0, 5, middle);
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) grey.pixels[i] = std::min(grey.pixels[i], other.pixels[i]);
  }
  auto set = crackContours(test::thresholdMask(grey, kPaper - 0.5 * kContrast), false, 40.0, {});
  for (Contour& c : set->contours) refineOutline(c, grey, {});
  ContourSet other = *set;
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  refineSoftOutlines(*set, grey, one);
  refineSoftOutlines(other, grey, four);
  ASSERT_GE(set->contours.size(), 3U);
  ASSERT_EQ(set->contours.size(), other.contours.size());
  for (std::size_t i = 0; i < set->contours.size(); ++i) {
    EXPECT_TRUE(set->contours[i].points == other.contours[i].points);
    EXPECT_EQ(set->contours[i].blurPx, other.contours[i].blurPx);
  }
}

TEST(UndoFade, AToneThatFadesBehindItsEdgeDoesNotMoveIt) {
  for (const double fade : {60.0, 120.0}) {
    const GreyImage grey = softDisc(150.0, 1.6, fade, 1.0, 9);
    Contour c = outlineOf(grey, false);
    const double was = fromCircle(c, 150.0).bias;
    undoFade(c, grey, {});
    const double is = fromCircle(c, 150.0).bias;
    printf("fade %.0f: bias %.3f -> %.3f\n", fade, was, is);
    EXPECT_GE(was, 0.03);
    EXPECT_LE(std::abs(is), 0.25 * was);
  }
}

TEST(UndoFade, WithoutAFadeNothingMoves) {
  const GreyImage grey = softDisc(150.0, 1.6, 0.0, 0.0, 9);
  Contour c = outlineOf(grey, false);
  const std::vector<Vec2> was = positionsOf(c.points);
  undoFade(c, grey, {});
  for (std::size_t i = 0; i < was.size(); ++i) EXPECT_LE((c.points[i].at - was[i]).norm(), 0.005);
}

}  // namespace
}  // namespace batten
