// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/find_rulings.h"
#include "core/image/ruling/line_runs.h"
#include "core/image/ruling/remove_rulings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/image/page_preparation.h"
#include "tests/support/hatching_page.h"
#include "tests/unit/image/ruled_page.h"

namespace batten {
namespace {

using test::covered;
using test::drawing;
using test::InkLayer;
using test::inkOf;
using test::kPen;
using test::kRuledHeight;
using test::kRuledWidth;
using test::layer;
using test::light;
using test::offDrawing;
using test::offLine;
using test::paperWith;
using test::Ruling;
using test::ruling;
using test::Wrong;
using test::wrongInk;

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

// A photograph shows more than the sheet, and a pencil runs along a part of the margin.
TEST(Rulings, AMarginIsFollowedBesideStrokesToTheEndOfItsSheet) {
  constexpr double kTop = 0.12, kBottom = 0.93;
  const auto ofSheet = [&](std::vector<float> ink) {
    for (int y = 0; y < kRuledHeight; ++y) {
      if (y > kTop * kRuledHeight && y < kBottom * kRuledHeight) continue;
      std::fill_n(ink.begin() + std::ptrdiff_t{y} * kRuledWidth, kRuledWidth, 0.0f);
    }
    return ink;
  };
  const std::vector<float> pencil =
      layer([](double x, double y) { return y > 250.0 && y < 420.0 ? covered(x - 87.5 - 0.03 * y, 3.0) : 0.0f; });
  const auto found = findRulings(paperWith({{ofSheet(ruling({.turnedDeg = -0.6})), light(0.8)},
                                            {layer([&](double x, double y) {
                                               const bool isOnSheet = y > (kTop - 0.05) * kRuledHeight &&
                                                                      y < (kBottom + 0.05) * kRuledHeight;
                                               return isOnSheet ? covered(x - 84.0 - 0.035 * y, 2.0) : 0.0f;
                                             }),
                                             light(0.6)},
                                            {pencil, light(0.4)},
                                            {drawing(), kPen}})
                                     .grey,
                                 {});
  ASSERT_EQ(found.size(), 2u);
  ASSERT_EQ(found[1].lines.size(), 1u);
  for (const Vec2& p : found[1].lines[0].coursePx) {
    if (p.y() < 0.1 * kRuledHeight || p.y() > 0.95 * kRuledHeight) continue;
    EXPECT_NEAR(p.x(), 84.0 + 0.035 * p.y(), 2.5);
  }
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

// A box drawn with a ruler on lines of a grid, and a pixel beside them.
TEST(Rulings, KeepABoxThatIsDrawnOnAGrid) {
  const Ruling across{.width = 2.4}, down{.width = 2.4, .runsDown = true};
  // Of lines 2 and 20 across, and 3 and 17 down, from the middle line of each.
  const double x0 = 380.0 - 7.0 * 31.0, x1 = 380.0 + 8.0 * 31.0, y0 = 450.0 - 11.0 * 31.0, y1 = 450.0 + 10.0 * 31.0;
  const auto offBox = [&](double x, double y) {
    const double u = std::max(x0 - x, x - x1), v = std::max(y0 - y, y - y1);
    return std::fabs(std::max(u, v));
  };
  const auto box = layer([&](double x, double y) { return covered(offBox(x - 1.0, y - 1.0), 1.8); });
  const Scan scan = paperWith({{ruling(across), light(0.93)}, {ruling(down), light(0.93)}, {box, light(0.55)}});
  const auto found = findRulings(scan.grey, {});
  ASSERT_EQ(found.size(), 2u);
  const GreyImage cleaned = withoutRulings(scan.grey, found, {});
  int all = 0, kept = 0;
  for (int y = 5; y < kRuledHeight - 5; ++y) {
    for (int x = 5; x < kRuledWidth - 5; ++x) {
      if (offBox(x - 0.5, y - 0.5) > 0.6) continue;
      ++all;
      kept += cleaned.level(x, y) < 180.0;
    }
  }
  EXPECT_GT(kept, 0.95 * all);
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
