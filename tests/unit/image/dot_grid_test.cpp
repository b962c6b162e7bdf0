// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/image/page_preparation.h"

namespace batten {
namespace {

constexpr int kWidth = 760, kHeight = 900;
constexpr double kPaper = 235.0, kInk = 40.0, kDot = 150.0;

double offRing(double x, double y) { return std::fabs(std::hypot(x - 380.0, y - 430.0) - 190.0); }

/// Paper with grain, dots at the places given and a ring.
Scan pageWith(const std::vector<Vec2>& dots, double diameter, bool isDrawnOn = true) {
  Scan scan;
  scan.grey = GreyImage(kWidth, kHeight);
  std::vector<double> covered(std::size_t{kWidth} * kHeight, 0.0);
  for (const Vec2& at : dots) {
    const int reach = static_cast<int>(diameter) + 1;
    for (int y = std::max(0, static_cast<int>(at.y()) - reach);
         y <= std::min(kHeight - 1, static_cast<int>(at.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(at.x()) - reach);
           x <= std::min(kWidth - 1, static_cast<int>(at.x()) + reach); ++x) {
        const double away = std::hypot(x + 0.5 - at.x(), y + 0.5 - at.y());
        covered[std::size_t{kWidth} * y + x] += std::clamp(0.5 * diameter + 0.5 - away, 0.0, 1.0);
      }
    }
  }
  std::mt19937 random(5);
  std::normal_distribution<double> grain(0.0, 1.5);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double dotted = std::lerp(kPaper, kDot, std::min(1.0, covered[std::size_t{kWidth} * y + x]));
      const double ink = isDrawnOn ? std::clamp(3.0 - offRing(x + 0.5, y + 0.5), 0.0, 1.0) : 0.0;
      const double level = std::lerp(dotted, kInk, ink) + grain(random);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  }
  return scan;
}

/// Dots at a distance of 30 px, where `placed` takes them; on the page only.
std::vector<Vec2> lattice(const std::function<Vec2(double, double)>& placed) {
  constexpr double kSpacing = 30.0;
  std::vector<Vec2> dots;
  for (int j = -40; j <= 40; ++j) {
    for (int i = -40; i <= 40; ++i) {
      const Vec2 at = placed(kSpacing * i, kSpacing * j) + Vec2(0.5 * kWidth, 0.5 * kHeight);
      if (at.x() > 10.0 && at.y() > 10.0 && at.x() < kWidth - 10.0 && at.y() < kHeight - 10.0) dots.push_back(at);
    }
  }
  return dots;
}

std::vector<Vec2> turned() {
  return lattice([](double u, double v) { return Vec2(0.996 * u - 0.087 * v, 0.087 * u + 0.996 * v); });
}

int darkPixels(const GreyImage& page, bool onRing) {
  int dark = 0;
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x)
      dark += page.level(x, y) < 215.0 && (offRing(x + 0.5, y + 0.5) < 11.0) == onRing ? 1 : 0;
  }
  return dark;
}

void expectRemoved(const std::vector<Vec2>& dots) {
  const auto page = preparePage(pageWith(dots, 4.5), {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_GT(std::ssize(page->dots), 0.85 * static_cast<double>(dots.size()));
  EXPECT_LE(page->dots.size(), dots.size());
  EXPECT_EQ(darkPixels(*page->grey, false), 0);
  const int ring = darkPixels(pageWith({}, 4.5).grey, true);
  EXPECT_GE(darkPixels(*page->grey, true), ring) << "the drawing is whole";
}

TEST(DotGrid, IsRemovedAndTheDrawingStays) {
  expectRemoved(turned());
  const Scan scan = pageWith(turned(), 4.5);
  const auto page = preparePage(scan, {}, {});
  ASSERT_EQ(page->notes.size(), 1u);
  EXPECT_EQ(page->notes[0], std::to_string(page->dots.size()) +
                                " dots of dotted paper were removed; paper.rulings=keep restores them.");
  PreparationParams keep;
  keep.rulings = RulingUse::Keep;
  EXPECT_TRUE(preparePage(scan, keep, {})->isUntouched());
}

TEST(DotGrid, IsRemovedWhereItIsSeenInPerspective) {
  expectRemoved(lattice([](double u, double v) {
    const double nearer = 1.0 + 0.0004 * v + 0.0002 * u;
    return Vec2(u / nearer, 0.8 * v / nearer);
  }));
}

TEST(DotGrid, IsRemovedWhereThePageCurls) {
  expectRemoved(lattice([](double u, double v) { return Vec2(u, v + 25.0 * std::cos(u / 200.0)); }));
}

TEST(DotGrid, IsNoneThatAHandHasPlaced) {
  std::mt19937 random(3);
  std::normal_distribution<double> off(0.0, 2.4);
  const auto dots = lattice([&](double u, double v) { return Vec2(u + off(random), v + off(random)); });
  EXPECT_TRUE(preparePage(pageWith(dots, 4.5), {}, {})->isUntouched());
}

TEST(DotGrid, IsNoStippling) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(10.0, kWidth - 10.0), y(10.0, kHeight - 10.0);
  std::vector<Vec2> dots;
  for (int k = 0; k < 1500; ++k) dots.emplace_back(x(random), y(random));
  EXPECT_TRUE(preparePage(pageWith(dots, 4.5), {}, {})->isUntouched());
}

TEST(DotGrid, IsNoPatternInAPartOfTheDrawing) {
  auto dots = turned();
  std::erase_if(dots, [](const Vec2& at) { return std::hypot(at.x() - 380.0, at.y() - 430.0) > 180.0; });
  ASSERT_GT(dots.size(), 80u);
  EXPECT_TRUE(preparePage(pageWith(dots, 4.5), {}, {})->isUntouched());
}

TEST(DotGrid, IsNoPatternOfLargeDots) { EXPECT_TRUE(preparePage(pageWith(turned(), 11.0), {}, {})->isUntouched()); }

TEST(DotGrid, IsNoneOfRowsFarApart) {
  // Dotted lines: the dots of each row begin elsewhere.
  const auto dots = lattice([](double u, double v) { return Vec2(0.5 * u + 11.0 * std::sin(v), 1.5 * v); });
  EXPECT_TRUE(preparePage(pageWith(dots, 4.5), {}, {})->isUntouched());
}

TEST(DotGrid, IsTheDrawingWhereNothingElseIsOnThePage) {
  EXPECT_TRUE(preparePage(pageWith(turned(), 4.5, false), {}, {})->isUntouched());
}

TEST(DotGrid, LeavesAMarkThatIsLargerThanItsDots) {
  const auto dots = turned();
  Scan scan = pageWith(dots, 4.5);
  const Vec2 at = dots[dots.size() / 2 + 3];
  for (int y = -4; y <= 4; ++y) {
    for (int x = -4; x <= 4; ++x) {
      if (std::hypot(x, y) > 4.5) continue;
      scan.grey.row(static_cast<int>(at.y()) + y)[static_cast<int>(at.x()) + x] =
          static_cast<std::uint16_t>(kInk * GreyImage::kGreyUnit);
    }
  }
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_LT(page->grey->level(static_cast<int>(at.x()), static_cast<int>(at.y())), kInk + 1.0);
}

}  // namespace
}  // namespace batten
