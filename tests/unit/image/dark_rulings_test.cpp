// SPDX-License-Identifier: GPL-3.0-or-later
// Ruled lines that a copy shows as dark as ink: fewer than fill the page, broken, and partly hidden by the drawing.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/image/page_preparation.h"
#include "core/image/ruling/find_rulings.h"
#include "core/image/ruling/remove_rulings.h"
#include "tests/unit/image/ruled_page.h"

namespace batten {
namespace {

using test::covered;
using test::drawing;
using test::inkOf;
using test::kPen;
using test::kRuledWidth;
using test::layer;
using test::light;
using test::paperWith;
using test::Wrong;
using test::wrongInk;

struct DarkLines {
  int count = 9;
  double firstY = 110.0, spacing = 88.0, width = 1.8;
  double fromX = 60.0, toX = 700.0;
  double uneven = 0.0;    ///< [px] that lines lie off their places, up and down in turn.
  bool isBroken = true;   ///< Here and there.
  bool hasPosts = false;  ///< Strokes that join their ends.
};

double placeOf(const DarkLines& d, int line) {
  return d.firstY + d.spacing * line + d.uneven * std::sin(2.4 * line + 0.7);
}

std::vector<float> linesOf(const DarkLines& d) {
  return layer([&](double x, double y) {
    if (x < d.fromX || x > d.toX) return 0.0f;
    const double last = placeOf(d, d.count - 1);
    float ink = 0.0f;
    for (int i = 0; i < d.count; ++i) {
      const double at = placeOf(d, i) + 0.006 * (x - d.fromX);
      if (d.isBroken && std::fmod(x + 37.0 * i, 53.0) < 4.0) continue;
      ink = std::max(ink, covered(y - at, d.width));
    }
    if (d.hasPosts && y > d.firstY && y < last)
      ink = std::max({ink, covered(x - d.fromX - 3.0, 5.0), covered(x - d.toX + 3.0, 5.0)});
    return ink;
  });
}

TEST(DarkRulings, LieUnderTheDrawing) {
  const Scan scan = paperWith({{linesOf({}), kPen}, {drawing(), kPen}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].spacingPx, 88.0, 0.5);
  const Wrong wrong = wrongInk(inkOf(withoutRulings(scan.grey, found, {})));
  EXPECT_LT(wrong.beside, 200);
  EXPECT_LT(wrong.missed, 0.02);
  const auto page = preparePage(scan, {}, {});
  EXPECT_EQ(page->rulings.size(), 1u);
}

TEST(DarkRulings, AShapeOverThemStays) {
  // Black from one side to beyond the middle.
  const auto isBlack = [](double x, double y) { return x > 20.0 && x < 420.0 && y > 480.0 && y < 640.0; };
  const auto black = layer([&](double x, double y) { return isBlack(x, y) ? 1.0f : 0.0f; });
  const Scan scan = paperWith({{linesOf({}), kPen}, {black, kPen}, {drawing(), kPen}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 1u);
  const BitImage ink = inkOf(withoutRulings(scan.grey, found, {}));
  int missed = 0;
  for (int y = 485; y < 635; ++y)
    for (int x = 25; x < 415; ++x) missed += ink.at(x, y) ? 0 : 1;
  EXPECT_EQ(missed, 0);
}

TEST(DarkRulings, LinesThatWereDrawnAreNone) {
  const struct {
    const char* name;
    DarkLines lines;
    bool isDrawnOver = true;
  } cases[] = {{"as wide as the strokes", {.width = 5.0}},
               {"uneven", {.uneven = 3.0}},
               {"few", {.count = 6, .spacing = 130.0}},
               {"a ladder", {.isBroken = false, .hasPosts = true}},
               {"nothing over them", {}, false}};
  for (const auto& c : cases) {
    std::vector<test::InkLayer> inks{{linesOf(c.lines), kPen}};
    if (c.isDrawnOver) inks.push_back({drawing(), kPen});
    EXPECT_TRUE(findRulings(paperWith(inks).grey, {}).empty()) << c.name;
  }
}

// Rows between thin lines, as of a list, with something in each: nothing crosses the lines.
TEST(DarkRulings, RowsOfAListAreNone) {
  const DarkLines lines{.isBroken = false};
  const auto dots = layer([&](double x, double y) {
    const double row = std::remainder(y - lines.firstY - 0.5 * lines.spacing, lines.spacing);
    const double column = std::remainder(x - 90.0, 120.0);
    return y > lines.firstY && y < placeOf(lines, lines.count - 1) && x > 80.0 && x < 680.0
               ? covered(std::hypot(row, column) - 14.0, 5.0)
               : 0.0f;
  });
  EXPECT_TRUE(findRulings(paperWith({{linesOf(lines), kPen}, {dots, kPen}}).grey, {}).empty());
}

}  // namespace
}  // namespace batten
