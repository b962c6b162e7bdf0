// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes between strokes and short faint ones: against lines whose course is known.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/contour/contour_set.h"
#include "tests/support/dense_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

constexpr int kLadderWidth = 480, kLadderHeight = 360;
using Lines = std::vector<std::vector<Vec2>>;

std::vector<Vec2> rail(const Vec2& a, const Vec2& b) {
  const int steps = static_cast<int>((b - a).norm());
  std::vector<Vec2> line;
  for (int i = 0; i <= steps; ++i) line.push_back(a + (b - a) * i / steps);
  return line;
}

// Inks lines over a coverage, up to `most` of full ink.
void ink(std::vector<float>& cover, const Lines& lines, double widthPx, float most) {
  const std::vector<float> added = test::coverageOf(lines, widthPx, kLadderWidth, kLadderHeight);
  for (std::size_t i = 0; i < cover.size(); ++i) cover[i] = std::max(cover[i], most * added[i]);
}

// Share of a line's middle three quarters that found lines of its direction cover within `nearPx`.
double covered(const std::vector<Vec2>& line, const ContourSet& set, double nearPx) {
  const int n = static_cast<int>(line.size()), skip = n / 8;
  const Vec2 along = (line.back() - line.front()).normalized();
  int found = 0;
  for (int i = skip; i < n - skip; ++i) {
    const bool isNear = std::any_of(set.contours.begin(), set.contours.end(), [&](const Contour& c) {
      for (std::size_t k = 0; k + 1 < c.points.size(); ++k) {
        const Vec2 d = c.points[k + 1].at - c.points[k].at;
        if ((c.points[k].at - line[i]).norm() < nearPx && std::abs(d.normalized().dot(along)) > 0.8) return true;
      }
      return false;
    });
    found += isNear ? 1 : 0;
  }
  return static_cast<double>(found) / (n - 2 * skip);
}

// How many of the lines have at least this share of theirs covered.
int linesFound(const Lines& lines, const ContourSet& set, double share) {
  return static_cast<int>(
      std::count_if(lines.begin(), lines.end(), [&](const auto& line) { return covered(line, set, 3.0) > share; }));
}

constexpr std::uint32_t kSeeds[] = {2, 3, 5, 7};

GreyImage pencilScan(std::vector<float> cover, std::uint32_t seed) {
  constexpr double kGrain = 0.75;
  test::grainCoverage(
      cover, kLadderWidth, kLadderHeight, [](double, double) { return kGrain; }, seed);
  return test::scanOfLines(std::move(cover), kLadderWidth, kLadderHeight, seed).grey;
}

// A page of long pencil strokes, and short ones of six tenths of their coverage.
GreyImage pencilPage(const Lines& strong, const Lines& weak, std::uint32_t seed) {
  constexpr double kPencilPx = 6.0;
  constexpr float kWeak = 0.6f;
  std::vector<float> cover(static_cast<std::ptrdiff_t>(kLadderWidth) * kLadderHeight, 0.0f);
  ink(cover, weak, kPencilPx, kWeak);
  ink(cover, strong, kPencilPx, 1.0f);
  return pencilScan(std::move(cover), seed);
}

// A pencil presses less on the short strokes between the long ones; they end in those, as grain does not.
TEST(ShortStrokes, AWeakStrokeBetweenStrongOnesHasALine) {
  Lines rails, rungs;
  for (int k = 0; k < 8; ++k) rails.push_back(rail({40.0, 30.0 + 40.0 * k}, {440.0, 34.0 + 40.0 * k}));
  for (int k = 0; k < 7; ++k)
    rungs.push_back(rail({100.0 + 40.0 * k, 30.6 + 40.4 * k}, {100.0 + 40.0 * k, 70.6 + 40.4 * k}));
  int found = 0;
  for (const std::uint32_t seed : kSeeds) found += linesFound(rungs, tracedPage(pencilPage(rails, rungs, seed)), 0.7);
  EXPECT_GE(found, 25) << "of 28";
}

