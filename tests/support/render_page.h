// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/scan.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

/// How a page is scanned.
struct PageStyle {
  double paperLeft = 255.0, paperRight = 255.0;  ///< [grey] linear gradation across.
  double inkLevel = 20.0;                        ///< [grey] of full ink, or, where `contrast` > 0, ignored.
  double contrast = 0.0;                         ///< [grey] > 0: ink is this much darker than the paper at the place.
  double blurPx = 0.0;                           ///< Standard deviation of the Gaussian.
  double noise = 0.0;                            ///< [grey] standard deviation, white.
  double texture = 0.0;                          ///< [grey] amplitude of slow paper texture.
  std::uint32_t seed = 1;
  int jpegQuality = 0;         ///< 1..100: the page goes through JPEG; 0: it does not.
  double noiseRight = -1.0;    ///< [grey] >= 0: the noise grows or falls to this at the right border.
  double contrastRight = 0.0;  ///< [grey] > 0: and `contrast` to this.
};
PageStyle cleanPage();
PageStyle scannedPage(std::uint32_t seed);  ///< Blur .8, noise 6, paper 255 to 140, texture.
PageStyle darkPage(std::uint32_t seed);     ///< Background falling to 40, line 20 darker.
/// Noise 2 on the left growing to 12 on the right, ink 120 to 40 darker than paper that falls from 230 to 120; blur .8.
PageStyle varyingPage(std::uint32_t seed);
PageStyle gradatedPage(std::uint32_t seed);  ///< Blur 1.2, noise 5, gradation: the accuracy cases of the foundation.

/// What is left of a picture of 8 bits. @param quality 1..100
void throughJpeg(GreyImage&, int quality);

/// Exact area coverage (0..1) of the filled outline, pixel by pixel.
std::vector<float> fillCoverage(const std::vector<Vec2>& outline, int width, int height);
/// Coverage of a stroke of this width along the outline (round caps and joins).
std::vector<float> strokeCoverage(const std::vector<Vec2>& outline, bool closed, double widthPx, int width, int height);
/// The page: coverage inked on paper, blurred, textured, with noise, as an 8-bit scan of 300 dpi.
Scan renderPage(std::vector<float> coverage, int width, int height, const PageStyle&);

}  // namespace batten::test
