// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/image/page_preparation.h"
#include "tests/support/photo_page.h"

namespace batten {
namespace {

constexpr int kBoundWidth = 640, kBoundHeight = 900;

bool isRingDrawn(double x, double y) { return std::fabs(std::hypot(x - 330.0, y - 420.0) - 140.0) < 2.0; }

Scan boundPage(const std::function<bool(double, double)>& isHole) {
  Scan scan;
  scan.grey = GreyImage(kBoundWidth, kBoundHeight);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int y = 0; y < kBoundHeight; ++y) {
    for (int x = 0; x < kBoundWidth; ++x) {
      const double paper = 240.0 - 0.02 * y;
      const bool isInk = isRingDrawn(x + 0.5, y + 0.5);
      const double level = (isInk ? 60.0 : isHole(x + 0.5, y + 0.5) ? 70.0 : paper) + noise(random);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  }
  return scan;
}

/// Holes of 9 x 13 px, every 30 px down the page; from y = 600 on the page slips off them to the left.
bool isBindingHole(double x, double y) {
  const double middle = 14.0 - std::max(0.0, (y - 600.0) / 30.0);
  return y > 20.0 && y < 885.0 && std::fabs(x - middle) < 4.5 && std::fabs(std::remainder(y - 40.0, 30.0)) < 6.5;
}

int darkPixelsOf(const GreyImage& page, int x0, int x1) {
  int dark = 0;
  for (int y = 0; y < page.height; ++y) {
    for (int x = x0; x < x1; ++x) dark += page.level(x, y) < 170.0 ? 1 : 0;
  }
  return dark;
}

TEST(BindingHoles, ArePaintedOverAndTheDrawingStays) {
  const Scan scan = boundPage(isBindingHole);
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_EQ(darkPixelsOf(*page->grey, 0, 40), 0);
  EXPECT_EQ(darkPixelsOf(*page->grey, 40, kBoundWidth), darkPixelsOf(scan.grey, 40, kBoundWidth));
  EXPECT_EQ(page->bindingHoles, 29);
  ASSERT_EQ(page->notes.size(), 1u);
  EXPECT_EQ(page->notes[0], "A row of 29 binding holes was removed; paper.sheet=off keeps it.");
  PreparationParams off;
  off.sheet = SheetUse::Off;
  EXPECT_TRUE(preparePage(scan, off, {})->isUntouched());
}

// The sheet ends in the picture, askew and with a shadow, and its wires go on beyond.
TEST(BindingHoles, ArePaintedOverWithTheEdgeThatJoinsThem) {
  const auto edge = [](double y) { return 6.0 + 0.006 * y; };
  const auto isWire = [&](double x, double y) {
    return x < edge(y) + 16.0 && std::fabs(std::remainder(y - 40.0, 30.0)) < 4.5;
  };
  const Scan scan = boundPage([&](double x, double y) { return isWire(x, y) || std::fabs(x - edge(y)) < 2.0; });
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_EQ(page->bindingHoles, 30);
  EXPECT_EQ(darkPixelsOf(*page->grey, 0, 60), 0);
  EXPECT_EQ(darkPixelsOf(*page->grey, 60, kBoundWidth), darkPixelsOf(scan.grey, 60, kBoundWidth));
}

/// A filled shape that lies in the margin beside the holes from y = 300 on.
bool isShapeBesideHoles(double x, double y, double until) { return x > 22.0 && x < 90.0 && y > 300.0 && y < until; }

TEST(BindingHoles, ArePaintedOverWhereTheDrawingReachesThemInPlaces) {
  const Scan scan =
      boundPage([](double x, double y) { return isBindingHole(x, y) || isShapeBesideHoles(x, y, 390.0); });
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_EQ(page->bindingHoles, 29);
  EXPECT_EQ(darkPixelsOf(*page->grey, 24, kBoundWidth), darkPixelsOf(scan.grey, 24, kBoundWidth)) << "the drawing";
}

TEST(BindingHoles, AreNoMarksWithOthersBesideManyOfThem) {
  const auto page = preparePage(
      boundPage([](double x, double y) { return isBindingHole(x, y) || isShapeBesideHoles(x, y, 540.0); }), {}, {});
  EXPECT_EQ(page->bindingHoles, 0);
}

TEST(BindingHoles, AreAtOneSideOfThePageOnly) {
  const Scan frame = boundPage([](double x, double y) { return isBindingHole(x, y) || isBindingHole(640.0 - x, y); });
  EXPECT_TRUE(preparePage(frame, {}, {})->isUntouched());
}

TEST(BindingHoles, AreNoUnevenMarksAndNoneFarFromTheSide) {
  const Scan inside = boundPage([](double x, double y) { return isBindingHole(x - 100.0, y); });
  EXPECT_TRUE(preparePage(inside, {}, {})->isUntouched()) << "far from the side";
  const Scan letters = boundPage([](double x, double y) {
    const int row = static_cast<int>(y / 24.0);
    return y < 880.0 && std::fabs(x - 20.0) < 5.0 &&
           std::fabs(y - 24.0 * row - 6.0 - row * row % 11) < 3.0 + row * 7 % 5;
  });
  EXPECT_TRUE(preparePage(letters, {}, {})->isUntouched()) << "letters";
}

/// Letters of 4 to 6 by 7 px, in words and ragged lines over the upper half of the page.
bool isLetter(double x, double y) {
  constexpr double kPitch = 8.0, kLine = 12.0, kFirst = 4.0, kLast = 500.0;
  const int line = static_cast<int>(y / kLine);
  const double first = 8.0 + line * 37 % 40, last = kBoundWidth - 8.0 - line * 53 % 60;
  if (y < kFirst || y > kLast || x < first || x > last) return false;
  const int letter = static_cast<int>((x - first) / kPitch);
  const double right = x - first - kPitch * letter, down = y - kLine * line;
  return letter % 6 != 5 && right < 4.0 + (letter * 7 + line) % 3 && down > 2.0 && down < 9.0;
}

TEST(BindingHoles, AreNoLettersOfAPageOfText) {
  const Scan text = boundPage(isLetter);
  const auto page = preparePage(text, {}, {});
  ASSERT_TRUE(page);
  EXPECT_EQ(page->bindingHoles, 0);
  EXPECT_FALSE(page->sheet);
}

/// A sheet torn off its pad on a table, askew, with a ring drawn upon it.
test::PhotoCamera askewSheet() {
  return {{.widthMm = 297.0, .heightMm = 210.0, .rollDeg = 5.0, .fill = 0.85}, 900, 700};
}
bool isRingOnSheet(const Vec2& mm) { return std::fabs(std::hypot(mm.x() - 150.0, mm.y() - 110.0) - 50.0) < 1.5; }
Scan askewPhoto(const std::function<bool(const Vec2&)>& isHole) {
  return renderPhoto(askewSheet(), [&](const Vec2& mm) { return isRingOnSheet(mm) || isHole(mm) ? 0.8 : 0.0; });
}
/// Holes of 6 mm a side, every 12 mm along the upper edge.
bool isHoleOfSheet(const Vec2& mm) {
  return std::fabs(mm.y() - 12.0) < 3.0 && std::fabs(std::remainder(mm.x() - 10.5, 12.0)) < 3.0;
}
int darkOnSheet(const GreyImage& page, double fromMm, double toMm) {
  const test::PhotoCamera camera = askewSheet();
  int dark = 0;
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const Vec2 mm = camera.toSheet({x + 0.5, y + 0.5});
      if (mm.x() > 5.0 && mm.x() < 292.0 && mm.y() > fromMm && mm.y() < toMm) dark += page.level(x, y) < 150.0 ? 1 : 0;
    }
  }
  return dark;
}

