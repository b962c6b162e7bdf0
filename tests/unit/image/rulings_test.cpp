// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/find_rulings.h"
#include "core/image/ruling/line_runs.h"
#include "core/image/ruling/remove_rulings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/image/binarize.h"
#include "core/image/page_preparation.h"
#include "tests/support/colour_page.h"
#include "tests/support/hatching_page.h"

namespace batten {
namespace {

using test::ColourPage;
using test::InkLayer;
using test::renderColourPage;

constexpr int kRuledWidth = 760, kRuledHeight = 900;
constexpr std::array<double, 3> kPen{0.12, 0.12, 0.12};

/// Share of a pixel that lies within half of `width` of the zero line of a field whose gradient has unit length.
float covered(double away, double width) {
  return static_cast<float>(std::clamp(0.5 * width - std::fabs(away) + 0.5, 0.0, 1.0));
}

std::vector<float> layer(const std::function<float(double, double)>& at) {
  std::vector<float> coverage;
  for (int y = 0; y < kRuledHeight; ++y) {
    for (int x = 0; x < kRuledWidth; ++x) coverage.push_back(at(x + 0.5, y + 0.5));
  }
  return coverage;
}

struct Ruling {
  double spacing = 31.0, width = 1.6, turnedDeg = 0.0, bendPx = 0.0, perspective = 0.0;
  bool runsDown = false;
};

/// How far a place lies from the nearest line of the ruling.
double offLine(const Ruling& r, double x, double y) {
  const double angle = r.turnedDeg * std::numbers::pi / 180.0;
  const double u = x - 0.5 * kRuledWidth, v = y - 0.5 * kRuledHeight;
  double across = r.runsDown ? std::cos(angle) * u + std::sin(angle) * v : -std::sin(angle) * u + std::cos(angle) * v;
  const double along = r.runsDown ? v / kRuledHeight : u / kRuledWidth;
  across += r.bendPx * 4.0 * along * along;
  const double spacing = r.spacing * (1.0 + r.perspective * along);
  return across - spacing * std::round(across / spacing);
}

std::vector<float> ruling(const Ruling& r) {
  return layer([&](double x, double y) { return covered(offLine(r, x, y), r.width); });
}

/// Two rings and a wave, 5 px wide.
double offDrawing(double x, double y) {
  const double rings =
      std::min(std::fabs(std::hypot(x - 380.0, y - 330.0) - 210.0), std::fabs(std::hypot(x - 300.0, y - 420.0) - 90.0));
  const double slope = 70.0 * std::cos(x / 60.0) / 60.0;
  const double wave = std::fabs(y - 720.0 - 70.0 * std::sin(x / 60.0)) / std::sqrt(1.0 + slope * slope);
  return x > 60.0 && x < 700.0 ? std::min(rings, wave) : rings;
}
std::vector<float> drawing() {
  return layer([](double x, double y) { return covered(offDrawing(x, y), 5.0); });
}

Scan paperWith(const std::vector<InkLayer>& inks, double noise = 1.5) {
  ColourPage page;
  page.width = kRuledWidth;
  page.height = kRuledHeight;
  page.paperLeft = {236, 236, 236};
  page.paperRight = {222, 222, 222};
  page.noise = noise;
  return renderColourPage(page, inks);
}

std::array<double, 3> light(double passes) { return {passes, passes, passes}; }

BitImage inkOf(const GreyImage& grey) {
  const auto thresholds = findThresholds(grey, {}, {}, {});
  return *binarize(grey, *thresholds, {}, {});
}

/// Ink farther than this from the drawing, and drawing without ink.
struct Wrong {
  int beside = 0;
  double missed = 0.0;
};
Wrong wrongInk(const BitImage& ink) {
  Wrong wrong;
  int all = 0, missed = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      const double off = offDrawing(x + 0.5, y + 0.5);
      if (off > 5.0 && ink.at(x, y)) ++wrong.beside;
      if (off > 1.5) continue;
      ++all;
      missed += ink.at(x, y) ? 0 : 1;
    }
  }
  wrong.missed = static_cast<double>(missed) / all;
  return wrong;
}

