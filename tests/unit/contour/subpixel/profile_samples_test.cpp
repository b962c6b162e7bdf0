// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/profile_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/contour/subpixel/edge_profile.h"

using namespace batten;

namespace {

// Inside the page, across its borders and beyond them.
TEST(ProfileSamples, AreThoseOfOnePlaceAfterTheOther) {
  std::mt19937 random(9);
  GreyImage grey(53, 41);
  for (std::uint16_t& pixel : grey.pixels) pixel = static_cast<std::uint16_t>(random());
  std::uniform_real_distribution<double> x(-6.0, 59.0), y(-6.0, 47.0), angle(0.0, 7.0);
  for (int round = 0; round < 3000; ++round) {
    Vec2 base(x(random), y(random));
    if (round % 5 == 0) base = {std::floor(base.x()) + 0.5, std::floor(base.y()) + 0.5};
    const double turn = round % 3 == 0 ? 0.0 : angle(random);
    const Vec2 normal(std::cos(turn), std::sin(turn));
    for (const bool cubic : {false, true}) {
      std::array<float, kProfileSamples> found;
      sampleProfile(grey, base, normal, cubic, found.data());
      for (int k = 0; k < kProfileSamples; ++k) {
        const Vec2 at = base + profileU(k) * normal;
        ASSERT_EQ(found[k], static_cast<float>(cubic ? sampleCubic(grey, at) : sampleLinear(grey, at)))
            << round << " " << k << " " << cubic;
      }
    }
  }
}

}  // namespace