TEST(BindingHoles, AreFoundAlongTheEdgeOfASheetThatLiesAskew) {
  const Scan scan = askewPhoto(isHoleOfSheet);
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->sheet && page->grey);
  EXPECT_EQ(page->bindingHoles, 24);
  EXPECT_EQ(darkOnSheet(*page->grey, 6.0, 30.0), 0);
  EXPECT_EQ(darkOnSheet(*page->grey, 30.0, 200.0), darkOnSheet(scan.grey, 30.0, 200.0));
}

// A line that was drawn into two of the holes stays, up to them.
TEST(BindingHoles, ThatALineIsJoinedToArePaintedOver) {
  const auto isLine = [](const Vec2& mm) { return std::fabs(mm.x() - 130.5) < 1.2 && mm.y() > 12.0 && mm.y() < 60.0; };
  const Scan scan = askewPhoto([&](const Vec2& mm) { return isHoleOfSheet(mm) || isLine(mm); });
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_EQ(page->bindingHoles, 24);
  EXPECT_EQ(darkOnSheet(*page->grey, 6.0, 14.0), 0);
  EXPECT_EQ(darkOnSheet(*page->grey, 18.0, 200.0), darkOnSheet(scan.grey, 18.0, 200.0));
}

// What is drawn along the edge of the sheet: marks that are neither equal nor even, a row far from the edge, two rows.
TEST(BindingHoles, AreNoMarksDrawnAlongTheEdgeOfASheet) {
  const Scan letters = askewPhoto([](const Vec2& mm) {
    const int place = static_cast<int>(mm.x() / 12.0);
    return std::fabs(mm.y() - 12.0) < 3.0 && mm.x() < 280.0 &&
           std::fabs(mm.x() - 12.0 * place - 5.0 - place * 5 % 4) < 1.5 + place * 7 % 3;
  });
  EXPECT_EQ(preparePage(letters, {}, {})->bindingHoles, 0) << "letters";
  const Scan inside = askewPhoto([](const Vec2& mm) { return isHoleOfSheet(mm - Vec2(0.0, 24.0)); });
  EXPECT_EQ(preparePage(inside, {}, {})->bindingHoles, 0) << "far from the edge";
  const Scan rows = askewPhoto([](const Vec2& mm) { return isHoleOfSheet(mm) || isHoleOfSheet(mm - Vec2(6.0, 9.0)); });
  EXPECT_EQ(preparePage(rows, {}, {})->bindingHoles, 0) << "a border of two rows";
}

}  // namespace
}  // namespace batten
