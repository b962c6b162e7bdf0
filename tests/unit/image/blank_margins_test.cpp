// SPDX-License-Identifier: GPL-3.0-or-later
// A scan that was exported with its document's white page around it: the page is no paper, and its edge no line.

#include "core/image/sheet/blank_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/image/page_preparation.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

constexpr int kPastedPageWidth = 600, kPastedPageHeight = 450;
const PictureBox kPasted{100, 60, 420, 330};

/// 0..255 at a pixel; what is drawn on is rounded.
using PastedDrawing = std::function<double(int x, int y)>;

GreyImage pastedPageOf(const PastedDrawing& at) {
  GreyImage page(kPastedPageWidth, kPastedPageHeight);
  for (int y = 0; y < kPastedPageHeight; ++y)
    for (int x = 0; x < kPastedPageWidth; ++x)
      page.row(y)[x] = static_cast<std::uint16_t>(257 * std::lround(std::clamp(at(x, y), 0.0, 255.0)));
  return page;
}

bool isInBox(const PictureBox& box, int x, int y) {
  return x >= box.left && y >= box.top && x < box.left + box.width && y < box.top + box.height;
}

/// Paper with grain and a ring, on a page of one value.
GreyImage pastedScan(const PictureBox& box, double page, double paper) {
  std::mt19937 random(5);
  std::normal_distribution<double> grain(0.0, 2.0);
  return pastedPageOf([&](int x, int y) {
    if (!isInBox(box, x, y)) return page;
    const bool isRing = std::fabs(std::hypot(x - 300.0, y - 220.0) - 90.0) < 2.0;
    return (isRing ? 60.0 : paper) + grain(random);
  });
}

void expectCutAtBox(const GreyImage& page, const PictureBox& box) {
  const auto sheet = sheetWithinMargins(page);
  ASSERT_TRUE(sheet);
  int outside = 0, inside = 0;
  for (int j = 0; j < sheet->inside.height; ++j) {
    for (int i = 0; i < sheet->inside.width; ++i) {
      if (!sheet->inside.at(i, j)) continue;
      const int x = i * sheet->cellPx, y = j * sheet->cellPx, last = sheet->cellPx - 1;
      const bool isWithin = isInBox(box, x, y) && isInBox(box, x + last, y + last);
      ++(isWithin ? inside : outside);
    }
  }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(inside * sheet->cellPx * sheet->cellPx, 0.9 * box.width * box.height);
}

TEST(BlankMargins, EndAtAPastedScan) {
  for (const double page : {255.0, 250.0, 0.0}) expectCutAtBox(pastedScan(kPasted, page, 232.0), kPasted);
  const PictureBox toTheRight{80, 0, kPastedPageWidth - 80, kPastedPageHeight}, letterbox{0, 50, kPastedPageWidth, 350};
  expectCutAtBox(pastedScan(toTheRight, 255.0, 232.0), toTheRight);
  expectCutAtBox(pastedScan(letterbox, 0.0, 232.0), letterbox);
}

TEST(BlankMargins, EndAtAPastedScanThroughJpeg) {
  for (const int quality : {95, 85, 70}) {
    GreyImage page = pastedScan(kPasted, 255.0, 225.0);
    test::throughJpeg(page, quality);
    expectCutAtBox(page, kPasted);
  }
}

TEST(BlankMargins, AreNoneAroundADrawing) {
  std::mt19937 random(6);
  std::normal_distribution<double> grain(0.0, 3.0);
  const struct {
    const char* name;
    PastedDrawing at;
  } cases[] = {
      {"a ring", [](int x, int y) { return std::fabs(std::hypot(x - 300, y - 220) - 150.0) < 2.0 ? 20.0 : 255.0; }},
      {"a frame",
       [](int x, int y) {
         return isInBox(kPasted, x, y) && !isInBox({104, 64, 412, 322}, x, y) ? 20.0 : 255.0;
       }},
      {"a frame around the page's own noise",
       [&](int x, int y) {
         if (!isInBox(kPasted, x, y)) return 255.0;
         return !isInBox({104, 64, 412, 322}, x, y) ? 20.0 : 255.0 - 0.5 * std::fabs(grain(random));
       }},
      {"a frame with hatching",
       [](int x, int y) {
         if (!isInBox(kPasted, x, y)) return 255.0;
         return !isInBox({104, 64, 412, 322}, x, y) || (x + y) % 6 < 2 ? 20.0 : 255.0;
       }},
      {"a filled rectangle", [](int x, int y) { return isInBox(kPasted, x, y) ? 180.0 : 255.0; }},
      {"a rectangle shaded by hand",
       [&](int x, int y) {
         const double wave = 2.0 * std::sin(0.05 * x) + 2.0 * std::sin(0.04 * y);
         const bool isShaded = isInBox(kPasted, static_cast<int>(x + wave), static_cast<int>(y + wave));
         return isShaded ? 190.0 + 5.0 * grain(random) : 255.0;
       }},
      {"paper as white as the page",
       [&](int x, int y) { return isInBox(kPasted, x, y) ? 258.0 + grain(random) : 255.0; }},
      {"grain everywhere", [&](int, int) { return 235.0 + grain(random); }},
  };
  for (const auto& c : cases) EXPECT_FALSE(sheetWithinMargins(pastedPageOf(c.at))) << c.name;
  EXPECT_FALSE(sheetWithinMargins(pastedScan({250, 200, 90, 70}, 255.0, 232.0))) << "a stamp";
  EXPECT_FALSE(sheetWithinMargins(pastedScan({2, 2, kPastedPageWidth - 4, kPastedPageHeight - 4}, 255.0, 232.0)))
      << "a rim";
}

TEST(BlankMargins, TinyAndUniformPicturesHaveNone) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 50), std::pair(50, 1), std::pair(3, 3)})
    EXPECT_FALSE(sheetWithinMargins(GreyImage(width, height))) << width << " x " << height;
  for (const bool isTall : {false, true}) {
    // A strip of grain at the far end of white.
    GreyImage strip(isTall ? 109 : 4000, isTall ? 4000 : 109);
    for (int i = 0; i < 4000; ++i)
      for (int k = 98; k < 109; ++k)
        strip.row(isTall ? i : k)[isTall ? k : i] = static_cast<std::uint16_t>(257 * (200 + (i * 7 + k * 3) % 11));
    EXPECT_FALSE(sheetWithinMargins(strip));
  }
  EXPECT_FALSE(sheetWithinMargins(GreyImage::uniform(400, 300, 65535)));
  EXPECT_FALSE(sheetWithinMargins(GreyImage()));
}

TEST(BlankMargins, APartAtTheFarCornerOfAPictureHasARim) {
  const PaperSheet sheet = sheetWithinRim(4000, 109, {3990, 98, 10, 11});
  EXPECT_LE(sheet.inside.count(), 1);
}

// As the default recipe does it: the page around becomes paper.
TEST(BlankMargins, AreCutOffThePage) {
  Scan scan;
  scan.grey = pastedScan(kPasted, 255.0, 232.0);
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  for (const int x : {10, 99, 104, 300, 515, 522, 590})
    EXPECT_NEAR(page->grey->level(x, 70), 232.0, 12.0) << "at " << x;
  ASSERT_FALSE(page->notes.empty());
  EXPECT_NE(page->notes.front().find("outside the sheet"), std::string::npos) << page->notes.front();
  PreparationParams whole;
  whole.sheet = SheetUse::Off;
  EXPECT_FALSE(preparePage(scan, whole, {})->grey);
}

}  // namespace
}  // namespace batten
