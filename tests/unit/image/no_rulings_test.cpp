// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings whose lines are not the paper's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/image/ruling/find_rulings.h"
#include "tests/support/hatching_page.h"
#include "tests/unit/image/ruled_page.h"

namespace batten {
namespace {

using test::covered;
using test::drawing;
using test::kPen;
using test::layer;
using test::light;
using test::offLine;
using test::paperWith;
using test::ruling;

TEST(Rulings, DrawingsHaveNone) {
  const auto within = [](double x, double y, double x0, double y0, double x1, double y1) {
    return x > x0 && x < x1 && y > y0 && y < y1;
  };
  const struct {
    const char* name;
    std::vector<float> ink;
  } cases[] = {
      {"rings and a wave", drawing()},
      {"hatching", layer([&](double x, double y) {
         return within(x, y, 100, 200, 420, 700) ? covered(offLine({.spacing = 14.0, .turnedDeg = 4.0}, x, y), 2.0)
                                                 : 0.0f;
       })},
      {"a railing", layer([&](double x, double y) {
         return within(x, y, 30, 500, 730, 800) ? covered(offLine({.spacing = 35.0, .runsDown = true}, x, y), 3.0)
                                                : 0.0f;
       })},
      {"a grille", layer([&](double x, double y) {
         const double spacing = 22.0;
         return within(x, y, 250, 380, 560, 620) ? covered(offLine({.spacing = spacing}, x, y), 3.0) : 0.0f;
       })},
      {"siding of a house, drawn by hand", layer([&](double x, double y) {
         const double sway = 5.0 * std::sin(x / 47.0 + y / 9.0) + 4.0 * std::sin(y * 0.37);
         return covered(offLine({.spacing = 40.0}, x, y + sway), 3.0);
       })},
      {"spokes", layer([&](double x, double y) {
         const double angle = std::atan2(y - 450.0, x - 380.0), away = std::hypot(x - 380.0, y - 450.0);
         const double step = std::numbers::pi / 18.0;
         const double off = away * (angle - step * std::round(angle / step));
         return away < 330.0 ? covered(off, 2.0) : 0.0f;
       })},
      {"three lines over the page", layer([&](double x, double y) {
         return within(x, y, 20, 300, 740, 420) ? covered(offLine({.spacing = 38.0}, x, y), 2.0) : 0.0f;
       })},
      {"rows of letters", layer([&](double x, double y) {
         // Bowls and stems on even lines, a space after every sixth.
         const double row = std::fmod(y, 18.0) - 9.0, letter = std::floor(x / 9.0), at = x - 9.0 * letter - 4.0;
         const auto kind = static_cast<int>(letter + 5.0 * std::floor(y / 18.0)) % 6;
         if (kind == 5 || std::fabs(row) > 5.0) return 0.0f;
         const double bowl = std::fabs(std::hypot(at, row) - 3.0), stem = std::fabs(at + 2.0);
         const double bar = std::fabs(at) < 3.0 ? std::fabs(row - (kind - 2.0)) : 9.0;
         return covered(kind == 0 ? bowl : kind == 1 ? std::min(stem, bowl) : std::min(stem, bar), 1.4);
       })},
      {"rows of dots", layer([&](double x, double y) {
         return covered(std::hypot(std::remainder(x, 10.0), std::remainder(y, 10.0)), 6.0);
       })},
      {"a net at 45 degrees", layer([&](double x, double y) {
         return std::max(covered(offLine({.spacing = 7.071, .turnedDeg = 45.0}, x, y), 1.0),
                         covered(offLine({.spacing = 7.071, .turnedDeg = -45.0}, x, y), 1.0));
       })},
      {"blank paper", layer([](double, double) { return 0.0f; })}};
  for (const auto& c : cases) {
    EXPECT_TRUE(findRulings(paperWith({{c.ink, kPen}}).grey, {}).empty()) << c.name;
    EXPECT_TRUE(findRulings(paperWith({{c.ink, light(0.7)}}, 4.0).grey, {}).empty()) << c.name << ", pencil";
  }
}

TEST(Rulings, HatchingTooFineForARulingIsNone) {
  // Oblique: a line of the ruling, three pixels wide, meets ink in nearly every column.
  for (const double offset : {0.0, 0.7}) {
    const test::Hatching oblique{.angleDeg = 45.0, .spacingPx = 4.2426, .offsetPx = offset};
    EXPECT_TRUE(findRulings(test::hatchingPage(oblique), {}).empty()) << offset;
  }
  // Every other of its lines is far enough from the next.
  EXPECT_TRUE(findRulings(test::hatchingPage({.angleDeg = 90.0, .spacingPx = 4.5}), {}).empty());
}

TEST(Rulings, TeethOfACombAreNone) {
  for (const int spacing : {5, 10, 25}) {
    GreyImage comb(600, 400, 235 * 257);
    for (int y = 10; y < 390; ++y) {
      for (int x = 5; x < 595; ++x)
        if ((x - 5) % spacing < 2 || (y >= 200 && y < 203)) comb.row(y)[x] = 20 * 257;
    }
    EXPECT_TRUE(findRulings(comb, {}).empty()) << spacing;
    // Without what joins them, and with a line across that runs to the border, the lines are ruled.
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 600; ++x)
        comb.row(y)[x] = (x - 5) % spacing < 2 || (y >= 200 && y < 203) ? 20 * 257 : 235 * 257;
    }
    EXPECT_FALSE(findRulings(comb, {}).empty()) << spacing << ", from border to border";
  }
}

}  // namespace
}  // namespace batten
