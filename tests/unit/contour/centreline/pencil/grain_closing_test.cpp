// SPDX-License-Identifier: GPL-3.0-or-later
// The grain of a pencil is closed, the counters of small letters are not.
#include "core/contour/centreline/pencil/grain_closing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/vec2.h"

namespace batten {
namespace {

constexpr int kMaskWidth = 400, kMaskHeight = 60;
constexpr double kRingStrokePx = 4.0, kRingRadiusPx = 4.5;  // of a letter o, to the middle of its stroke

// [px] Of the centre of a pixel from that of the ring in its column.
Vec2 offOf(int x, int y) { return {x + 0.5 - (20.0 * (x / 20) + 10.0), y + 0.5 - 15.0}; }

// A row of rings, and a long stroke below them.
BitImage lettering() {
  BitImage ink(kMaskWidth, kMaskHeight);
  for (int y = 0; y < kMaskHeight; ++y) {
    for (int x = 0; x < kMaskWidth; ++x) {
      const bool isRing = std::abs(offOf(x, y).norm() - kRingRadiusPx) < 0.5 * kRingStrokePx;
      if (isRing || (y >= 40 && y < 44)) ink.set(x, y, true);
    }
  }
  return ink;
}

TEST(GrainClosing, CountersOfSmallLettersStayOpenOnAFinePage) {
  const BitImage ink = lettering();
  EXPECT_EQ(closeGrain(ink, kRingStrokePx, true, {}), ink);
  // Counters as small as the closing's disc are holes of the grain, where that is asked for.
  EXPECT_GT(closeGrain(ink, kRingStrokePx, false, {}).count(), ink.count() + 20 * 10);
}

// Letters without specks of their own stay as they are beside a line that the grain tears; letters that it tears close.
TEST(GrainClosing, LettersThatAreNotTornStayAsTheyAreBesideATornLine) {
  BitImage torn = lettering();
  for (int y = 40; y < 44; ++y)
    for (int x = 0; x < kMaskWidth; ++x)
      if ((x + 3 * y) % 7 == 0) torn.set(x, y, false);
  const int firstTorn = 10;  // of the rings
  for (int i = firstTorn; i < kMaskWidth / 20; ++i)
    for (int y = 8; y < 22; ++y)
      for (int x = 20 * i; x < 20 * (i + 1); ++x)
        if (std::abs(offOf(x, y).norm() - kRingRadiusPx) < 0.75 && (x + y) % 3 == 0) torn.set(x, y, false);
  const BitImage closed = closeGrain(torn, kRingStrokePx, true, {});
  for (int x = 0; x < 20 * firstTorn; ++x)
    for (int y = 0; y < 30; ++y) ASSERT_EQ(closed.at(x, y), torn.at(x, y)) << x << ", " << y;
  const BitImage whole = lettering();
  int missing = 0, missingBefore = 0;
  for (int x = 20 * firstTorn; x < kMaskWidth; ++x) {
    for (int y = 0; y < 30; ++y) {
      missing += whole.at(x, y) && !closed.at(x, y) ? 1 : 0;
      missingBefore += whole.at(x, y) && !torn.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_LT(10 * missing, missingBefore);
  for (int x = 10; x < kMaskWidth - 10; ++x) ASSERT_TRUE(closed.at(x, 42)) << x;
}

TEST(GrainClosing, TornInkIsClosedOnAFinePageToo) {
  BitImage torn(kMaskWidth, kMaskHeight);
  for (int y = 20; y < 26; ++y)
    for (int x = 5; x < kMaskWidth - 5; ++x) torn.set(x, y, (x + 3 * y) % 7 != 0);
  const BitImage closed = closeGrain(torn, 6.0, true, {});
  for (int y = 21; y < 25; ++y)
    for (int x = 10; x < kMaskWidth - 10; ++x) ASSERT_TRUE(closed.at(x, y)) << x << ", " << y;
}

}  // namespace
}  // namespace batten
