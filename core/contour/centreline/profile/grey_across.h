// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// [grey] of the pixel at a place, or of the nearest one of the page.
inline double levelOfPixel(const GreyImage& grey, const Vec2& at) {
  return grey.level(std::clamp(static_cast<int>(at.x()), 0, grey.width - 1),
                    std::clamp(static_cast<int>(at.y()), 0, grey.height - 1));
}

/// The grey across a stroke, by loops that run over whole profiles. All give to the last bit what one value after the
/// other gives.

/// 2 half + 1 samples along `normal`, kStrokeStepPx apart, the middle one at `at`: what sampleGrey() gives there.
void sampleAcross(const GreyImage&, const Vec2& at, const Vec2& normal, int half, float* out);

inline constexpr int kMeanHalf = 6;                  ///< Profiles to either side that a mean is made of.
inline constexpr int kMeanRows = 2 * kMeanHalf + 1;  ///< The middle one, and those to both sides.
/// The mean of kMeanRows profiles of `count` samples, `first` and those behind it, weighed by weights[k] where they lie
/// k away from the middle one. `sum`: of all the weights.
void meanOfProfiles(const float* first, int count, const float* weights, float sum, float* out);

inline constexpr int kPaperSamples = 5;  ///< Over which the paper beside a stroke is averaged, 1.25 px.
/// The means of p[k] to p[k + box - 1], for `count` k. Fastest for a box of kPaperSamples.
void meansOfBoxes(const float* p, int box, int count, double* means);

/// A profile smoothed by a Gaussian of half a pixel; towards its ends by what there is to either side.
void smoothAcrossStroke(const float* profile, int count, float* out);

}  // namespace batten