TEST(Rulings, AreFoundWithTheirSpacing) {
  const struct {
    const char* name;
    Ruling ruling;
  } cases[] = {{"plain", {}},
               {"turned", {.turnedDeg = 3.0}},
               {"turned the other way", {.spacing = 44.0, .turnedDeg = -6.5}},
               {"curved", {.bendPx = 14.0}},
               {"in perspective", {.perspective = 0.12}},
               {"down the page", {.spacing = 26.0, .turnedDeg = 1.5, .runsDown = true}},
               {"narrow", {.spacing = 9.0, .width = 1.0}}};
  for (const auto& c : cases) {
    const auto found = findRulings(paperWith({{ruling(c.ruling), light(0.8)}, {drawing(), kPen}}).grey, {});
    ASSERT_EQ(found.size(), 1u) << c.name;
    EXPECT_EQ(found[0].runsDown, c.ruling.runsDown) << c.name;
    const double turned = std::cos(c.ruling.turnedDeg * std::numbers::pi / 180.0);
    EXPECT_NEAR(found[0].spacingPx, c.ruling.spacing / turned, 0.02 * c.ruling.spacing) << c.name;
    // Every course lies on a line of the page.
    double most = 0.0;
    for (const RulingLine& line : found[0].lines) {
      for (const Vec2& p : line.coursePx) {
        if (p.x() > 0 && p.y() > 0 && p.x() < kRuledWidth && p.y() < kRuledHeight)
          most = std::max(most, std::fabs(offLine(c.ruling, p.x(), p.y())));
      }
    }
    EXPECT_LT(most, 2.0) << c.name;
  }
}

// A line down the page, straight and turned by as much as the ruling; `fromY` .. `toY` of the page.
std::vector<float> marginAt(double x0, double fromY = 0.0, double toY = 1.0) {
  return layer([&](double x, double y) {
    if (y < fromY * kRuledHeight || y > toY * kRuledHeight) return 0.0f;
    return covered(std::fabs(x - x0 - 0.01 * y), 2.0);
  });
}

TEST(Rulings, TheMarginGoesWithThem) {
  const std::vector<float> ruled = ruling({.turnedDeg = -0.6});
  for (const double passes : {0.85, 0.6}) {
    const auto found =
        findRulings(paperWith({{ruled, light(0.8)}, {marginAt(84.0), light(passes)}, {drawing(), kPen}}).grey, {});
    ASSERT_EQ(found.size(), 2u) << passes;
    EXPECT_TRUE(found[1].runsDown);
    ASSERT_EQ(found[1].lines.size(), 1u);
    for (const Vec2& p : found[1].lines[0].coursePx) EXPECT_NEAR(p.x(), 84.0 + 0.01 * p.y(), 1.5);
    const auto page =
        preparePage(paperWith({{ruled, light(0.8)}, {marginAt(84.0), light(passes)}, {drawing(), kPen}}), {}, {});
    ASSERT_TRUE(page && page->grey);
    const Wrong wrong = wrongInk(inkOf(*page->grey));
    EXPECT_EQ(wrong.beside, 0) << passes;
    EXPECT_LT(wrong.missed, 0.02) << passes;
  }
}

TEST(Rulings, LinesDownThePageThatEndOnItOrLieInTheMiddleAreDrawn) {
  const std::vector<float> ruled = ruling({.turnedDeg = -0.6});
  for (const auto& drawn : {marginAt(84.0, 0.1, 1.0), marginAt(84.0, 0.0, 0.9), marginAt(0.5 * kRuledWidth)})
    EXPECT_EQ(findRulings(paperWith({{ruled, light(0.8)}, {drawn, kPen}, {drawing(), kPen}}).grey, {}).size(), 1u);
}

TEST(Rulings, AreTakenOutWithoutCuttingStrokes) {
  for (const double passes : {0.9, 0.75, 0.6}) {
    for (const double turned : {0.0, 2.5}) {
      const Ruling across{.turnedDeg = turned}, down{.turnedDeg = turned, .runsDown = true};
      const Scan scan = paperWith({{ruling(across), light(passes)}, {ruling(down), light(passes)}, {drawing(), kPen}});
      const auto found = findRulings(scan.grey, {});
      ASSERT_EQ(found.size(), 2u) << passes << " " << turned;
      const Wrong wrong = wrongInk(inkOf(withoutRulings(scan.grey, found, {})));
      EXPECT_LE(wrong.beside, 100) << passes << " " << turned;
      EXPECT_LT(wrong.missed, 0.002) << passes << " " << turned;
    }
  }
}

