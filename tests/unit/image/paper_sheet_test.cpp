// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/paper_sheet.h"
#include "core/image/sheet/paint_over.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>

#include "core/image/file/scan_reader.h"
#include "core/image/page_preparation.h"
#include "tests/support/colour_page.h"
#include "tests/support/stress_page.h"
#include "tests/unit/image/photographed_sheet.h"

namespace batten {
namespace {

using test::kPhotoHeight;
using test::kPhotoWidth;
using test::photo;
using test::PhotoPixel;
using test::sheetOf;

/// Signed distance into a sheet turned by 4 degrees; positive inside.
double depthInSheet(double x, double y) {
  const double u = std::cos(0.07) * (x - 410.0) + std::sin(0.07) * (y - 320.0);
  const double v = -std::sin(0.07) * (x - 410.0) + std::cos(0.07) * (y - 320.0);
  return std::min(320.0 - std::fabs(u), 240.0 - std::fabs(v));
}
bool isRing(double x, double y) { return std::fabs(std::hypot(x - 410.0, y - 320.0) - 130.0) < 2.5; }

void expectCutAtTheSheet(const Scan& scan, const char* name) {
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value()) << name;
  const GreyImage page = onlyTheSheet(scan.grey, *sheet, {});
  int darkOutside = 0, changedInside = 0;
  for (int y = 0; y < kPhotoHeight; ++y) {
    for (int x = 0; x < kPhotoWidth; ++x) {
      const double depth = depthInSheet(x + 0.5, y + 0.5);
      if (depth < 0.0 && page.level(x, y) < 215.0) ++darkOutside;
      if (depth > 22.0 && page.row(y)[x] != scan.grey.row(y)[x]) ++changedInside;
    }
  }
  EXPECT_EQ(darkOutside, 0) << name;
  EXPECT_EQ(changedInside, 0) << name;
}

// The outline of a box, drawn up to a few px from the edge of the sheet.
TEST(PaperSheet, AShapeDrawnUpToTheEdgeOfTheSheetEnclosesPaper) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (x < 40.0 || x > 780.0 || y < 40.0 || y > 600.0) return {90.0, 2.0};
    const double toBox = std::max(std::fabs(x - 700.0) - 60.0, std::fabs(y - 320.0) - 80.0);
    if (std::fabs(toBox) < 5.0) return {60.0, 1.5};
    const bool isBeside = x > 755.0 && std::fabs(y - 320.0) < 12.0;  // an accident: dark up to the table
    const bool isRing = std::fabs(std::hypot(x - 690.0, y - 320.0) - 30.0) < 2.5;
    return {isBeside || isRing ? 60.0 : 235.0, 1.5};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_TRUE(sheet->inside.at(690 / sheet->cellPx, 320 / sheet->cellPx));
  EXPECT_TRUE(sheet->inside.at(690 / sheet->cellPx, 290 / sheet->cellPx));
  EXPECT_FALSE(sheet->inside.at(800 / sheet->cellPx, 320 / sheet->cellPx));
}

// A tone drawn up to the table has the outline of the sheet against it, and another look.
TEST(PaperSheet, AToneDrawnUpToTheEdgeOfTheSheetStays) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (x < 40.0 || x > 780.0 || y < 40.0 || y > 600.0) return {40.0, 2.0};
    return x > 620.0 && std::fabs(y - 320.0) < 90.0 ? PhotoPixel{140.0, 8.0} : PhotoPixel{};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  for (const int x : {650, 700, 760}) EXPECT_TRUE(sheet->inside.at(x / sheet->cellPx, 320 / sheet->cellPx)) << x;
  EXPECT_FALSE(sheet->inside.at(800 / sheet->cellPx, 320 / sheet->cellPx));
}

