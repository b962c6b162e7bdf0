// SPDX-License-Identifier: GPL-3.0-or-later
// A tone of a pencil that lines of it run into: against what is known of the page.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contour/ink/blots.h"
#include "core/contour/ink/ink_split.h"
#include "core/contour/ink/pencil_solids.h"
#include "core/image/bits/bit_steps.h"
#include "tests/support/dense_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

constexpr int kSolidPageWidth = 480, kSolidPageHeight = 360;
constexpr double kToneRadius = 36.0;
const Vec2 kToneCentre(240.0, 180.0);

GreyImage tonePage() {
  std::vector<std::vector<Vec2>> lines = test::hatchLines(kToneCentre, 20.0, 5, 60.0, 420.0, 0.0);
  for (auto& line : test::hatchLines(kToneCentre, 110.0, 5, 60.0, 300.0, 0.0)) lines.push_back(std::move(line));
  std::vector<float> cover = test::coverageOf(lines, 7.0, kSolidPageWidth, kSolidPageHeight);
  for (int y = 0; y < kSolidPageHeight; ++y) {
    for (int x = 0; x < kSolidPageWidth; ++x) {
      const bool isTone = (Vec2(x + 0.5, y + 0.5) - kToneCentre).norm() < kToneRadius;
      if (isTone) cover[y * kSolidPageWidth + x] = 1.0f;
    }
  }
  test::grainCoverage(
      cover, kSolidPageWidth, kSolidPageHeight, [](double, double) { return 1.0; }, 5);
  return test::scanOfLines(std::move(cover), kSolidPageWidth, kSolidPageHeight, 7).grey;
}

