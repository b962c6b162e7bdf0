// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// [px] Step of the profiles across a stroke. Half lengths are whole multiples, so that u = 0 is a sample: else the
/// midpoint is off by a part of the step.
inline constexpr double kStrokeStepPx = 0.25;

/// Bilinear grey level 0..255, border replicated; for millions of samples.
inline float sampleGrey(const GreyImage& grey, double x, double y) {
  const double fx = std::clamp(x - 0.5, 0.0, grey.width - 1.0), fy = std::clamp(y - 0.5, 0.0, grey.height - 1.0);
  const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
  const int dx = x0 + 1 < grey.width ? 1 : 0;
  const std::uint16_t* a = grey.row(y0) + x0;
  const std::uint16_t* b = y0 + 1 < grey.height ? a + grey.width : a;
  const auto tx = static_cast<float>(fx - x0), ty = static_cast<float>(fy - y0);
  const float top = static_cast<float>(a[0]) + tx * (static_cast<float>(a[dx]) - static_cast<float>(a[0]));
  const float low = static_cast<float>(b[0]) + tx * (static_cast<float>(b[dx]) - static_cast<float>(b[0]));
  return (top + ty * (low - top)) * static_cast<float>(1.0 / GreyImage::kGreyUnit);
}

/// The same where all pixels around lie on the page: coordinates from .5 to .5 px before its right and lower border.
inline float sampleGreyInside(const GreyImage& grey, double x, double y) {
  const double fx = x - 0.5, fy = y - 0.5;
  const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
  const std::uint16_t* a = grey.row(y0) + x0;
  const std::uint16_t* b = a + grey.pitch();
  const auto tx = static_cast<float>(fx - x0), ty = static_cast<float>(fy - y0);
  const float top = static_cast<float>(a[0]) + tx * (static_cast<float>(a[1]) - static_cast<float>(a[0]));
  const float low = static_cast<float>(b[0]) + tx * (static_cast<float>(b[1]) - static_cast<float>(b[0]));
  return (top + ty * (low - top)) * static_cast<float>(1.0 / GreyImage::kGreyUnit);
}

/// Grey levels across a stroke at kStrokeStepPx, 2 * half + 1 of them, from its right to its left, averaged over 3 px
/// along its direction.
std::vector<float> profileAcross(const GreyImage&, const Vec2& at, const Vec2& direction, int half);

struct StrokeCentre {
  double centre = 0.0;                ///< [px] along the profile, 0 = its middle.
  double width = 0.0;                 ///< [px] between the half levels.
  double contrast = 0.0;              ///< [grey] paper minus the middle of the stroke.
  double paper = 255.0, slope = 0.0;  ///< [grey, grey/px] of the paper, a line along the profile.
  double reach = 0.0;                 ///< [px] no other ink nearer than this to the middle of the profile.
};

/// Half-level midpoint of a dark ridge in a profile of 2 * half + 1 samples; nothing where there is none. `widthPx` is
/// about the stroke's width. `scratch` holds as many values.
std::optional<StrokeCentre> halfLevelCentre(std::span<const float> profile, double widthPx, std::span<float> scratch);

/// Centroid of darkness over |u| <= reachPx; what is less than 15 % of the darkest counts as paper. Nothing
/// where all is paper.
std::optional<StrokeCentre> centroidCentre(std::span<const float> profile, double reachPx);

/// The ink in a profile of 2 * half + 1 samples, all of its darkness summed up.
struct InkAcross {
  double darkness = 0.0;              ///< [grey px] below the paper; with noise also negative where there is no ink.
  std::optional<double> centre = {};  ///< [px] centroid along the profile, 0 = its middle; absent: there is no ink.
  double middle = 0.0;                ///< [grey] below the paper within a pixel of its middle, mean.
  double paper = 255.0;               ///< [grey] at the middle, as it would be without ink.
};
/// `widthPx`: no ink of the stroke lies farther than half of it, and blur, from the middle. `inkLevel` [grey]: of the
/// stroke where it is whole; what lies beside it and is not far lighter is another one's.
InkAcross inkAcross(std::span<const float> profile, double widthPx, double inkLevel);

}  // namespace batten
