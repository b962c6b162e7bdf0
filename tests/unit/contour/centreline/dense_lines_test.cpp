// SPDX-License-Identifier: GPL-3.0-or-later
// Lines side by side, pen and pencil on one page: against lines whose course is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "core/contour/centreline/centreline.h"
#include "core/contour/centreline/junction/find_stroke_paths.h"
#include "core/contour/centreline/pencil/grain_closing.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/contour/centreline/pencil/oriented_line_filter.h"
#include "core/contour/centreline/pencil/step_folds.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "tests/support/dense_page.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

constexpr int kDenseWidth = 480, kDenseHeight = 360;
using DenseLines = std::vector<std::vector<Vec2>>;

struct DensePage {
  BitImage ink;
  GreyImage grey;
};

// Ink is what is darker than `level` after a smoothing of 3 x 3.
DensePage densePage(std::vector<float> cover, double level, std::uint32_t seed) {
  DensePage page{BitImage(kDenseWidth, kDenseHeight),
                 test::scanOfLines(std::move(cover), kDenseWidth, kDenseHeight, seed).grey};
  for (int y = 1; y + 1 < kDenseHeight; ++y) {
    for (int x = 1; x + 1 < kDenseWidth; ++x) {
      double sum = 0.0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1) * page.grey.level(x + dx, y + dy);
      page.ink.set(x, y, sum / 16.0 < level);
    }
  }
  return page;
}

DenseLines foundOn(const DensePage& page) {
  DenseLines lines;
  const auto set = centrelines(page.ink, page.grey, {}, {});
  EXPECT_TRUE(set);
  if (!set) return lines;
  for (const Contour& c : set->contours) lines.push_back(positionsOf(c.points));
  return lines;
}

std::vector<StrokePath> rawStrokePaths(const DensePage& page) {
  BitImage skeleton = page.ink;
  EXPECT_TRUE(thinToSkeleton(skeleton, {}));
  return findStrokePaths(skeleton, page.ink, {}, {});
}

double everywhere(double, double) { return 1.0; }

TEST(DenseLines, PenHatchingIsNoPencil) {
  for (const double spacing : {2.0, 3.0}) {
    const DenseLines lines = test::hatchLines({240, 180}, 17.0, 10, spacing * 3.0, 240.0, 400.0);
    const DensePage page = densePage(test::coverageOf(lines, 3.0, kDenseWidth, kDenseHeight), 135.0, 3);
    const test::DenseScore score = test::scoreDense(lines, foundOn(page), 1.5 * spacing, 6.0);
    EXPECT_EQ(score.whole, 10) << spacing;
    EXPECT_EQ(score.bridges, 0) << spacing;
    EXPECT_LE(score.rmsPx, 0.1) << spacing;
  }
}

TEST(DenseLines, PencilHatchingStaysApart) {
  const DenseLines lines = test::hatchLines({240, 180}, 17.0, 10, 7.5, 240.0, 0.0);
  std::vector<float> cover = test::coverageOf(lines, 3.0, kDenseWidth, kDenseHeight);
  test::grainCoverage(cover, kDenseWidth, kDenseHeight, everywhere, 5);
  const test::DenseScore score = test::scoreDense(lines, foundOn(densePage(std::move(cover), 165.0, 5)), 3.75, 6.0);
  EXPECT_EQ(score.whole + score.inPieces, 10);
  EXPECT_LE(score.bridges, 1);
  EXPECT_LE(score.rmsPx, 0.3);
}

TEST(DenseLines, PenAndPencilOnOnePageAreToldApart) {
  const DenseLines left = test::hatchLines({120, 180}, 5.0, 8, 30.0, 200.0, 0.0);
  const DenseLines right = test::hatchLines({360, 180}, 5.0, 8, 30.0, 200.0, 0.0);
  DenseLines all = left;
  all.insert(all.end(), right.begin(), right.end());
  std::vector<float> cover = test::coverageOf(all, 4.0, kDenseWidth, kDenseHeight);
  test::grainCoverage(
      cover, kDenseWidth, kDenseHeight, [](double x, double) { return x > 240.0 ? 1.0 : 0.0; }, 2);
  const DensePage page = densePage(std::move(cover), 150.0, 2);
  const std::vector<StrokePath> paths = rawStrokePaths(page);
  const GraininessMap grain(paths, page.grey, {});
  int pens = 0, pencils = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const double x = paths[i].points[paths[i].points.size() / 2].at.x();
    if (paths[i].length() < 20.0) continue;
    EXPECT_EQ(grain.isPencil(i), x > 240.0) << "near " << x << ": " << grain.grainOf(i);
    ++(x > 240.0 ? pencils : pens);
  }
  EXPECT_GE(pens, 8);
  EXPECT_GE(pencils, 8);
  EXPECT_NEAR(grain.depthAt({60, 180}), 205.0, 30.0);
  const DenseLines found = foundOn(page);
  EXPECT_EQ(test::scoreDense(left, found, 4.0, 8.0).whole, 8);
  EXPECT_GE(test::scoreDense(right, found, 4.0, 8.0).whole, 7);
}

