// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/image/sheet/paint_over.h"
#include "core/image/sheet/paper_sheet.h"
#include "tests/unit/image/photographed_sheet.h"

namespace batten {
namespace {

using test::kPhotoHeight;
using test::kPhotoWidth;
using test::photo;
using test::PhotoPixel;
using test::sheetOf;

/// An open book on a dark table, seen from above: two pages that dim towards the gutter between them.
PhotoPixel openBook(double x, double y, bool isDrawnOnRight) {
  const double fromGutter = std::fabs(x - 400.0), halfWidth = x < 400.0 ? 350.0 : 330.0;
  if (y < 50.0 || y > 590.0 || fromGutter > halfWidth) return {70.0, 2.0};
  if (fromGutter < 4.0) return {60.0, 1.5};
  const double paper = (x < 400.0 ? 225.0 : 215.0) - 90.0 * std::exp(-fromGutter / 4.0);
  const bool isRing = std::fabs(std::hypot(fromGutter - 150.0, y - 320.0) - 80.0) < 2.5;
  return {isRing && (x < 400.0 || isDrawnOnRight) ? 50.0 : paper, 1.5};
}

int darkPixels(const GreyImage& page, int x0, int x1) {
  int dark = 0;
  for (int y = 0; y < page.height; ++y) {
    for (int x = x0; x < x1; ++x) dark += page.level(x, y) < 150.0 ? 1 : 0;
  }
  return dark;
}

void expectBothPages(const Scan& scan) {
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  const GreyImage page = onlyTheSheet(scan.grey, *sheet, {});
  const double ring = 2.0 * 3.14159 * 80.0 * 5.0;
  EXPECT_NEAR(darkPixels(page, 60, 385), ring, 0.05 * ring) << "left page";
  EXPECT_NEAR(darkPixels(page, 415, 720), ring, 0.05 * ring) << "right page";
  EXPECT_EQ(darkPixels(page, 0, 55) + darkPixels(page, 725, kPhotoWidth), 0) << "table";
  EXPECT_EQ(darkPixels(page, 385, 415), 0) << "gutter";
}

// A blank facing page may be cut off or not: nothing on it is lost.
TEST(OpenBook, BothPagesOfAnOpenBookAreTheSheet) {
  expectBothPages(photo([](double x, double y) { return openBook(x, y, true); }));
}

/// In light that is warmer left of the gutter.
Scan tintedLeft(Scan scan) {
  scan.colour = ColourImage(kPhotoWidth, kPhotoHeight);
  const auto channel = [](double level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)); };
  for (int y = 0; y < kPhotoHeight; ++y) {
    for (int x = 0; x < kPhotoWidth; ++x) {
      const double grey = scan.grey.level(x, y), warm = x < 400 ? 24.0 : 0.0;
      scan.colour.row(y)[x] = {channel(grey + 0.3 * warm), channel(grey), channel(grey - warm)};
    }
  }
  return scan;
}

TEST(OpenBook, APageOfABookMayHaveAnotherTintThanTheOther) {
  expectBothPages(tintedLeft(photo([](double x, double y) { return openBook(x, y, true); })));
}

// What is no page of the same book: a warm mat with a pattern that lies beside the lower half of a sheet.
TEST(OpenBook, AMatOfAnotherTintIsNoFacingPage) {
  const Scan scan = tintedLeft(photo([](double x, double y) -> PhotoPixel {
    if (x >= 404.0) return openBook(x, y, true);
    if (x > 396.0 || x < 60.0 || y < 300.0 || y > 600.0) return {70.0, 2.0};
    return {std::fabs(std::hypot(x - 230.0, y - 450.0) - 80.0) < 2.5 ? 50.0 : 225.0, 1.5};
  }));
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_EQ(darkPixels(onlyTheSheet(scan.grey, *sheet, {}), 0, 385), 0);
}

// Paper bends away towards the gutter: its shading is no ink, a grey shape drawn far from it is.
TEST(OpenBook, ShadingTowardsTheGutterIsTakenOut) {
  const Scan scan = photo([](double x, double y) {
    PhotoPixel p = openBook(x, y, true);
    const double fromGutter = std::fabs(x - 400.0);
    if (p.grey > 150.0) p.grey *= 1.0 - (x < 400.0 ? 0.25 : 0.1) * std::exp(-fromGutter / 25.0);
    if (x > 150.0 && x < 190.0 && y > 460.0 && y < 500.0) p.grey = 170.0;
    return p;
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  const GreyImage page = onlyTheSheet(scan.grey, *sheet, {});
  const auto meanAt = [&](int x, int y) {
    double sum = 0.0;
    for (int j = y - 4; j < y + 4; ++j) {
      for (int i = x - 4; i < x + 4; ++i) sum += page.level(i, j);
    }
    return sum / 64.0;
  };
  for (const int y : {100, 320, 540}) {
    const double paper = meanAt(200, y);
    for (const int x : {370, 380, 422, 432, 600}) EXPECT_NEAR(meanAt(x, y), paper, 0.03 * paper) << x << ", " << y;
  }
  EXPECT_NEAR(meanAt(170, 480) / meanAt(250, 480), 170.0 / 225.0, 0.03);
}

// A wash beside the gutter is no shading of the paper, and the paper beyond it stays as it is.
TEST(OpenBook, AToneDrawnBesideTheGutterStays) {
  const Scan scan = photo([](double x, double y) {
    if (x > 250.0 && x < 330.0 && y > 100.0 && y < 400.0) return PhotoPixel{170.0, 1.5};
    return openBook(x, y, true);
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  const GreyImage page = onlyTheSheet(scan.grey, *sheet, {});
  const auto mean = [&](int x0, int x1, int y0, int y1) {
    double sum = 0.0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) sum += page.level(x, y);
    }
    return sum / ((x1 - x0) * (y1 - y0));
  };
  const double paper = mean(100, 140, 480, 560);
  EXPECT_NEAR(mean(260, 320, 110, 390) / paper, 170.0 / 225.0, 0.04);
  EXPECT_NEAR(mean(100, 140, 120, 380) / paper, 1.0, 0.03);
}

}  // namespace
}  // namespace batten