// Rails with a little paper between them: their rungs lie among the discs of the junctions from end to end, where
// the middle of a stroke cannot be measured.
TEST(ShortStrokes, ARungBetweenBroadRailsHasALine) {
  constexpr double kRailPx = 8.0, kRungPx = 6.0;
  Lines rails = {rail({200, 40}, {200, 320}), rail({222, 40}, {222, 320})}, rungs, thin;
  for (int k = 0; k < 4; ++k) rungs.push_back(rail({200.0, 80.0 + 60.0 * k}, {222.0, 80.0 + 60.0 * k}));
  for (int k = 0; k < 8; ++k) thin.push_back(rail({300.0, 40.0 + 40.0 * k}, {450.0, 45.0 + 40.0 * k}));
  std::vector<float> cover(static_cast<std::ptrdiff_t>(kLadderWidth) * kLadderHeight, 0.0f);
  ink(cover, rails, kRailPx, 1.0f);
  ink(cover, rungs, kRungPx, 1.0f);
  ink(cover, thin, kRailPx, 1.0f);
  int found = 0;
  for (const std::uint32_t seed : kSeeds) found += linesFound(rungs, tracedPage(pencilScan(cover, seed)), 0.9);
  EXPECT_GE(found, 10) << "of 16: grain tears some of them";
}

// A page of a pen: pairs of rails with rungs between them, shorter than three of their widths or hidden among the discs
// of the junctions. @param rungs gets the rungs.
GreyImage penLadder(Lines& rungs, std::uint32_t seed) {
  constexpr double kPenPx = 6.0;
  Lines rails;
  for (const double x : {60.0, 180.0, 300.0}) {
    const double gap = 20.0 + x / 150.0;
    rails.push_back(rail({x, 30}, {x, 330}));
    rails.push_back(rail({x + gap, 30}, {x + gap, 330}));
    for (int k = 0; k < 6; ++k) rungs.push_back(rail({x, 60.0 + 45.0 * k}, {x + gap, 60.0 + 45.0 * k}));
  }
  std::vector<float> cover(static_cast<std::ptrdiff_t>(kLadderWidth) * kLadderHeight, 0.0f);
  ink(cover, rails, kPenPx, 1.0f);
  ink(cover, rungs, kPenPx, 1.0f);
  return test::scanOfLines(std::move(cover), kLadderWidth, kLadderHeight, seed).grey;
}

// Without the rung two meshes would be one.
TEST(ShortStrokes, ARungOfAPenThatPartsTwoMeshesHasALine) {
  for (const std::uint32_t seed : kSeeds) {
    Lines rungs;
    const ContourSet set = tracedPage(penLadder(rungs, seed));
    EXPECT_EQ(linesFound(rungs, set, 0.9), 18) << "seed " << seed;
    EXPECT_EQ(std::ssize(set.contours), 24) << "six rails besides, seed " << seed;
  }
}

// Whoever asks for longer lines gets those alone.
TEST(ShortStrokes, RungsShorterThanTheUserWantsHaveNoLine) {
  ContourParams byWidths, byPx;
  byWidths.minWidths = 6.0;
  byPx.minLengthPx = 40.0;
  for (const ContourParams& params : {byWidths, byPx}) {
    Lines rungs;
    EXPECT_EQ(std::ssize(tracedPage(penLadder(rungs, kSeeds[0]), params).contours), 6);
  }
}

// Two strokes that touch along a stretch have paper at both ends of it, but no line runs across where they do.
TEST(ShortStrokes, WhereTwoStrokesTouchNoRungIsDrawn) {
  Lines bows;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec2> bow;
    for (int x = 60; x <= 420; ++x) bow.push_back({1.0 * x, 180.0 + side * (3.5 + (x - 240.0) * (x - 240.0) / 900.0)});
    bows.push_back(std::move(bow));
  }
  std::vector<float> cover(static_cast<std::ptrdiff_t>(kLadderWidth) * kLadderHeight, 0.0f);
  ink(cover, bows, 6.0, 1.0f);
  for (const std::uint32_t seed : kSeeds)
    EXPECT_EQ(std::ssize(tracedPage(test::scanOfLines(cover, kLadderWidth, kLadderHeight, seed).grey).contours), 2);
}

// A short stroke that stands alone is ink by its threshold, which asks for half the depth of the strokes around.
TEST(ShortStrokes, AWeakStrokeAloneHasALine) {
  Lines rails, ticks;
  for (int k = 0; k < 5; ++k) rails.push_back(rail({40.0, 30.0 + 70.0 * k}, {440.0, 34.0 + 70.0 * k}));
  for (int k = 0; k < 8; ++k)
    ticks.push_back(rail({70.0 + 45.0 * k, 50.0 + 70.0 * (k % 4)}, {72.0 + 45.0 * k, 82.0 + 70.0 * (k % 4)}));
  int found = 0;
  for (const std::uint32_t seed : kSeeds) found += linesFound(ticks, tracedPage(pencilPage(rails, ticks, seed)), 0.6);
  EXPECT_GE(found, 30) << "of 32";
}

}  // namespace
}  // namespace batten