// A faint pencil all over the page, two long lines of a pen, and marks of the pen that are too short to show grain.
TEST(DenseLines, ShortMarksAsDarkAsAPenBesideAPencilAreThePens) {
  constexpr float kFaint = 0.45f;
  constexpr double kInkBelow = 205.0, kMarkPx = 16.0, kMarksAt = 125.0;
  const DenseLines pencil = test::hatchLines({240, 110}, 0.0, 5, 30.0, 420.0, 0.0);
  DenseLines pens = test::hatchLines({240, 320}, 0.0, 2, 40.0, 420.0, 0.0);
  const DenseLines marks = test::hatchLines({240, kMarksAt}, 90.0, 12, 30.0, kMarkPx, 0.0);
  pens.insert(pens.end(), marks.begin(), marks.end());
  std::vector<float> cover = test::coverageOf(pencil, 6.0, kDenseWidth, kDenseHeight);
  test::grainCoverage(cover, kDenseWidth, kDenseHeight, everywhere, 3);
  const std::vector<float> dark = test::coverageOf(pens, 5.0, kDenseWidth, kDenseHeight);
  for (std::size_t i = 0; i < cover.size(); ++i) cover[i] = std::max(kFaint * cover[i], dark[i]);
  const DensePage page = densePage(std::move(cover), kInkBelow, 3);
  const std::vector<StrokePath> paths = rawStrokePaths(page);
  const GraininessMap grain(paths, page.grey, {});
  int shortOnes = 0, pencils = 0;
  for (int i = 0; i < std::ssize(paths); ++i) {
    const Vec2 at = paths[i].points[paths[i].points.size() / 2].at;
    const bool isMark = std::fabs(at.y() - kMarksAt) < 3.0 && paths[i].length() < 2.0 * kMarkPx;
    const bool isPencil = at.y() < 200.0 && paths[i].length() > 4.0 * kMarkPx;
    if (!isMark && !isPencil) continue;
    EXPECT_EQ(grain.isPencil(i), isPencil) << "near " << at.transpose() << ": " << grain.grainOf(i);
    ++(isPencil ? pencils : shortOnes);
  }
  EXPECT_GE(shortOnes, 8);
  EXPECT_GE(pencils, 5);
  // What tells lines of the pencil from its grain is measured on the pencil alone.
  EXPECT_LT(grain.depthAt({240, kMarksAt}), 110.0);
}

TEST(DenseLines, ALineFromPenToPencilIsNotCut) {
  const DenseLines lines = test::hatchLines({240, 180}, 5.0, 8, 30.0, 420.0, 0.0);
  std::vector<float> cover = test::coverageOf(lines, 4.0, kDenseWidth, kDenseHeight);
  test::grainCoverage(
      cover, kDenseWidth, kDenseHeight, [](double x, double) { return x > 240.0 ? 1.0 : 0.0; }, 2);
  const test::DenseScore score = test::scoreDense(lines, foundOn(densePage(std::move(cover), 150.0, 2)), 4.0, 8.0);
  EXPECT_GE(score.whole, 7);
  EXPECT_EQ(score.bridges, 0);
}