TEST(PencilSolids, AreShapesAndTheLinesThatRunIntoThemAreStrokes) {
  const GreyImage grey = tonePage();
  const ThresholdParams params;
  const BitImage ink = *binarize(grey, *findThresholds(grey, {}, params, {}), params, {});
  const auto split = splitInk(ink, grey, {}, {});
  ASSERT_TRUE(split);
  ASSERT_TRUE(split->pencil);
  EXPECT_GT(split->pencil->ink.count(), 0) << "else this is no pencil";
  int tone = 0, found = 0, astray = 0;
  for (int y = 0; y < kSolidPageHeight; ++y) {
    for (int x = 0; x < kSolidPageWidth; ++x) {
      const double distance = (Vec2(x + 0.5, y + 0.5) - kToneCentre).norm();
      if (distance < kToneRadius - 3.0) {
        ++tone;
        found += split->shapes.at(x, y) ? 1 : 0;
      }
      astray += distance > kToneRadius + 8.0 && split->shapes.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(found, 0.97 * tone);
  EXPECT_EQ(astray, 0);
}

// Straight lines of a pencil, and tones where `isTone`.
template <class IsTone>
GreyImage pencilPage(const std::vector<std::vector<Vec2>>& lines, std::uint32_t seed, const IsTone& isTone) {
  std::vector<float> cover = test::coverageOf(lines, 7.0, kSolidPageWidth, kSolidPageHeight);
  for (int y = 0; y < kSolidPageHeight; ++y) {
    for (int x = 0; x < kSolidPageWidth; ++x) {
      if (isTone(Vec2(x + 0.5, y + 0.5))) cover[y * kSolidPageWidth + x] = 1.0f;
    }
  }
  test::grainCoverage(
      cover, kSolidPageWidth, kSolidPageHeight, [](double, double) { return 1.0; }, seed);
  return test::scanOfLines(std::move(cover), kSolidPageWidth, kSolidPageHeight, seed).grey;
}

// However much larger the solid is than the lines.
TEST(PencilSolids, LeaveTheLinesThatAreJoinedToALargeOneStrokes) {
  constexpr double kRadius = 100.0, kBorderPx = 8.0;
  const auto lines = test::hatchLines(kToneCentre, 12.0, 3, 60.0, 440.0, 0.0);
  for (const std::uint32_t seed : {2u, 3u, 5u}) {
    const GreyImage grey = pencilPage(lines, seed, [](const Vec2& p) { return (p - kToneCentre).norm() < kRadius; });
    const ThresholdParams params;
    const BitImage ink = *binarize(grey, *findThresholds(grey, {}, params, {}), params, {});
    const auto split = splitInk(ink, grey, {}, {});
    ASSERT_TRUE(split && split->pencil);
    int inside = 0, found = 0, astray = 0, strokes = 0;
    for (int y = 0; y < kSolidPageHeight; ++y) {
      for (int x = 0; x < kSolidPageWidth; ++x) {
        const double distance = (Vec2(x + 0.5, y + 0.5) - kToneCentre).norm();
        inside += distance < kRadius - kBorderPx ? 1 : 0;
        found += distance < kRadius - kBorderPx && split->shapes.at(x, y) ? 1 : 0;
        astray += distance > kRadius + kBorderPx && split->shapes.at(x, y) ? 1 : 0;
        strokes += distance > kRadius + kBorderPx && split->strokes.at(x, y) ? 1 : 0;
      }
    }
    EXPECT_GT(found, 0.8 * inside) << "seed " << seed << ": but for its grain";
    EXPECT_LT(astray, 0.02 * strokes) << "seed " << seed;
  }
}

TEST(PencilSolids, ADotAloneIsFollowedByItsBorderAndSpecksAreNot) {
  constexpr double kDotRadius = 11.0;
  const std::vector<Vec2> dots = {{100, 83}, {380, 270}};
  const auto lines = test::hatchLines(kToneCentre, 3.0, 5, 60.0, 420.0, 0.0);
  for (const std::uint32_t seed : {2u, 3u, 5u, 7u}) {
    const GreyImage grey = pencilPage(lines, seed, [&](const Vec2& p) {
      return std::any_of(dots.begin(), dots.end(), [&](const Vec2& d) { return (p - d).norm() < kDotRadius; });
    });
    std::vector<int> borders(dots.size(), 0);
    for (const Contour& c : tracedPage(grey).contours) {
      if (c.kind != ContourKind::Outline) continue;
      bool isOfDot = false;
      for (std::size_t i = 0; i < dots.size(); ++i) {
        if ((c.points.front().at - dots[i]).norm() > 1.5 * kDotRadius) continue;
        ++borders[i];
        isOfDot = true;
        EXPECT_NEAR(c.areaPx, 3.14159 * kDotRadius * kDotRadius, 0.3 * 3.14159 * kDotRadius * kDotRadius);
      }
      EXPECT_TRUE(isOfDot) << "seed " << seed << ": at " << c.points.front().at.transpose();
    }
    for (const int count : borders) EXPECT_EQ(count, 1) << "seed " << seed;
  }
}

// A triangle, its corners clockwise on the page.
struct Triangle {
  Vec2 a, b, c;
  bool contains(const Vec2& p) const {
    const auto side = [&](const Vec2& from, const Vec2& to) {
      return (to - from).x() * (p - from).y() - (to - from).y() * (p - from).x();
    };
    return side(a, b) > 0.0 && side(b, c) > 0.0 && side(c, a) > 0.0;
  }
};

TEST(PencilSolids, LeaveTheLinesBesideThemStrokes) {
  const Triangle tone{{150, 120}, {300, 150}, {180, 250}};
  auto lines = test::hatchLines({400, 180}, 80.0, 4, 30.0, 300.0, 0.0);
  for (auto& line : test::hatchLines({60, 180}, 80.0, 3, 30.0, 300.0, 0.0)) lines.push_back(std::move(line));
  for (const std::uint32_t seed : {2u, 3u, 5u}) {
    const ContourSet set = tracedPage(pencilPage(lines, seed, [&](const Vec2& p) { return tone.contains(p); }));
    double centrePx = 0.0;
    for (const Contour& c : set.contours) {
      const double x = c.points.front().at.x();
      if (x > 130.0 && x < 320.0) continue;
      EXPECT_EQ(c.kind, ContourKind::Centreline) << "seed " << seed << ": at " << c.points.front().at.transpose();
      centrePx += c.lengthPx;
    }
    EXPECT_GT(centrePx, 0.9 * 7 * 300.0) << "seed " << seed;
  }
}

void fill(BitImage& image, int x0, int y0, int x1, int y1) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) image.set(x, y, true);
  }
}

