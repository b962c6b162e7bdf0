// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/mask_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace batten {
namespace {

// Every pixel against every other one, and a border of pixels around the page.
std::int64_t naive(const BitImage& mask, int x, int y) {
  if (!mask.at(x, y)) return 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int v = -1; v <= mask.height; ++v) {
    for (int u = -1; u <= mask.width; ++u) {
      if (!mask.at(u, v)) least = std::min<std::int64_t>(least, (u - x) * (u - x) + (v - y) * (v - y));
    }
  }
  return least;
}

void expectNaive(const BitImage& mask) {
  MaskDistance distance(mask);
  for (int y = -1; y <= mask.height; y += 3) {
    for (int x = -1; x <= mask.width; x += 2) ASSERT_EQ(distance.squared(x, y), naive(mask, x, y)) << x << " " << y;
  }
  // The strips that were given up come anew.
  for (int y = mask.height - 1; y >= 0; y -= 61)
    ASSERT_EQ(distance.squared(mask.width / 2, y), naive(mask, mask.width / 2, y)) << y;
}

TEST(MaskDistance, IsTheDistanceToTheNearestPixelOutside) {
  std::mt19937 random(5);
  for (const int holesPerMille : {0, 1, 20, 500}) {
    BitImage mask(75, 150);
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) mask.set(x, y, static_cast<int>(random() % 1000) >= holesPerMille);
    }
    ASSERT_NO_FATAL_FAILURE(expectNaive(mask)) << holesPerMille;
  }
}

TEST(MaskDistance, APageOfManyStripsIsAskedInAnyOrder) {
  BitImage mask(40, 700);
  for (int y = 10; y < 690; ++y) {
    for (int x = 3; x < 37; ++x) mask.set(x, y, (x - 20) * (x - 20) + (y % 97 - 40) * (y % 97 - 40) > 30);
  }
  expectNaive(mask);
}

}  // namespace
}  // namespace batten
