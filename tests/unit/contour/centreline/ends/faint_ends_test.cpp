// SPDX-License-Identifier: GPL-3.0-or-later
// Pencil strokes with weak ends, and such that end: against lines whose course is known.

#include "core/contour/centreline/ends/faint_ends.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/contour/centreline/junction/find_stroke_paths.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/contour/trace_contours.h"
#include "tests/support/dense_page.h"

namespace batten {
namespace {

constexpr int kWeakWidth = 480, kWeakHeight = 360;
constexpr double kWeakFrom = 220.0, kWeakTo = 430.0;  // [px] between these the lines are weak
constexpr double kWeakPencilPx = 5.0;
constexpr std::uint32_t kWeakSeeds[] = {2, 3, 5, 7};

std::vector<std::vector<Vec2>> weakLines() {
  std::vector<std::vector<Vec2>> lines;
  for (int k = 0; k < 7; ++k) {
    std::vector<Vec2>& line = lines.emplace_back();
    for (int x = 40; x <= static_cast<int>(kWeakTo); ++x) line.emplace_back(x, 40.0 + 45.0 * k + 0.03 * x);
  }
  return lines;
}

// The lines are inked to `weak` of their strength between two columns.
GreyImage pageWeakBetween(double from, double to, float weak, std::uint32_t seed) {
  std::vector<float> cover = test::coverageOf(weakLines(), kWeakPencilPx, kWeakWidth, kWeakHeight);
  for (int y = 0; y < kWeakHeight; ++y) {
    for (int x = 0; x < kWeakWidth; ++x) {
      if (x > from && x < to) cover[y * kWeakWidth + x] *= weak;
    }
  }
  test::grainCoverage(
      cover, kWeakWidth, kWeakHeight, [](double, double) { return 0.6; }, seed);
  return test::scanOfLines(std::move(cover), kWeakWidth, kWeakHeight, seed).grey;
}

GreyImage weakPage(float weak, std::uint32_t seed) { return pageWeakBetween(kWeakFrom, kWeakWidth, weak, seed); }

// Ink is what is darker than one level for all of the page, after a smoothing of 3 x 3.
BitImage inkOf(const GreyImage& grey) {
  constexpr double kLevel = 140.0;
  BitImage ink(grey.width, grey.height);
  for (int y = 1; y + 1 < grey.height; ++y) {
    for (int x = 1; x + 1 < grey.width; ++x) {
      double sum = 0.0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1) * grey.level(x + dx, y + dy);
      ink.set(x, y, sum / 16.0 < kLevel);
    }
  }
  return ink;
}

// Of all strokes of the page. Empty, and the test has failed, where they have no skeleton.
BitImage trailsOn(const GreyImage& grey) {
  const BitImage ink = inkOf(grey);
  BitImage skeleton = ink;
  if (!thinToSkeleton(skeleton, {})) {
    ADD_FAILURE() << "no skeleton";
    return {};
  }
  const auto paths = findStrokePaths(skeleton, ink, {}, {});
  return followFaintEnds(paths, [](int) { return true; }, ink, grey, {});
}

TEST(FaintEnds, AWeakEndIsFollowedWhereItIsSeenAlongItsLength) {
  for (const std::uint32_t seed : kWeakSeeds) {
    const GreyImage grey = weakPage(0.45f, seed);
    const auto set = traceContours(inkOf(grey), grey, {}, {}, {});
    ASSERT_TRUE(set);
    double reached = 0.0;
    int astray = 0;
    for (const auto& line : weakLines()) {
      double farthest = kWeakFrom;
      for (const Contour& c : set->contours) {
        for (const ContourPoint& p : c.points) {
          const double off = std::abs(p.at.y() - line.front().y() - 0.03 * (p.at.x() - line.front().x()));
          if (off < 3.0) farthest = std::max(farthest, p.at.x());
          astray += off >= 4.0 && off < 20.0 ? 1 : 0;
        }
      }
      reached += (farthest - kWeakFrom) / (kWeakTo - kWeakFrom) / 7.0;
    }
    EXPECT_GT(reached, 0.35) << "seed " << seed;
    EXPECT_EQ(astray, 0) << "seed " << seed;
  }
}

// Shares of the weak stretch, 0..1, along which some line runs within 3 px, in the mean of the lines.
double shareFound(const ContourSet& set, double from, double to) {
  double found = 0.0;
  for (const auto& line : weakLines()) {
    for (double x = from; x < to; x += 1.0) {
      const double y = line.front().y() + 0.03 * (x - line.front().x());
      const bool isFound = std::any_of(set.contours.begin(), set.contours.end(), [&](const Contour& c) {
        return std::any_of(c.points.begin(), c.points.end(),
                           [&](const ContourPoint& p) { return (p.at - Vec2(x, y)).norm() < 3.0; });
      });
      found += isFound ? 1.0 / ((to - from) * 7.0) : 0.0;
    }
  }
  return found;
}

// A line that the hand hardly pressed for a part of its course, where the threshold sees nothing, is found all along.
TEST(FaintEnds, AWeakPartBetweenTwoStrongOnesIsFollowedThrough) {
  constexpr double kFrom = 180.0, kTo = 260.0;
  constexpr float kWeak = 0.2f;
  for (const std::uint32_t seed : kWeakSeeds) {
    const GreyImage grey = pageWeakBetween(kFrom, kTo, kWeak, seed);
    const auto set = traceContours(inkOf(grey), grey, {}, {}, {});
    ASSERT_TRUE(set);
    EXPECT_GT(shareFound(*set, kFrom, kTo), 0.9) << "seed " << seed;
  }
}

// Dashes of one line with clean paper between them are not joined by following.
TEST(FaintEnds, DashesStayApart) {
  constexpr double kGapsPx[] = {8.0, 10.0, 14.0};
  for (const double gap : kGapsPx) {
    for (const std::uint32_t seed : kWeakSeeds) {
      const double from = 220.0, to = from + kWeakPencilPx + gap;  // the ends of the strokes are round
      const GreyImage grey = pageWeakBetween(from, to, 0.0f, seed);
      const BitImage trails = trailsOn(grey);
      int joined = 0;
      const int middle = static_cast<int>(0.5 * (from + to));
      for (int y = 0; y < kWeakHeight; ++y) joined += trails.at(middle, y) ? 1 : 0;
      EXPECT_EQ(joined, 0) << "gap " << gap << ", seed " << seed;
    }
  }
}

TEST(FaintEnds, NothingIsFollowedOnPaper) {
  for (const std::uint32_t seed : kWeakSeeds) {
    const GreyImage grey = weakPage(0.0f, seed);
    const BitImage trails = trailsOn(grey);
    int onPaper = 0;
    for (int y = 0; y < kWeakHeight; ++y) {
      for (int x = static_cast<int>(kWeakFrom) + 8; x < kWeakWidth; ++x) onPaper += trails.at(x, y) ? 1 : 0;
    }
    EXPECT_EQ(onPaper, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace batten