// A stroke as broad as several others side by side is one line all the same: its grain is no paper between lines.
TEST(DenseLines, ABroadPencilStrokeAmongNarrowOnesHasOneLineInItsMiddle) {
  constexpr double kNarrowPx = 7.0, kBroadPx = 26.0;
  for (const std::uint32_t seed : {2u, 3u, 5u, 7u}) {
    const DenseLines above = test::hatchLines({240, 60}, 3.0, 3, 30.0, 400.0, 0.0);
    const DenseLines below = test::hatchLines({240, 300}, 3.0, 3, 30.0, 400.0, 0.0);
    const DenseLines broad = test::hatchLines({240, 180}, 3.0, 1, 1.0, 300.0, 500.0);
    DenseLines narrow = above;
    narrow.insert(narrow.end(), below.begin(), below.end());
    std::vector<float> cover = test::coverageOf(narrow, kNarrowPx, kDenseWidth, kDenseHeight);
    test::inkOver(cover, test::coverageOf(broad, kBroadPx, kDenseWidth, kDenseHeight));
    test::grainCoverage(cover, kDenseWidth, kDenseHeight, everywhere, seed);
    const DenseLines found = foundOn(densePage(std::move(cover), 165.0, seed));
    const test::DenseScore score = test::scoreDense(broad, found, 0.2 * kBroadPx, 0.1 * 300.0);
    EXPECT_EQ(score.whole, 1) << "seed " << seed;
    EXPECT_GE(test::scoreDense(narrow, found, 4.0, 12.0).whole, 5) << "seed " << seed;
  }
}

TEST(OrientedLines, GapsLieBetweenLinesAndNotWithinOne) {
  for (const bool pencil : {false, true}) {
    const DenseLines two = test::hatchLines({240, 180}, 30.0, 2, 9.0, 240.0, 0.0);
    std::vector<float> cover = test::coverageOf(two, 5.0, kDenseWidth, kDenseHeight);
    if (pencil) test::grainCoverage(cover, kDenseWidth, kDenseHeight, everywhere, 7);
    const DensePage page = densePage(std::move(cover), 150.0, 7);
    const GraininessMap grain(rawStrokePaths(page), page.grey, {});
    const OrientedLines comb = filterOrientedLines(closeInk(page.ink, 6.0, {}), page.grey, grain, 5.0, {});
    const Vec2 across(-std::sin(30.0 * std::numbers::pi / 180.0), std::cos(30.0 * std::numbers::pi / 180.0));
    int inGap = 0;
    for (int y = 0; y < kDenseHeight; ++y) {
      for (int x = 0; x < kDenseWidth; ++x) {
        if (!comb.gaps.at(x, y)) continue;
        EXPECT_LE(std::abs((Vec2(x + 0.5, y + 0.5) - Vec2(240, 180)).dot(across)), 3.5) << x << " " << y;
        ++inGap;
      }
    }
    // Four px by 240, less the ends.
    EXPECT_GE(inGap, 400) << pencil;
  }
  for (const double width : {3.0, 5.0, 10.0}) {
    const DenseLines one = test::hatchLines({240, 180}, 30.0, 1, 1.0, 300.0, 300.0);
    std::vector<float> cover = test::coverageOf(one, width, kDenseWidth, kDenseHeight);
    test::grainCoverage(cover, kDenseWidth, kDenseHeight, everywhere, 7);
    const DensePage page = densePage(std::move(cover), 150.0, 7);
    const GraininessMap grain(rawStrokePaths(page), page.grey, {});
    EXPECT_EQ(filterOrientedLines(closeInk(page.ink, 0.75 * width + 1.0, {}), page.grey, grain, width, {}).gaps.count(),
              0)
        << width;
  }
}

TEST(StepFolds, AreThoseOfOnePixelAfterTheOtherToTheLastBit) {
  constexpr int kSide = 160;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> level(0.0f, 255.0f);
  std::vector<float> grey(kSide * kSide);
  for (float& value : grey) value = level(random);
  for (const int count : {1, 7, 8, 31, 64, 88, 119}) {
    std::vector<int> steps;
    for (int k = 1; k <= 12; ++k) steps.push_back((k % 3 - 1) * k / 2 * kSide + k);
    const float* from = grey.data() + kSide * kSide / 2;
    for (const StepFolds& folds : {plainStepFolds(), stepFolds()}) {
      std::vector<float> sums(count), least(count), most(count);
      folds.sum(from, steps.data(), 12, count, sums.data());
      folds.least(from, steps.data(), 12, count, least.data());
      folds.most(from, steps.data(), 12, count, most.data());
      for (int i = 0; i < count; ++i) {
        std::vector<float> values;
        for (const int step : steps) values.push_back(from[i + step]);
        ASSERT_EQ(sums[i], std::accumulate(values.begin(), values.end(), 0.0f)) << count << " " << i;
        ASSERT_EQ(least[i], *std::ranges::min_element(values)) << count << " " << i;
        ASSERT_EQ(most[i], *std::ranges::max_element(values)) << count << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace batten
