// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/image/ruling/find_rulings.h"
#include "core/image/ruling/remove_rulings.h"

namespace batten {
namespace {

// As large as a photograph is when rulings are looked for: strips are wide, and a fan blurs lines within them.
constexpr int kFannedWidth = 1800, kFannedHeight = 1500;

using Field = std::function<double(double u, double v)>;  // u and v run from -1 to 1 over the page

/// Light that passes: 1 on paper, less on lines `width` px wide along which the field is a whole number.
double passing(const Field& field, double x, double y, double width, double line) {
  const auto at = [&](double px, double py) {
    return field(2.0 * px / kFannedWidth - 1.0, 2.0 * py / kFannedHeight - 1.0);
  };
  const double here = at(x, y);
  const double gradient = std::hypot(at(x + 1.0, y) - here, at(x, y + 1.0) - here);
  const double off = std::fabs(here - std::round(here)) / std::max(1e-9, gradient);
  return 1.0 - (1.0 - line) * std::clamp(0.5 * width - off + 0.5, 0.0, 1.0);
}

/// Grainy paper, darker towards its left.
GreyImage photograph(const std::function<double(double x, double y)>& light, double grain = 6.0) {
  GreyImage page(kFannedWidth, kFannedHeight, 0);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, grain);
  for (int y = 0; y < kFannedHeight; ++y) {
    for (int x = 0; x < kFannedWidth; ++x) {
      const double paper = 110.0 + 60.0 * x / kFannedWidth;
      const double level = std::clamp(paper * light(x + 0.5, y + 0.5) + noise(random), 0.0, 255.0);
      page.row(y)[x] = static_cast<std::uint16_t>(level * GreyImage::kGreyUnit);
    }
  }
  return page;
}

constexpr double kLinePasses = 0.6;
constexpr double kLines = 12.0;  // from the middle of the page to its border

/// In perspective: the lines are a fan whose slopes differ by a tenth, as on pages held in one hand.
double fanned(double u, double v) { return kLines * v / (1.0 + 0.06 * u); }

/// The lines run apart, and together again where the paper curls.
double curled(double u, double v) {
  const double bend = u < 0.4 ? 0.06 * u : 0.024 + 0.06 * (u - 0.4) - 0.12 * (u - 0.4) * (u - 0.4);
  return kLines * v / (1.0 + bend);
}

/// How many px the courses lie off the lines of the field, at most, within the page.
double mostOff(const RulingFamily& family, const Field& field) {
  double most = 0.0;
  for (const RulingLine& line : family.lines) {
    for (const Vec2& p : line.coursePx) {
      if (p.y() < 0.0 || p.y() >= kFannedHeight || p.x() < 0.0 || p.x() > kFannedWidth) continue;
      const double here = field(2.0 * p.x() / kFannedWidth - 1.0, 2.0 * p.y() / kFannedHeight - 1.0);
      most = std::max(most, std::fabs(here - std::round(here)) * family.spacingPx);
    }
  }
  return most;
}

TEST(PhotographedRulings, AFanAndACurlAreFollowed) {
  const struct {
    const char* name;
    Field field;
  } cases[] = {{"a fan", fanned}, {"a curl", curled}};
  for (const auto& c : cases) {
    const GreyImage page = photograph([&](double x, double y) { return passing(c.field, x, y, 3.0, kLinePasses); });
    const auto found = findRulings(page, {});
    ASSERT_EQ(found.size(), 1u) << c.name;
    EXPECT_FALSE(found[0].runsDown) << c.name;
    EXPECT_NEAR(static_cast<double>(found[0].lines.size()), 2.0 * kLines, 4.0) << c.name;
    // The eraser looks for a line further than that from its course.
    EXPECT_LT(mostOff(found[0], c.field), 0.15 * found[0].spacingPx) << c.name;
  }
}

/// The next page lies beside it, bright, with other lines.
TEST(PhotographedRulings, TheNextPageDoesNotSpoilThem) {
  const double border = 0.1 * kFannedWidth;
  const Field next = [](double u, double v) { return 9.3 * v + 2.0 * u; };
  const GreyImage page = photograph([&](double x, double y) {
    if (x < border) return 1.4 * passing(next, x, y, 3.0, 0.8);
    return std::fabs(x - border) < 3.0 ? 0.3 : passing(fanned, x, y, 3.0, kLinePasses);
  });
  const auto found = findRulings(page, {});
  ASSERT_FALSE(found.empty());
  EXPECT_FALSE(found[0].runsDown);
  EXPECT_GE(found[0].lines.size(), 20u);
}

TEST(PhotographedRulings, WhatIsDrawnIsNone) {
  const auto isWithin = [](double x, double y, double x0, double y0, double x1, double y1) {
    return x > x0 * kFannedWidth && x < x1 * kFannedWidth && y > y0 * kFannedHeight && y < y1 * kFannedHeight;
  };
  const struct {
    const char* name;
    std::function<double(double, double)> light;
  } cases[] = {
      {"fanned hatching",
       [&](double x, double y) {
         return isWithin(x, y, 0.2, 0.2, 0.8, 0.6) ? passing(fanned, x, y, 3.0, kLinePasses) : 1.0;
       }},
      {"fanned hatching on half the page",
       [&](double x, double y) {
         return isWithin(x, y, 0.02, 0.02, 0.5, 0.98) ? passing(fanned, x, y, 3.0, kLinePasses) : 1.0;
       }},
      {"siding drawn by hand, each board otherwise",
       [&](double x, double y) {
         const double board = std::floor(fanned(2.0 * x / kFannedWidth - 1.0, 2.0 * y / kFannedHeight - 1.0) + 0.5);
         const double sway = 5.0 * std::sin(x / 210.0 + 1.7 * board) + 4.0 * std::sin(2.9 * board);
         return passing(fanned, x, y + sway, 3.0, kLinePasses);
       }},
      {"staves",
       [&](double x, double y) {
         const double stave = std::fmod(y, 300.0);
         return stave > 90.0 && stave < 190.0 && x > 100.0 && x < 1700.0 && std::fmod(stave, 20.0) < 3.0 ? 0.4 : 1.0;
       }},
      {"bricks", [&](double x, double y) {
         const int row = static_cast<int>(y / 60.0);
         const double joint = std::fmod(x + 70.0 * (row % 2), 140.0);
         return isWithin(x, y, 0.1, 0.3, 0.9, 0.75) && (std::fmod(y, 60.0) < 3.0 || joint < 3.0) ? 0.4 : 1.0;
       }}};
  for (const auto& c : cases) EXPECT_TRUE(findRulings(photograph(c.light), {}).empty()) << c.name;
}

TEST(PhotographedRulings, AreTheSameWithAnyNumberOfThreads) {
  const GreyImage page = photograph([](double x, double y) { return passing(curled, x, y, 3.0, kLinePasses); });
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(withoutRulings(page, findRulings(page, one), one), withoutRulings(page, findRulings(page, four), four));
}

}  // namespace
}  // namespace batten
