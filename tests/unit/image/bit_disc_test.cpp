// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/bit_disc.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

// By the definition, pixel by pixel, over the borders of words and of the picture.
TEST(BitDisc, SetsThePixelsWhoseCentresLieWithin) {
  for (const double radius : {0.3, 0.8, 2.0, 5.5, 40.0}) {
    for (const Vec2& at : {Vec2(63.5, 20.5), Vec2(64.2, 19.9), Vec2(0.0, 0.0), Vec2(-3.0, 50.0), Vec2(129.7, 59.0)}) {
      BitImage image(130, 60);
      setDisc(image, at, radius);
      bool any = false;
      for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 130; ++x) {
          const bool in = (Vec2(x + 0.5, y + 0.5) - at).norm() <= radius;
          ASSERT_EQ(image.at(x, y), in) << x << ' ' << y;
          any = any || in;
        }
      }
      EXPECT_EQ(anyInDisc(image, at, radius), any);
      EXPECT_FALSE(anyInDisc(BitImage(130, 60), at, radius));
    }
  }
}

}  // namespace
}  // namespace batten
