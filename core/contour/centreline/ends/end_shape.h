// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// The course of a stroke near its end, going on beyond it as a parabola; s = 0 at the anchor, growing outwards. [px]
struct EndCourse {
  Vec2 at = Vec2::Zero(), out = Vec2::Zero(), bend = Vec2::Zero();
  Vec2 position(double s) const { return at + s * out + 0.5 * s * s * bend; }
  Vec2 normal(double s) const { return leftNormal(out + s * bend).normalized(); }
};

/// [px] Beyond the anchor where the ink of a stroke this wide ends: the half level of the mean over its middle half.
/// `inside`: of the way there lies about so much in the ink. Nothing where no end is seen.
std::optional<double> inkEnd(const EndCourse& end, double widthPx, double inside, const GreyImage& grey);

/// Where the pen stopped, by what kind of end it left. [px] beyond the anchor
struct PenStop {
  double roundPx = 0.0;  ///< The centre of a round end, half a width before its tip,
  double cutPx = 0.0;    ///< or the edge where the stroke is cut off, square or skewed.
  double forCut = 0.0;   ///< Natural logarithm of how much likelier the pixels are if it is cut off.
  /// The mean of both, weighed by how likely each is; `cutOdds`: logarithm of the odds before the pixels are seen.
  double at(double cutOdds) const;
};
/// `tipPx` is about the end of the ink. A blurred strip is fitted to the profile across the stroke, and an end of
/// either kind to the pixels round the tip, by least squares; the noise is what the better one leaves. Nothing where
/// too little of the stroke is left to measure.
std::optional<PenStop> penStop(const EndCourse& end, double widthPx, double tipPx, const GreyImage& grey);

}  // namespace batten
