// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "core/image/bits/bit_image.h"

namespace batten::test {

/// Ink at random pixels, a share of `density` of them.
inline BitImage randomImage(int width, int height, double density, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution ink(density);
  BitImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set(x, y, ink(random));
  }
  return image;
}

}  // namespace batten::test