// Of a copy, whose lines are darker and lighter every few millimetres.
TEST(Rulings, GoWithTheirDarkerPlaces) {
  const Ruling down{.turnedDeg = 0.6, .runsDown = true};
  const std::vector<float> uneven = layer([&](double x, double y) {
    const double line = std::floor(x / down.spacing);
    const double places = std::sin(0.19 * y + 1.7 * line) + 0.6 * std::sin(0.071 * y + 2.3 * line);
    return static_cast<float>(1.0 + 0.5 * places / 1.6) * 0.6f * covered(offLine(down, x, y), down.width);
  });
  const Scan scan = paperWith({{uneven, light(0.45)}, {drawing(), kPen}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 1u);
  const Wrong wrong = wrongInk(inkOf(withoutRulings(scan.grey, found, {})));
  EXPECT_LE(wrong.beside, 150);
  EXPECT_LT(wrong.missed, 0.002);
}

// Pencil along the lines of even ruled paper.
TEST(Rulings, KeepPencilThatRunsAlongThem) {
  const Ruling across{};
  const auto isAlong = [](double x) { return std::fmod(x, 190.0) < 60.0; };
  const std::vector<float> pencil = layer(
      [&](double x, double y) { return isAlong(x) && x > 80.0 ? 0.9f * covered(offLine(across, x, y), 2.6) : 0.0f; });
  const Scan scan = paperWith({{ruling(across), light(0.78)}, {pencil, light(0.5)}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 1u);
  const GreyImage cleaned = withoutRulings(scan.grey, found, {});
  int all = 0, kept = 0;
  for (int y = 40; y < kRuledHeight - 40; ++y) {
    for (int x = 200; x < kRuledWidth - 40; ++x) {
      if (!isAlong(x - 6.0) || !isAlong(x + 6.0) || std::fabs(offLine(across, x + 0.5, y + 0.5)) > 0.5) continue;
      ++all;
      kept += cleaned.level(x, y) < 190.0;
    }
  }
  EXPECT_GT(kept, 0.9 * all);
}

TEST(Rulings, StrokesKeepTheirGreyAcrossThem) {
  const Scan with = paperWith({{ruling({}), light(0.8)}, {drawing(), kPen}}, 0.0);
  const Scan without = paperWith({{drawing(), kPen}}, 0.0);
  const GreyImage cleaned = withoutRulings(with.grey, findRulings(with.grey, {}), {});
  double sum = 0.0;
  for (std::size_t i = 0; i < cleaned.pixels.size(); ++i)
    sum += std::pow((cleaned.pixels[i] - without.grey.pixels[i]) / GreyImage::kGreyUnit, 2);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(cleaned.pixels.size())), 1.0);
}

