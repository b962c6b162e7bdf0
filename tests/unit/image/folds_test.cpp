// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "core/image/threshold/binarize.h"
#include "tests/support/angles.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

using test::kDeg;
using test::PaperOf;
using test::renderStress;
using test::stepAcross;
using test::StressInk;

constexpr int kFoldWidth = 640, kFoldHeight = 480;

/// A ring of 6 px pen width and a filled disc.
double inkDistance(double x, double y) {
  const double ring = std::fabs(std::hypot(x - 250.0, y - 240.0) - 150.0) - 3.0;
  return std::min(ring, std::hypot(x - 520.0, y - 190.0) - 60.0);
}

std::vector<float> coverageOf(double (*distance)(double, double)) {
  std::vector<float> coverage;
  for (int y = 0; y < kFoldHeight; ++y) {
    for (int x = 0; x < kFoldWidth; ++x)
      coverage.push_back(static_cast<float>(std::clamp(0.5 - distance(x + 0.5, y + 0.5), 0.0, 1.0)));
  }
  return coverage;
}

struct Traced {
  RegionThresholds thresholds;
  BitImage ink;
};

Traced traceOn(const GreyImage& grey, const PaperParams& paper = {}, int threads = 0) {
  RunContext context;
  context.threads = threads;
  Traced out;
  out.thresholds = *findThresholds(grey, paper, {}, context);
  out.ink = *binarize(grey, out.thresholds, {}, context);
  return out;
}

/// Ink that is wrong more than 1.5 px from the border of the drawing.
int wrongInk(const BitImage& ink, double (*distance)(double, double)) {
  int wrong = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      const double d = distance(x + 0.5, y + 0.5);
      wrong += std::fabs(d) > 1.5 && ink.at(x, y) != (d < 0.0) ? 1 : 0;
    }
  }
  return wrong;
}

struct FoldCase {
  const char* name;
  PaperOf paper;
  std::size_t folds;
};

std::vector<FoldCase> foldCases() {
  const auto step = [](double deg, double soft) {
    return [=](double x, double y) { return 220.0 - 0.04 * x - 59.0 * stepAcross(x, y, 330.0, 230.0, deg, soft); };
  };
  return {
      {"steep", step(8.0, 0.9), 1},
      {"upright", step(0.0, 0.9), 1},
      {"level", step(-90.0, 1.2), 1},
      {"slanting", step(145.0, 0.9), 1},
      {"shadow", step(60.0, 4.0), 1},
      {"with a crease",
       [](double x, double y) {
         const double d = y - 232.0 + 0.05 * x;
         return 220.0 - 30.0 * stepAcross(x, y, 0.0, 232.0, std::atan2(1.0, 0.05) / kDeg, 1.0) -
                40.0 * std::exp(-0.5 * d * d / 3.0);
       },
       1},
      {"crossing",
       [](double x, double y) {
         return 220.0 - 45.0 * stepAcross(x, y, 330.0, 240.0, 2.0, 0.9) -
                28.0 * stepAcross(x, y, 320.0, 250.0, 93.0, 0.9);
       },
       2},
  };
}

TEST(Folds, AStepAcrossThePageIsTakenOutAndTheDrawingOnItFound) {
  for (const FoldCase& c : foldCases()) {
    const Scan scan =
        renderStress(coverageOf(inkDistance), kFoldWidth, kFoldHeight, c.paper, StressInk{20.0, 2.0, 0.8}, 5);
    const Traced traced = traceOn(scan.grey);
    EXPECT_EQ(traced.thresholds.paper.folds.size(), c.folds) << c.name;
    EXPECT_FALSE(traced.thresholds.note.empty()) << c.name;
    EXPECT_LE(wrongInk(traced.ink, inkDistance), 12) << c.name;
    // The paper that was found is the paper that was painted.
    double sum = 0.0;
    int count = 0;
    for (int y = 4; y < kFoldHeight; y += 5) {
      for (int x = 4; x < kFoldWidth; x += 5, ++count)
        sum += std::pow(traced.thresholds.paper.at(x + 0.5, y + 0.5) - c.paper(x + 0.5, y + 0.5), 2);
    }
    EXPECT_LT(std::sqrt(sum / count), 1.5) << c.name;
  }
}

TEST(Folds, SwitchedOffTheStepIsInk) {
  const FoldCase fold = foldCases().front();
  const Scan scan = renderStress(coverageOf(inkDistance), kFoldWidth, kFoldHeight, fold.paper, {20.0, 2.0, 0.8}, 5);
  const Traced traced = traceOn(scan.grey, {.flatten = true, .folds = false});
  EXPECT_TRUE(traced.thresholds.paper.folds.empty());
  EXPECT_GT(wrongInk(traced.ink, inkDistance), 1000);
}

