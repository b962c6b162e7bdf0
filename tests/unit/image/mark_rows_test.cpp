// SPDX-License-Identifier: GPL-3.0-or-later
// Dashes and dots of broken lines are told from dirt by their rows.
#include "core/image/bits/mark_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/bits/bit_steps.h"

namespace batten {
namespace {

constexpr int kSide = 320;
const Vec2 kMiddle(160.0, 160.0);

/// A rectangle `length` x `width` around a place, turned by an angle.
void drawDash(BitImage& image, const Vec2& at, double angle, double length, double width) {
  const Vec2 u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec2 off = Vec2(x + 0.5, y + 0.5) - at;
      if (std::abs(off.dot(u)) <= 0.5 * length && std::abs(off.dot(v)) <= 0.5 * width) image.set(x, y, true);
    }
  }
}

/// Dashes 9 px long, 3 px wide and 15 px apart, a line through the middle of the page.
BitImage dashedLine(double angle, int count) {
  BitImage marks(kSide, kSide);
  const Vec2 u(std::cos(angle), std::sin(angle));
  for (int i = 0; i < count; ++i) drawDash(marks, kMiddle + 15.0 * (i - 0.5 * (count - 1)) * u, angle, 9.0, 3.0);
  return marks;
}

TEST(MarkRows, ADashedLineStaysWhole) {
  for (int degrees = 0; degrees < 180; degrees += 15) {
    const BitImage marks = dashedLine(degrees * std::numbers::pi / 180.0, 7);
    EXPECT_EQ(marksInRows(marks, marks, {}), marks) << degrees << " degrees";
  }
}

// As a hand draws it with a marker: the row bends, its dots and the spaces between them are uneven.
TEST(MarkRows, ADottedRowDrawnByHandStaysWholeAndDirtBesideItGoes) {
  const std::vector<double> sizes = {3.0, 3.5, 4.2, 3.0, 4.6, 2.4, 4.0, 4.0, 3.8, 4.0, 3.7, 3.4};
  const std::vector<double> steps = {16.0, 21.0, 14.0, 20.0, 14.0, 15.0, 25.0, 17.0, 18.0, 19.0, 14.0};
  const std::vector<double> turns = {0.0, 0.25, -0.3, 0.2, 0.05, 0.3, -0.2, 0.1, 0.15, -0.1, 0.1};
  BitImage row(kSide, kSide);
  Vec2 at(60.0, 150.0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    drawDash(row, at, 0.0, 1.2 * sizes[i], sizes[i]);
    if (i < steps.size()) at += steps[i] * Vec2(std::cos(turns[i]), std::sin(turns[i]));
  }
  BitImage dirt(kSide, kSide);
  for (const Vec2& speck : {Vec2(100.0, 128.0), Vec2(113.0, 119.0), Vec2(160.0, 176.0), Vec2(171.0, 192.0)})
    drawDash(dirt, speck, 0.0, 4.0, 4.0);
  const BitImage all = either(row, dirt);
  EXPECT_EQ(marksInRows(all, all, {}), row);
}

TEST(MarkRows, TwoDashesAreNoRow) {
  const BitImage marks = dashedLine(0.4, 2);
  EXPECT_EQ(marksInRows(marks, marks, {}).count(), 0);
}

TEST(MarkRows, ADotBetweenTheEndsOfTwoLinesIsPartOfThem) {
  BitImage marks(kSide, kSide), lines(kSide, kSide);
  drawDash(marks, kMiddle, 0.0, 4.0, 4.0);
  drawDash(lines, kMiddle - Vec2(60.0, 0.0), 0.0, 100.0, 4.0);
  drawDash(lines, kMiddle + Vec2(60.0, 0.0), 0.0, 100.0, 4.0);
  EXPECT_EQ(marksInRows(marks, either(lines, marks), {}), marks);
}

TEST(MarkRows, ADotBetweenTwoParallelLinesIsDirt) {
  BitImage marks(kSide, kSide), lines(kSide, kSide);
  drawDash(marks, kMiddle, 0.0, 4.0, 4.0);
  drawDash(lines, kMiddle - Vec2(0.0, 10.0), 0.0, 200.0, 4.0);
  drawDash(lines, kMiddle + Vec2(0.0, 10.0), 0.0, 200.0, 4.0);
  EXPECT_EQ(marksInRows(marks, either(lines, marks), {}).count(), 0);
}

BitImage latticeOf(double pitchPx, double sizePx, int count, double angle) {
  BitImage marks(kSide, kSide);
  const Vec2 u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < count; ++k) {
      const double half = 0.5 * (count - 1);
      drawDash(marks, kMiddle + pitchPx * ((i - half) * u + (k - half) * v), angle, sizePx, sizePx);
    }
  }
  return marks;
}

TEST(MarkRows, AHalftoneIsNoRow) {
  for (const double angle : {0.0, 0.3, 0.785}) {
    const BitImage marks = latticeOf(9.0, 4.0, 20, angle);
    EXPECT_EQ(marksInRows(marks, marks, {}).count(), 0) << angle;
  }
  BitImage chequer(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = y % 2; x < kSide; x += 2) chequer.set(x, y, true);
  EXPECT_EQ(marksInRows(chequer, chequer, {}).count(), 0);
}

TEST(MarkRows, RowsThatCrossOrRunBesideEachOtherStay) {
  const BitImage cross = either(dashedLine(0.2, 11), dashedLine(1.7, 11));
  EXPECT_GT(marksInRows(cross, cross, {}).count(), 0.9 * cross.count());
  BitImage pair(kSide, kSide);
  for (const double y : {150.0, 165.0})
    for (int i = 0; i < 12; ++i) drawDash(pair, Vec2(40.0 + 15.0 * i, y), 0.0, 9.0, 3.0);
  EXPECT_EQ(marksInRows(pair, pair, {}), pair);
}

TEST(MarkRows, ScatteredDirtIsDropped) {
  std::mt19937 random(5);
  BitImage marks(1000, 1000);
  const int count = 500;  // one on 2000 px
  for (int i = 0; i < count; ++i) {
    const int x = 5 + static_cast<int>(random() % 990), y = 5 + static_cast<int>(random() % 990);
    for (int dy = 0; dy < 3; ++dy)
      for (int dx = 0; dx < 3; ++dx) marks.set(x + dx, y + dy, true);
  }
  const BitImage kept = marksInRows(marks, marks, {});
  EXPECT_LT(static_cast<double>(kept.count()), 0.1 * static_cast<double>(marks.count()));
}

TEST(MarkRows, TheSameWithAnyNumberOfThreads) {
  std::mt19937 random(9);
  BitImage marks(600, 600);
  for (int i = 0; i < 900; ++i) marks.set(static_cast<int>(random() % 600), static_cast<int>(random() % 600), true);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(marksInRows(marks, marks, one), marksInRows(marks, marks, four));
}

}  // namespace
}  // namespace batten
