// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/imported_lines.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

constexpr PageFrame kFrame{2000, 2000, 0.1};

std::ptrdiff_t pointsOf(const ContourSet& set) {
  std::ptrdiff_t count = 0;
  for (const Contour& contour : set.contours) count += std::ssize(contour.points);
  return count;
}

/// Straight lines of 100 m, beside one another: 1 000 000 px each.
ImportedFile longLines(int count, bool asCurves) {
  ImportedFile file{"long.dxf", "mm", {}};
  for (int i = 0; i < count; ++i) {
    const std::vector<Vec2> ends{Vec2(-5e4, i), Vec2(5e4, i)};
    ImportedLine line;
    if (asCurves) {
      line.curves = {{NurbsCurve::make(1, {0, 0, 1, 1}, ends).value()}};
    } else {
      line.points = ends;
    }
    file.lines.push_back(line);
  }
  return file;
}

TEST(ImportedLines, HaveOnePointAPixel) {
  ImportedFile file{"one.dxf", "mm", {}};
  ImportedLine line;
  line.points = {Vec2(0, 0), Vec2(30, 40)};  // 500 px
  file.lines.push_back(line);
  const ContourSet set = withImports({}, std::vector{file}, kFrame, {});
  ASSERT_EQ(set.contours.size(), 1u);
  EXPECT_EQ(set.contours[0].points.size(), 501u);
  EXPECT_EQ(importStepPx(std::vector{file}, kFrame), 1.0);
}

// A file of a few kilobytes must not take gigabytes.
TEST(ImportedLines, OfADrawingHaveALimitTogether) {
  for (const bool asCurves : {false, true}) {
    constexpr int kLines = 30;
    const std::vector files{longLines(kLines, asCurves)};
    const ContourSet set = withImports({}, files, kFrame, {});
    ASSERT_EQ(std::ssize(set.contours), kLines) << asCurves;
    EXPECT_LE(pointsOf(set), 1'000'000 + 2 * kLines) << asCurves;
    EXPECT_GE(std::ssize(set.contours[0].points), 4000) << asCurves;
    std::size_t reserved = 0;
    for (const Contour& contour : set.contours) reserved += contour.points.capacity();
    EXPECT_LE(reserved, 2'100'000u) << "memory that no point uses";
    EXPECT_NEAR(importStepPx(files, kFrame), kLines, 1e-9);
  }
}

}  // namespace
}  // namespace batten