TEST(Rulings, AGridAsDarkAsTheStrokesIsTakenOut) {
  const Scan scan = paperWith({{ruling({}), kPen}, {ruling({.runsDown = true}), kPen}, {drawing(), kPen}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 2u);
  const Wrong wrong = wrongInk(inkOf(withoutRulings(scan.grey, found, {})));
  EXPECT_LT(wrong.beside, 400);
  EXPECT_LT(wrong.missed, 0.03);
}

// A legend in a grid: what is written in the box is not the grid's, wherever it lies on the course of a line.
TEST(Rulings, WhatIsWrittenInABoxWithoutLinesStays) {
  constexpr double kLeft = 290.0, kRight = 450.0, kTop = 190.0, kBottom = 280.0;
  const auto isInBox = [&](double x, double y) { return x > kLeft && x < kRight && y > kTop && y < kBottom; };
  const auto outside = [&](const Ruling& r) {
    return layer([&](double x, double y) { return isInBox(x, y) ? 0.0f : covered(offLine(r, x, y), r.width); });
  };
  // A bar every 31 px, on the course of every line down the page.
  const Ruling down{.runsDown = true};
  const auto isBar = [&](double x, double y) {
    return isInBox(x, y) && std::fabs(offLine(down, x, y)) < 2.5 && y > kTop + 25.0 && y < kBottom - 25.0;
  };
  const auto bars = layer([&](double x, double y) { return isBar(x, y) ? 1.0f : 0.0f; });
  const Scan scan = paperWith({{outside({}), kPen}, {outside(down), kPen}, {bars, kPen}, {drawing(), kPen}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 2u);
  const BitImage ink = inkOf(withoutRulings(scan.grey, found, {}));
  int all = 0, left = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      if (!isBar(x + 0.5, y + 0.5)) continue;
      ++all;
      left += ink.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(left, 0.9 * all);
  int above = 0;  // of the lines that come to the box
  for (int y = 0; y < static_cast<int>(kTop) - 5; ++y)
    for (int x = 0; x < ink.width; ++x) above += ink.at(x, y) && offDrawing(x + 0.5, y + 0.5) > 5.0 ? 1 : 0;
  EXPECT_LT(above, 100);
}

TEST(Rulings, OfADottedLineAllDotsAreItsOwn) {
  const auto inked = [](const std::string& text) {
    std::vector<char> columns(text.begin(), text.end());
    for (char& c : columns) c = c == '#' ? 1 : 0;
    return columns;
  };
  const auto marked = [](const std::vector<char>& other) {
    std::string text;
    for (const char c : other) text += c != 0 ? 'o' : '.';
    return text;
  };
  EXPECT_EQ(marked(otherInkOnLine(inked("##################.....###.....################"), 8.0)),
            ".......................ooo.....................");
  EXPECT_EQ(marked(otherInkOnLine(inked("##################.###.....################"), 8.0)), std::string(43, '.'));
  EXPECT_EQ(marked(otherInkOnLine(inked("...##....##....##....##....##....##....##"), 8.0)), std::string(41, '.'));
}

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

TEST(Rulings, AreKeptWhenAsked) {
  const Scan scan = paperWith({{ruling({}), light(0.8)}, {drawing(), kPen}});
  PreparationParams params;
  const auto without = preparePage(scan, params, {});
  EXPECT_EQ(without->rulings.size(), 1u);
  EXPECT_FALSE(without->isUntouched());
  params.rulings = RulingUse::Keep;
  EXPECT_TRUE(preparePage(scan, params, {})->isUntouched());
}

TEST(Rulings, NothingButDarkLinesIsTheDrawing) {
  for (const bool isGrid : {false, true}) {
    std::vector<InkLayer> inks = {{ruling({.spacing = 16.0, .width = 2.0}), kPen}};
    if (isGrid) inks.push_back({ruling({.spacing = 16.0, .width = 2.0, .runsDown = true}), kPen});
    const Scan bare = paperWith(inks);
    ASSERT_FALSE(findRulings(bare.grey, {}).empty());
    const auto kept = preparePage(bare, {}, {});
    EXPECT_TRUE(kept->isUntouched()) << isGrid;
    EXPECT_TRUE(kept->rulings.empty());
    ASSERT_EQ(kept->notes.size(), 1u);
    // Something drawn over them: they are the paper's.
    inks.push_back({drawing(), kPen});
    EXPECT_EQ(preparePage(paperWith(inks), {}, {})->rulings.size(), isGrid ? 2u : 1u) << isGrid;
  }
  // Turned, so that many lines cross no more than a corner.
  for (const double angle : {-8.2, 98.2}) {
    Scan turned;
    turned.grey = test::hatchingPage({.angleDeg = angle, .spacingPx = 6.3});
    ASSERT_FALSE(findRulings(turned.grey, {}).empty());
    EXPECT_TRUE(preparePage(turned, {}, {})->rulings.empty()) << angle;
  }
  // An empty sheet of ruled paper holds no drawing.
  EXPECT_EQ(preparePage(paperWith({{ruling({}), light(0.8)}}), {}, {})->rulings.size(), 1u);
}

TEST(Rulings, AreTheSameWithAnyNumberOfThreads) {
  const Scan scan = paperWith({{ruling({.turnedDeg = 2.0}), light(0.8)}, {drawing(), kPen}});
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(withoutRulings(scan.grey, findRulings(scan.grey, one), one),
            withoutRulings(scan.grey, findRulings(scan.grey, four), four));
}

}  // namespace
}  // namespace batten