Contour lineAlong(const Vec2& from, const Vec2& to, float widthPx) {
  Contour line;
  line.kind = ContourKind::Centreline;
  for (double s = 0.0; s <= (to - from).norm(); s += 1.0) {
    ContourPoint point;
    point.at = point.unrefined = from + s * (to - from).normalized();
    point.widthPx = widthPx;
    line.points.push_back(point);
  }
  return line;
}

// A solid at the left, lines of 6 px above, and tones below them: one goes on from the solid, one stands alone.
TEST(PencilSolids, GoOnWhereNoLineExplainsTheInkBesideThem) {
  BitImage tones(200, 100);
  fill(tones, 60, 30, 90, 70);
  fill(tones, 140, 30, 170, 70);
  InkSplit split;
  split.shapes = BitImage(200, 100);
  fill(split.shapes, 20, 30, 60, 70);
  split.strokes = tones;
  fill(split.strokes, 60, 24, 190, 30);
  const BitImage all = either(split.strokes, split.shapes);
  split.pencil = PencilInk{all, all, 6.0};
  split.penPx = 6.0;
  ContourSet lines;
  lines.contours.push_back(lineAlong({54, 27}, {196, 27}, 6.0f));
  const BitImage found = findFillings(split, lines, {});
  const BitImage astray = without(found, tones);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) EXPECT_FALSE(astray.at(x, y)) << "on the line or on paper, " << x << " " << y;
  }
  BitImage beside(200, 100);
  fill(beside, 60, 36, 86, 66);  // but its corners, which are round
  EXPECT_EQ(without(beside, found).count(), 0) << "all of the tone but what the line reaches";
  for (int x = 140; x < 170; ++x) EXPECT_FALSE(found.at(x, 50)) << "a tone has no border";
}

// A square with lines of 6 px: from the middle of one side, and along another.
TEST(PencilSolids, KeepTheirCorners) {
  BitImage square(200, 140), body(200, 140);
  fill(square, 60, 30, 130, 100);
  fill(body, 0, 60, 60, 66);
  fill(body, 130, 94, 200, 100);
  body = either(std::move(body), square);
  for (int x = 62; x < 128; x += 7) body.set(x, 29, true);  // a ragged border
  const BitImage solids = pencilSolids(body, square, 6.0, {});
  constexpr double kLost = 0.01;
  EXPECT_LT(without(BitImage(square), solids).count(), kLost * square.count());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(solids.at(61 + i, 31)) << i;
    EXPECT_TRUE(solids.at(61 + i, 98)) << i;
    EXPECT_TRUE(solids.at(128 - i, 31)) << i;
  }
  for (int x = 0; x < 50; ++x) EXPECT_FALSE(solids.at(x, 63)) << "a line, " << x;
  for (int x = 150; x < 200; ++x) EXPECT_FALSE(solids.at(x, 97)) << "a line, " << x;
}

// A bar, which is no more than a broad stroke, leaves a solid with a step in width: that stays a solid.
TEST(PencilSolids, DoNotSwellFromTheBarsBesideThem) {
  BitImage solid(320, 140), body(320, 140);
  fill(solid, 30, 30, 100, 100);
  fill(body, 100, 83, 320, 100);
  body = either(std::move(body), solid);
  const BitImage solids = pencilSolids(body, solid, 6.0, {});
  constexpr double kLost = 0.01;
  EXPECT_LT(without(BitImage(solid), solids).count(), kLost * solid.count());
}

TEST(PencilSolids, TheMarginOfThePageIsNoMark) {
  InkSplit split;
  split.shapes = BitImage(200, 100);
  split.strokes = BitImage(200, 100);
  fill(split.strokes, 120, 0, 196, 12);
  fill(split.strokes, 40, 40, 56, 56);
  split.pencil = PencilInk{split.strokes, split.strokes, 5.0};
  split.penPx = 5.0;
  const BitImage found = findBlots(split, {}, BitImage(200, 100), 3.0, {});
  EXPECT_TRUE(found.at(48, 48));
  EXPECT_FALSE(found.at(160, 5));
}

}  // namespace
}  // namespace batten
