// SPDX-License-Identifier: GPL-3.0-or-later
// White paper on a white table: its edges are told by a step of a few grey all along them, and by nothing else.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/image/scan.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten {
namespace {

constexpr int kWidth = 820, kHeight = 640;
constexpr double kTableStep = 5.0;  // [grey] less than cells of one sheet may differ by

Scan photoOf(const std::function<double(double, double)>& greyAt) {
  Scan scan;
  scan.grey = GreyImage(kWidth, kHeight);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double level = std::clamp(greyAt(x + 0.5, y + 0.5) + noise(random), 0.0, 255.0);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(level * 257.0));
    }
  }
  return scan;
}

std::optional<PaperSheet> sheetOnPhoto(const Scan& scan) { return findPaperSheet(scan.grey, scan.colour, {}); }

// Into the sheet, whose sides run near those of the picture and lean by one and a half degrees. [px]
double depthIn(double x, double y) {
  constexpr double kLean = 0.026;
  return std::min({x - 50.0 - kLean * y, 770.0 - kLean * y - x, y - 44.0 + kLean * x, 600.0 + kLean * x - y});
}
double shading(double x, double y) { return 228.0 - 18.0 * x / kWidth + 9.0 * y / kHeight; }
bool isDrawing(double x, double y) { return std::fabs(std::hypot(x - 410.0, y - 320.0) - 150.0) < 2.0; }

TEST(SheetEdges, AFaintStepAllAlongIsTheEdgeOfASheet) {
  const auto sheet = sheetOnPhoto(photoOf([](double x, double y) {
    const double depth = depthIn(x, y);
    const double edge = std::fabs(depth) < 1.0 ? 12.0 : 0.0;  // the shadow in the crack
    return (isDrawing(x, y) ? 60.0 : shading(x, y)) + (depth < 0.0 ? kTableStep : 0.0) - edge;
  }));
  ASSERT_TRUE(sheet);
  int wrong = 0, cells = 0;
  for (int j = 0; j < sheet->inside.height; ++j) {
    for (int i = 0; i < sheet->inside.width; ++i) {
      const double depth = depthIn((i + 0.5) * sheet->cellPx, (j + 0.5) * sheet->cellPx);
      if (depth > -2.0 && depth < 18.0) continue;  // the rim
      ++cells;
      wrong += sheet->inside.at(i, j) != (depth > 0.0) ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, 0.01 * cells);
}

TEST(SheetEdges, DrawnLinesAndSolidsNearTheSidesAreNone) {
  const auto frame = [](double x, double y) {
    const double depth = std::min({x - 45.0, kWidth - 45.0 - x, y - 45.0, kHeight - 45.0 - y});
    return std::fabs(depth) < 1.5 ? 80.0 : shading(x, y);
  };
  EXPECT_FALSE(sheetOnPhoto(photoOf(frame)));
  const auto ruled = [](double x, double y) { return std::fmod(y, 24.0) < 2.0 ? 190.0 : shading(x, y); };
  EXPECT_FALSE(sheetOnPhoto(photoOf(ruled)));
  const auto tail = [](double x, double y) {
    const bool isTail = std::fabs(x - 70.0) < 25.0 && y > 160.0 && y < 540.0;
    return isTail || std::hypot(x - 440.0, y - 320.0) < 160.0 ? 40.0 : shading(x, y);
  };
  EXPECT_FALSE(sheetOnPhoto(photoOf(tail)));
}

// Paper that is clearly brighter than what its edge encloses lies round a drawn solid, however faint and large that is.
TEST(SheetEdges, FaintSolidsWithStraightSidesAreNone) {
  constexpr double kFaintInk = 20.0;  // [grey]
  const auto solid = [](double x, double y) {
    const bool isInk = x > 80.0 && x < 740.0 && y < 585.0 && y > 360.0 - 150.0 * std::sin(x / 130.0);
    return shading(x, y) - (isInk ? kFaintInk : 0.0);
  };
  EXPECT_FALSE(sheetOnPhoto(photoOf(solid)));
}

TEST(SheetEdges, ShadingIsNone) {
  EXPECT_FALSE(sheetOnPhoto(photoOf([](double x, double y) { return shading(x, y) + 25.0 * x / kWidth; })));
  const auto vignette = [](double x, double y) {
    const double r = std::hypot(x - 410.0, y - 320.0) / 520.0;
    return 235.0 - 60.0 * r * r * r * r;
  };
  EXPECT_FALSE(sheetOnPhoto(photoOf(vignette)));
}

TEST(SheetEdges, WhatIsDrawnOnBothSidesIsOneSheet) {
  // A stripe of a marker along the side, with the drawing going on upon it.
  const auto stripe = [](double x, double y) {
    const bool isLine = std::fabs(std::fmod(x + 0.3 * y, 60.0) - 30.0) < 1.5;
    return isLine ? 70.0 : shading(x, y) - (y < 70.0 ? kTableStep : 0.0);
  };
  EXPECT_FALSE(sheetOnPhoto(photoOf(stripe)));
}

}  // namespace
}  // namespace batten