TEST(Folds, AreTheSameWithAnyNumberOfThreads) {
  const FoldCase fold = foldCases().back();
  const Scan scan = renderStress(coverageOf(inkDistance), kFoldWidth, kFoldHeight, fold.paper, {20.0, 3.0, 0.8}, 9);
  const Traced one = traceOn(scan.grey, {}, 1), four = traceOn(scan.grey, {}, 4);
  EXPECT_EQ(one.ink.words, four.ink.words);
  EXPECT_EQ(one.thresholds.paper.grey, four.thresholds.paper.grey);
}

double ruledLine(double x, double y) { return std::fabs(y - 200.0 - 0.1 * x) - 2.5; }
double broadBar(double x, double y) { return std::fabs(y - 200.0 - 0.1 * x) - 25.0; }
double cornerOfShape(double x, double y) { return std::max(300.0 - x, y - 200.0 - 0.1 * x); }
double blackHalf(double x, double y) { return 300.0 - x - 0.1 * y; }

TEST(Folds, NothingThatIsDrawnIsTakenForOne) {
  const PaperOf paper = [](double x, double) { return 225.0 - 0.08 * x; };
  struct Drawn {
    const char* name;
    double (*distance)(double, double);
    double contrast;
  };
  for (const Drawn& d : {Drawn{"line from border to border", ruledLine, 60.0}, Drawn{"line, dark", ruledLine, 160.0},
                         Drawn{"bar", broadBar, 60.0}, Drawn{"shape running off the page", cornerOfShape, 60.0},
                         Drawn{"black half of the page", blackHalf, 180.0}}) {
    const Scan scan = renderStress(coverageOf(d.distance), kFoldWidth, kFoldHeight, paper, {d.contrast, 3.0, 0.8}, 3);
    const Traced traced = traceOn(scan.grey);
    EXPECT_TRUE(traced.thresholds.paper.folds.empty()) << d.name;
    EXPECT_LE(wrongInk(traced.ink, d.distance), 12) << d.name;
  }
}

TEST(Folds, RegularHatchingIsNone) {
  const PaperOf paper = [](double, double) { return 235.0; };
  for (const double deg : {0.0, 30.0, 45.0, 90.0}) {
    for (const double spacing : {4.25, 5.0, 7.0, 10.0, 16.0, 25.0}) {
      for (const double share : {0.25, 0.5, 0.75}) {
        std::vector<float> coverage;
        for (int y = 0; y < kFoldHeight; ++y) {
          for (int x = 0; x < kFoldWidth; ++x) {
            const double across = x * std::cos(deg * kDeg) + y * std::sin(deg * kDeg);
            const double off = std::fabs(std::remainder(across, spacing));
            coverage.push_back(static_cast<float>(std::clamp(0.5 * share * spacing - off + 0.5, 0.0, 1.0)));
          }
        }
        const Scan scan = renderStress(coverage, kFoldWidth, kFoldHeight, paper, {215.0, 0.0, 0.4}, 3);
        const auto thresholds = findThresholds(scan.grey, {}, {}, {});
        EXPECT_TRUE(thresholds->paper.folds.empty())
            << deg << " degrees, every " << spacing << " px, " << share << " of it ink";
      }
    }
  }
}

/// Lines of anti-aliased pixels that repeat exactly, as a program draws them.
TEST(Folds, DrawnByAProgramHatchingIsNoneEither) {
  const auto foldsOf = [](const std::vector<int>& greys, int shiftPerRow) {
    const int period = static_cast<int>(std::ssize(greys));
    GreyImage page(600, 400);
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x)
        page.row(y)[x] = static_cast<std::uint16_t>(greys[(x + shiftPerRow * y) % period] * 257);
    }
    return findThresholds(page, {}, {}, {})->paper.folds.size();
  };
  EXPECT_EQ(foldsOf({235, 173, 20, 166, 235, 235}, 5), 0u) << "fine, at 45 degrees";
  std::vector<int> upright(30, 235);
  for (const auto& [column, grey] : {std::pair(17, 190), {18, 20}, {19, 20}, {20, 20}, {21, 20}, {22, 20}, {23, 186}})
    upright[column] = grey;
  EXPECT_EQ(foldsOf(upright, 0), 0u) << "coarse, upright";
}

