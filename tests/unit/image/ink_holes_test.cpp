// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/ink_holes.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

// Ink from (2, 2) to (97, 77).
BitImage slab() {
  BitImage ink(100, 80);
  for (int y = 2; y < 78; ++y)
    for (int x = 2; x < 98; ++x) ink.set(x, y, true);
  return ink;
}

TEST(InkHoles, AreTheRegionsOfPaperInsideTheInk) {
  BitImage ink = slab();
  for (int y = 10; y < 15; ++y)
    for (int x = 20; x < 27; ++x) ink.set(x, y, false);  // 7 x 5
  ink.set(27, 15, false);                                // touches it by a corner only
  for (int x = 40; x < 100; ++x) ink.set(x, 40, false);  // open at the right
  std::vector<InkHole> holes = findInkHoles(ink, {});
  ASSERT_EQ(holes.size(), 2u);
  measureWidths(ink, holes, {});
  EXPECT_EQ(holes[0].runs.size(), 5u);
  EXPECT_DOUBLE_EQ(holes[0].widthPx, 5.0);
  EXPECT_EQ(holes[0].middleY, 12);
  EXPECT_EQ(holes[0].middleX, 22) << "the first of the middle places";
  EXPECT_DOUBLE_EQ(holes[1].widthPx, 1.0);
}

TEST(InkHoles, ThereAreNoneOnAnEmptyPageOrWhenCancelled) {
  EXPECT_TRUE(findInkHoles(BitImage(), {}).empty());
  EXPECT_TRUE(findInkHoles(BitImage(70, 3), {}).empty());
  BitImage ink = slab();
  ink.set(50, 50, false);
  RunContext context;
  EXPECT_EQ(findInkHoles(ink, context).size(), 1u);
  context.cancel.cancel();
  EXPECT_TRUE(findInkHoles(ink, context).empty());
}

}  // namespace
}  // namespace batten