// A tone that was shaded up to a corner of the picture bulges into the paper; a table would leave it convex.
TEST(PaperSheet, AToneThatBulgesFromACornerOfThePictureIsNoTable) {
  const auto bulge = [](double x, double y) -> PhotoPixel {
    if (std::hypot(x, y) < 290.0) return {180.0, 7.0};
    return {isRing(x, y) ? 40.0 : 235.0, 1.5};
  };
  EXPECT_FALSE(sheetOf(photo(bulge)).has_value());
  const auto table = [](double x, double y) -> PhotoPixel {
    if (x + 0.8 * y < 290.0) return {180.0, 7.0};
    return {isRing(x, y) ? 40.0 : 235.0, 1.5};
  };
  EXPECT_TRUE(sheetOf(photo(table)).has_value());
}

// Figures on lines that run off the sheet hang on the table by them.
TEST(PaperSheet, WhatIsDrawnOnLinesThatRunOffTheSheetStays) {
  const auto figure = [](double x, double y) {
    const double u = std::fabs(std::remainder(x, 100.0)), v = std::fabs(y - 200.0);
    const bool isLine = u < 2.5 && y < 175.0, isBox = std::max(u, v) < 30.0 && std::max(u, v) > 25.0;
    return isLine || (isBox && x > 150.0 && x < 650.0);
  };
  const Scan scan = photo([&](double x, double y) -> PhotoPixel {
    if (depthInSheet(x, y) < 0.0) return {80.0, 25.0};
    return {figure(x, y) ? 60.0 : 235.0, 1.5};
  });
  expectCutAtTheSheet(scan, "figures on lines");
}

// What lies across the edge of the sheet, or where it is torn away, is no part of it.
TEST(PaperSheet, ANotchThroughWhichTheTableShowsIsCutOff) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (x < 40.0 || x > 780.0 || y < 40.0 || y > 600.0) return {40.0, 2.0};
    const bool isTorn = x > 740.0 && std::fabs(y - 320.0) < 60.0;
    return isTorn ? PhotoPixel{40.0, 2.0} : PhotoPixel{};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_FALSE(sheet->inside.at(765 / sheet->cellPx, 320 / sheet->cellPx));
}

TEST(PaperSheet, ABlankCardBesideTheSheetIsCutOff) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (y > 60.0 && y < 580.0 && x > 60.0 && x < 500.0)
      return {std::fabs(std::hypot(x - 280.0, y - 320.0) - 130.0) < 2.5 ? 40.0 : 235.0, 1.5};
    if (y > 60.0 && y < 580.0 && x > 512.0 && x < 790.0) return {205.0, 1.5};
    return {110.0, 2.0};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_FALSE(sheet->inside.at(650 / sheet->cellPx, 320 / sheet->cellPx));
  EXPECT_TRUE(sheet->inside.at(280 / sheet->cellPx, 320 / sheet->cellPx));
}

// So narrow that it has not one cell across.
TEST(PaperSheet, AStripHasNoSheetAndNoError) {
  Scan scan;
  scan.grey = GreyImage(80, 40000);
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page) << page.error().message;
  EXPECT_FALSE(page->sheet);
}

TEST(PaperSheet, IsFoundOnTableAndCarpet) {
  expectCutAtTheSheet(photo([](double x, double y) -> PhotoPixel {
                        if (depthInSheet(x, y) < 0.0) return {110.0, 2.0};
                        return {isRing(x, y) ? 40.0 : 235.0, 1.5};
                      }),
                      "table");
  expectCutAtTheSheet(photo([](double x, double y) -> PhotoPixel {
                        if (depthInSheet(x, y) < 0.0) return {150.0, 30.0};
                        return {isRing(x, y) ? 40.0 : 235.0, 1.5};
                      }),
                      "carpet");
  expectCutAtTheSheet(photo([](double x, double y) -> PhotoPixel {
                        const double depth = depthInSheet(x, y);
                        // A shadow falls off the edge of the sheet.
                        if (depth < 0.0) return {170.0 - 90.0 * std::exp(depth / 8.0), 2.0};
                        return {isRing(x, y) ? 40.0 : 235.0, 1.5};
                      }),
                      "shadow along the edge");
}