/// The walls of a maze without loops at the left of a page, one cell of the plan a square of 6 px.
GreyImage mazePage(unsigned seed) {
  constexpr int kCells = 32, kSide = 2 * kCells + 1, kSquarePx = 6;
  std::vector<char> open(kSide * kSide, 0);
  std::mt19937 random(seed);
  std::vector<std::pair<int, int>> way{{1, 1}};
  open[kSide + 1] = 1;
  while (!way.empty()) {
    const auto [x, y] = way.back();
    std::vector<std::pair<int, int>> next;
    for (const auto& [dx, dy] : {std::pair(2, 0), {-2, 0}, {0, 2}, {0, -2}}) {
      const int u = x + dx, v = y + dy;
      if (u > 0 && v > 0 && u < kSide && v < kSide && open[v * kSide + u] == 0) next.emplace_back(dx, dy);
    }
    if (next.empty()) {
      way.pop_back();
      continue;
    }
    const auto [dx, dy] = next[random() % next.size()];
    open[(y + dy / 2) * kSide + x + dx / 2] = open[(y + dy) * kSide + x + dx] = 1;
    way.emplace_back(x + dx, y + dy);
  }
  GreyImage page(600, 400, 235 * 257);
  for (int y = 0; y < kSide * kSquarePx; ++y)
    for (int x = 0; x < kSide * kSquarePx; ++x)
      if (open[y / kSquarePx * kSide + x / kSquarePx] == 0) page.row(y)[x] = 20 * 257;
  return page;
}

TEST(Folds, AWallRightAcrossThePageIsInk) {
  for (const unsigned seed : {0u, 1u, 8u, 11u}) {
    const GreyImage page = mazePage(seed);
    const Traced traced = traceOn(page);
    ASSERT_TRUE(traced.thresholds.foundLine) << seed << ": " << traced.thresholds.note;
    int wrong = 0, dark = 0;
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) {
        dark += page.row(y)[x] < 32768 ? 1 : 0;
        wrong += traced.ink.at(x, y) != (page.row(y)[x] < 32768) ? 1 : 0;
      }
    }
    EXPECT_LT(wrong, dark / 20) << seed << ": but for rounded corners";
  }
}

// The page beside a gutter darkens towards it and steps to the next page there. Farther on it is as bright as that.
TEST(Folds, TheGutterOfABookIsNone) {
  const auto gutter = [](double x, double y) {
    const double beyond = x - 520.0 - 0.2 * (y - 240.0);
    return beyond > 0.0 ? 225.0 : 225.0 - 105.0 * std::exp(beyond / 30.0);
  };
  const auto onThePage = [](double x, double y) { return std::fabs(std::hypot(x - 220.0, y - 240.0) - 150.0) - 1.5; };
  const Scan scan = renderStress(coverageOf(onThePage), kFoldWidth, kFoldHeight, gutter, {60.0, 2.0, 0.8}, 5);
  const Traced traced = traceOn(scan.grey);
  EXPECT_TRUE(traced.thresholds.paper.folds.empty());
  int seen = 0, ink = 0;
  for (int y = 0; y < kFoldHeight; ++y) {
    for (int x = 0; x < 400; ++x) {
      if (onThePage(x + 0.5, y + 0.5) > -0.75) continue;
      ++ink;
      seen += traced.ink.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 99 * ink / 100);
}

TEST(Folds, RowsAndPlacesAgree) {
  PaperFold fold;
  fold.reach = 6;
  fold.stations = 40;
  for (const double deg : {0.0, 3.0, 45.0, 90.0, 100.0, 180.0, 260.0, -30.0}) {
    fold.course = {};
    fold.course.normal = Vec2(std::cos(deg * kDeg), std::sin(deg * kDeg));
    fold.course.along = Vec2(-fold.course.normal.y(), fold.course.normal.x());
    fold.course.origin = Vec2(100.0, 80.0);
    fold.course.from = -250.0;
    fold.course.to = 250.0;
    fold.course.bend = {1.0, -2.0, 3.0, 0.5};
    fold.depth.clear();
    fold.profile.clear();
    for (int k = 0; k < fold.stations; ++k) {
      fold.depth.push_back(20.0f + static_cast<float>(k));
      for (int i = 0; i < fold.taps(); ++i)
        fold.profile.push_back(-fold.depth.back() *
                               (1.0f - static_cast<float>(i) / static_cast<float>(fold.taps() - 1)));
    }
    std::vector<float> row(200);
    double worst = 0.0;
    for (int y = 0; y < 160; ++y) {
      std::fill(row.begin(), row.end(), 0.0f);
      fold.addToRow(y, row.data(), 200);
      for (int x = 0; x < 200; ++x)
        worst = std::max(worst, std::fabs(static_cast<double>(row[x]) - fold.at(x + 0.5, y + 0.5)));
    }
    EXPECT_LT(worst, 1e-4) << deg;
  }
}

}  // namespace
}  // namespace batten
