// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes that run side by side, touch and part again keep to their sides: against bundles of lines that are known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/contour/centreline/centreline.h"
#include "core/contour/centreline/junction/end_rows.h"
#include "tests/support/angles.h"
#include "tests/support/dense_page.h"
#include "tests/support/ink_page.h"

namespace batten {
namespace {

using Pairs = std::vector<std::pair<int, int>>;
using Lines = std::vector<std::vector<Vec2>>;

MeetingEnd endAt(double x, double y, double outDeg, double radius) {
  return {0, {x, y}, {std::cos(outDeg * test::kDeg), std::sin(outDeg * test::kDeg)}, radius};
}

Pairs pairsInRows(const std::vector<MeetingEnd>& ends, double narrowestPx) {
  EXPECT_TRUE(EndRows::areIn(ends));
  PairingScale scale{9.0, 2.3, 40.0};
  scale.areInRows = true;
  scale.narrowestPx = narrowestPx;
  return pairEnds(ends, scale);
}

TEST(EndRows, TwoOrMoreFaceTwoOrMore) {
  const MeetingEnd left = endAt(0, 0, 180, 2), right = endAt(9, 0, 0, 2), up = endAt(4, 4, 90, 2);
  EXPECT_TRUE(EndRows::areIn(std::vector{left, left, right, right}));
  EXPECT_TRUE(EndRows::areIn(std::vector{left, right, left, right, right}));
  EXPECT_FALSE(EndRows::areIn(std::vector{left, right, right, right}));
  EXPECT_FALSE(EndRows::areIn(std::vector{left, left, right, right, up}));
  EXPECT_FALSE(EndRows::areIn(std::vector{left, left, right}));
  EXPECT_FALSE(EndRows::areIn({}));
}

// Of three lines side by side the middle one touches now the upper, now the lower: the widths change places.
TEST(EndRows, AStrokeThatGoesFromOneNeighbourToTheOtherMakesNoCrossing) {
  EXPECT_EQ(pairsInRows({endAt(728, 557, -86, 3.5), endAt(721, 558, -95, 1.5), endAt(730, 570, 85, 1.5),
                         endAt(724, 572, 98, 2.5)},
                        3.0),
            Pairs({{0, 2}, {1, 3}}));
  EXPECT_EQ(pairsInRows({endAt(438, 665, -172, 1.5), endAt(438, 672, -175, 3.5), endAt(457, 666, 0, 3.5),
                         endAt(456, 675, 4, 1.5)},
                        0.9),
            Pairs({{0, 2}, {1, 3}}));
}

// Skeletons lean together where ink becomes common, as if they crossed there.
TEST(EndRows, InInkAsWideAsAllTogetherNoneCrosses) {
  const std::vector<MeetingEnd> ends = {endAt(124.5, 610.4, -149, 0.9), endAt(122.1, 615.5, -179, 2.3),
                                        endAt(147.4, 620.5, 7, 3.1), endAt(144.6, 625.9, 33, 1.5)};
  EXPECT_EQ(pairsInRows(ends, 4.5), Pairs({{0, 2}, {1, 3}}));
  EXPECT_EQ(pairsInRows(ends, 3.2), Pairs({{0, 3}, {1, 2}})) << "one lies on the other there";
}

// From 0 to 1 and level at both ends.
double eased(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

constexpr int kBundleAcross = 700, kBundleDown = 240;
constexpr double kMiddle = 350.0;

// Three lines, of which the middle one runs on the lower one's side, then for `touchPx` between both, touching, then
// on the upper one's side. `deg`: by which the outer ones come in and part.
Lines exchange(double widthPx, double touchPx, double deg) {
  const double apart = 2.5 * widthPx, rise = std::tan(deg * test::kDeg);
  const double ramp = std::max(4.0 * widthPx, 1.5 * apart / rise), half = 0.5 * touchPx;
  Lines lines(3);
  for (double x = 60.0; x <= kBundleAcross - 60.0; x += 1.0) {
    const double before = eased((kMiddle - half - x) / ramp), after = eased((x - kMiddle - half) / ramp);
    lines[0].emplace_back(x, 120.0 - 0.9 * widthPx - apart * before);
    lines[1].emplace_back(x, 120.0);
    lines[2].emplace_back(x, 120.0 + 0.9 * widthPx + apart * after);
  }
  const Vec2 middle(kMiddle, 120.0), along(std::cos(7.0 * test::kDeg), std::sin(7.0 * test::kDeg));
  for (auto& line : lines)
    for (Vec2& p : line) {
      const Vec2 d = p - middle;
      p = middle + d.x() * along + d.y() * Vec2(-along.y(), along.x());
    }
  return lines;
}

// Three lines that meet tangentially: bows that touch one another at one place.
Lines bows(double widthPx, double deg) {
  const double bend = std::tan(deg * test::kDeg) / 200.0;
  Lines lines(3);
  for (double x = -200.0; x <= 200.0; x += 1.0) {
    lines[0].emplace_back(kMiddle + x, 120.0 - 0.95 * widthPx - 0.5 * bend * x * x);
    lines[1].emplace_back(kMiddle + x, 120.0 + 0.03 * x);
    lines[2].emplace_back(kMiddle + x, 120.0 + 0.95 * widthPx + 0.5 * bend * x * x);
  }
  return lines;
}

Lines foundOf(const Lines& lines, double widthPx, std::uint32_t seed) {
  const Scan scan =
      test::scanOfLines(test::coverageOf(lines, widthPx, kBundleAcross, kBundleDown), kBundleAcross, kBundleDown, seed);
  BitImage ink(kBundleAcross, kBundleDown);
  for (int y = 0; y < kBundleDown; ++y)
    for (int x = 0; x < kBundleAcross; ++x) ink.set(x, y, scan.grey.level(x, y) < 132.0);
  const auto set = centrelines(ink, scan.grey, {}, {});
  EXPECT_TRUE(set);
  Lines found;
  if (set) {
    for (const Contour& c : set->contours) found.push_back(positionsOf(c.points));
  }
  return found;
}

// How many found lines lie on the upper line here, on the lower one there.
int hopsOf(const Lines& found, const Lines& lines, double widthPx) {
  constexpr double kOnWidths = 0.2;  // the middle of two strokes side by side lies farther from either
  const auto isOn = [&](const std::vector<Vec2>& line, const Vec2& p) {
    return std::ranges::any_of(line, [&](const Vec2& q) { return (p - q).norm() < kOnWidths * widthPx + 0.3; });
  };
  return static_cast<int>(std::ranges::count_if(found, [&](const std::vector<Vec2>& f) {
    return std::ranges::any_of(f, [&](const Vec2& p) { return isOn(lines[0], p); }) &&
           std::ranges::any_of(f, [&](const Vec2& p) { return isOn(lines[2], p); });
  }));
}

// Paired without rows, and across ink however wide it is, 22 lines of these 36 pages hop.
TEST(EndRows, LinesKeepToTheirSideOfABundle) {
  int hops = 0;
  std::uint32_t seed = 1;
  for (const double widthPx : {2.6, 4.0, 8.0}) {
    for (const double touch : {5.0, 10.0, 20.0}) {
      for (const double deg : {3.0, 6.0, 10.0}) {
        const Lines lines = exchange(widthPx, touch * widthPx, deg);
        const Lines traced = foundOf(lines, widthPx, seed++);
        EXPECT_GE(traced.size() + 1, lines.size()) << "one line in place of two at the most";
        const int found = hopsOf(traced, lines, widthPx);
        if (widthPx > 3.0) {
          EXPECT_EQ(found, 0) << widthPx << " px, touching for " << touch << " widths, " << deg;
        }
        hops += found;
      }
    }
    for (const double deg : {4.0, 8.0, 14.0}) {
      const Lines lines = bows(widthPx, deg);
      hops += hopsOf(foundOf(lines, widthPx, seed++), lines, widthPx);
    }
  }
  EXPECT_LE(hops, 3);
}

}  // namespace
}  // namespace batten