// The table is even and larger than the paper that a drawing leaves free, which it parts from edge to edge.
TEST(PaperSheet, IsFoundOnAnEvenTableHoweverTheDrawingPartsIt) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (depthInSheet(x, y) < 0.0) return {185.0, 2.0};
    const bool isDrawn = std::fabs(y - 320.0 - 40.0 * std::sin(x / 30.0)) < 50.0;
    return {isDrawn ? 60.0 : 246.0, isDrawn ? 30.0 : 1.5};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  for (int y = 4; y < kPhotoHeight; y += 8) {
    for (int x = 4; x < kPhotoWidth; x += 8) {
      const double depth = depthInSheet(x, y);
      if (std::fabs(depth) < 22.0) continue;
      ASSERT_EQ(sheet->inside.at(x / sheet->cellPx, y / sheet->cellPx), depth > 0.0) << x << ' ' << y;
    }
  }
}

// A toned page that is drawn upon around the panel.
TEST(PaperSheet, ABrightPanelOfADrawingIsNone) {
  const auto onPanel = [](double x, double y) -> std::optional<PhotoPixel> {
    if (std::fabs(x - 410.0) > 240.0 || std::fabs(y - 320.0) > 180.0) return {};
    return PhotoPixel{isRing(x, y) ? 40.0 : 246.0, 1.5};
  };
  const Scan dense = photo([&](double x, double y) -> PhotoPixel {
    const bool isDrawn = std::hypot(std::fmod(x, 80.0) - 40.0, std::fmod(y, 80.0) - 40.0) < 32.0;
    return onPanel(x, y).value_or(PhotoPixel{isDrawn ? 60.0 : 185.0, 1.5});
  });
  EXPECT_FALSE(sheetOf(dense).has_value());
  const Scan lines = photo([&](double x, double y) -> PhotoPixel {
    const bool isDrawn = std::fabs(std::fmod(x + 0.5 * y, 90.0) - 45.0) < 1.5;
    return onPanel(x, y).value_or(PhotoPixel{isDrawn ? 60.0 : 185.0, 1.5});
  });
  EXPECT_FALSE(sheetOf(lines).has_value());
}

// The sheet fills nearly all of the picture.
/// Of a napkin that is embossed along its edges: the paper is rougher there, but it is the same on both sides of the
/// line.
TEST(PaperSheet, PaperWithinADrawnFrameIsNone) {
  const auto napkin = [](double x, double y, bool isFramed) {
    const double depth = depthInSheet(x, y);
    if (isFramed && std::fabs(depth) < 4.0) return PhotoPixel{60.0, 1.5};
    if (isRing(x, y)) return PhotoPixel{60.0, 1.5};
    return depth < 0.0 ? PhotoPixel{228.0, 16.0} : PhotoPixel{235.0, 1.5};
  };
  EXPECT_FALSE(sheetOf(photo([&](double x, double y) { return napkin(x, y, true); })).has_value());
  EXPECT_TRUE(sheetOf(photo([&](double x, double y) { return napkin(x, y, false); })).has_value()) << "a rough table";
}

TEST(PaperSheet, ACornerOfTheTableIsCutOff) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (x > 780.0 + 0.17 * y) return {90.0, 25.0};
    return {isRing(x, y) ? 40.0 : 235.0, 1.5};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_FALSE(sheet->inside.at(810 / sheet->cellPx, 60 / sheet->cellPx));
  EXPECT_TRUE(sheet->inside.at(700 / sheet->cellPx, 60 / sheet->cellPx));
  EXPECT_LT(sheet->outsideShare, 0.03);
}

