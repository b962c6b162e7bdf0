// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"
#include "core/image/scan.h"

namespace batten::test {

using Colour = std::array<double, 3>;  ///< Red, green, blue, 0..255.

/// Ink laid over all before it: it covers the share `coverage` of every pixel and lets these shares of light through.
struct InkLayer {
  std::vector<float> coverage;
  std::array<double, 3> passes{0.1, 0.1, 0.1};
};

struct ColourPage {
  int width = 0, height = 0;
  Colour paperLeft{250, 250, 250}, paperRight{250, 250, 250};  ///< Linear between.
  double noise = 0.0;                                          ///< [grey] standard deviation, white, per channel.
  std::uint32_t seed = 1;
};

/// The page with its inks as a colour scan of 300 dpi.
Scan renderColourPage(const ColourPage& page, const std::vector<InkLayer>& inks);

/// Coverage of a straight stroke from a to b of this width.
std::vector<float> lineCoverage(int width, int height, const Vec2& a, const Vec2& b, double widthPx);

/// The share 0..1 of pixels that `coverage` covers whole and `ink` holds.
double shareFound(const std::vector<float>& coverage, const BitImage& ink);

}  // namespace batten::test