// Light that grazes rough paper shows its grain at one side only, and its lamp is nearer to the other: the sheet goes
// on as long as nothing changes at once.
TEST(PaperSheet, GrainThatGrowsUnderGrazingLightIsNoCarpet) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (y < 60.0) return {90.0, 3.0};
    const double grazing = std::max(0.0, 1.0 - x / 600.0);  // up to the table along the left border
    const bool isInk = isRing(x, y) || std::fabs(std::hypot(x - 120.0, y - 520.0) - 60.0) < 2.5;
    return {isInk ? 40.0 : 235.0 - 40.0 * grazing, 2.0 + 24.0 * grazing};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  EXPECT_FALSE(sheet->inside.at(400 / sheet->cellPx, 30 / sheet->cellPx)) << "the table";
  for (const auto& [x, y] : {std::pair(120, 460), std::pair(60, 520), std::pair(120, 580), std::pair(20, 620)})
    EXPECT_TRUE(sheet->inside.at(x / sheet->cellPx, y / sheet->cellPx)) << x << ", " << y;
}

TEST(PaperSheet, KnowsItsCorners) {
  const auto sheet = sheetOf(photo([](double x, double y) -> PhotoPixel {
    return depthInSheet(x, y) < 0.0 ? PhotoPixel{110.0, 2.0} : PhotoPixel{};
  }));
  ASSERT_TRUE(sheet.has_value());
  ASSERT_EQ(sheet->cornersPx.size(), 4u);
  const double c = std::cos(0.07), s = std::sin(0.07);
  const Vec2 topLeft(410.0 - 320.0 * c + 240.0 * s, 320.0 - 320.0 * s - 240.0 * c);
  EXPECT_LT((sheet->cornersPx[0] - topLeft).norm(), 12.0);
  EXPECT_GT(sheet->cornersPx[1].x(), 650.0);
  EXPECT_GT(sheet->cornersPx[2].y(), 500.0);
  EXPECT_NEAR(sheet->outsideShare, 1.0 - 640.0 * 480.0 / (kPhotoWidth * kPhotoHeight), 0.06);
}

TEST(PaperSheet, ADarkSolidOnPaperIsNone) {
  const auto solid = photo([](double x, double y) -> PhotoPixel {
    const double u = std::fabs(x - 410.0) / 380.0, v = std::fabs(y - 320.0) / 290.0;
    return {std::pow(u, 4.0) + std::pow(v, 4.0) < 1.0 ? 40.0 : 235.0, 1.5};
  });
  EXPECT_FALSE(sheetOf(solid).has_value());
}

TEST(PaperSheet, AFoldThatDarkensPartOfADrawingIsNoEdge) {
  for (const auto& paper : test::stressPapers(kPhotoWidth, kPhotoHeight)) {
    for (const auto& scene : test::stressScenes(kPhotoWidth, kPhotoHeight)) {
      const Scan scan = test::renderStress(scene.coverage, kPhotoWidth, kPhotoHeight, paper.grey, {20.0, 4.0, 0.8}, 3);
      EXPECT_FALSE(sheetOf(scan).has_value()) << scene.name << " on " << paper.name;
    }
  }
}

// Letters make cells as rough as a carpet, and rows of them run along the border.
TEST(PaperSheet, DenseTextUpToTheBorderIsNoTable) {
  const auto text = readScan(std::filesystem::path(BATTEN_TEST_DATA) / "dense_text.png", {}, {});
  ASSERT_TRUE(text.has_value());
  EXPECT_FALSE(sheetOf(*text).has_value());
}

TEST(PaperSheet, TinyPicturesHaveNone) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(400, 1), std::pair(1, 400), std::pair(79, 79)})
    EXPECT_FALSE(findPaperSheet(GreyImage(width, height), {}, {})) << width << " x " << height;
}

TEST(PaperSheet, IsNotLookedForInADrawing) {
  const struct {
    const char* name;
    std::function<PhotoPixel(double, double)> at;
  } cases[] = {
      {"a ring",
       [](double x, double y) -> PhotoPixel {
         return {isRing(x, y) ? 40.0 : 235.0, 2.0};
       }},
      {"uneven light",
       [](double x, double y) -> PhotoPixel {
         return {240.0 - 0.12 * x - 0.05 * y, 2.0};
       }},
      {"strokes that run off the page",
       [](double x, double y) -> PhotoPixel {
         return {std::fabs(y - 0.7 * x) < 6.0 ? 40.0 : 235.0, 2.0};
       }},
      {"heavy strokes that part the lower corners from the page",
       [](double x, double y) -> PhotoPixel {
         const double roots = std::fabs(y - 330.0 - 0.4 * std::fabs(x - 410.0)) - 14.0;
         const double down = std::fabs(std::remainder(x - 60.0, 120.0)) - 7.0;
         const bool isBelow = y > 330.0 + 0.4 * std::fabs(x - 410.0);
         const bool isInk = roots < 0.0 || (isBelow && down < 0.0);
         return isInk ? PhotoPixel{70.0, 40.0} : PhotoPixel{235.0, 2.0};
       }},
      {"a solid shape at the lower border",
       [](double x, double y) -> PhotoPixel {
         return {std::hypot(x - 400.0, y - 660.0) < 200.0 ? 30.0 : 235.0, 2.0};
       }},
      {"a dark ground that a bright figure is left out of",
       [](double x, double y) -> PhotoPixel {
         return {std::hypot(x - 400.0, y - 320.0) < 180.0 ? 235.0 : 60.0, 6.0};
       }},
  };
  for (const auto& c : cases) {
    EXPECT_FALSE(sheetOf(photo(c.at)).has_value()) << c.name;
  }
}

// A table fills the upper left of the picture and a corner at the right; from the sheet's edge two lines run down to
// the border and part the sheet in three. All three are the sheet.
TEST(PaperSheet, LinesThatPartItLeaveItWhole) {
  const auto isTable = [](double x, double y) { return x + 0.9 * y < 260.0 || (x - 820.0) - 1.5 * y > -60.0; };
  const auto isLine = [](double x, double y) {
    return std::fabs(x - 90.0 - 0.05 * y) < 2.0 || std::fabs(x - 180.0 - 0.1 * y) < 2.0;
  };
  const Scan scan = photo([&](double x, double y) -> PhotoPixel {
    if (isTable(x, y)) return {70.0, 6.0};
    return {isLine(x, y) ? 60.0 : 225.0, 1.5};
  });
  const auto sheet = sheetOf(scan);
  ASSERT_TRUE(sheet.has_value());
  const GreyImage page = onlyTheSheet(scan.grey, *sheet, {});
  int table = 0, changed = 0, darkTable = 0;
  for (int y = 0; y < kPhotoHeight; ++y) {
    for (int x = 0; x < kPhotoWidth; ++x) {
      if (isTable(x, y)) {
        ++table;
        darkTable += page.level(x, y) < 150.0 ? 1 : 0;
      } else if (x + 0.9 * y > 300.0 && (x - 820.0) - 1.5 * y < -100.0) {
        changed += page.row(y)[x] != scan.grey.row(y)[x] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(table, 30000);
  EXPECT_EQ(darkTable, 0);
  EXPECT_EQ(changed, 0);
}

TEST(PaperSheet, IsCutOnlyWhenAsked) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    if (depthInSheet(x, y) < 0.0) return {110.0, 2.0};
    return {isRing(x, y) ? 40.0 : 235.0, 1.5};
  });
  PreparationParams params;
  const auto cut = preparePage(scan, params, {});
  ASSERT_TRUE(cut->sheet.has_value());
  ASSERT_EQ(cut->notes.size(), 1u);
  EXPECT_NE(cut->notes[0].find("outside the sheet"), std::string::npos);
  params.sheet = SheetUse::Off;
  EXPECT_TRUE(preparePage(scan, params, {})->isUntouched());
}

TEST(PaperSheet, IsTheSameWithAnyNumberOfThreads) {
  const Scan scan = photo([](double x, double y) -> PhotoPixel {
    return depthInSheet(x, y) < 0.0 ? PhotoPixel{110.0, 2.0} : PhotoPixel{};
  });
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = findPaperSheet(scan.grey, scan.colour, one), b = findPaperSheet(scan.grey, scan.colour, four);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(onlyTheSheet(scan.grey, *a, one), onlyTheSheet(scan.grey, *b, four));
}

}  // namespace
}  // namespace batten
