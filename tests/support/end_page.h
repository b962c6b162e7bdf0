// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// How a stroke ends.
enum class StrokeEnd {
  Butt,    ///< Cut off square.
  Skewed,  ///< Cut off, the cut 25 degrees from square.
  Round,   ///< With half a disc, as a round pen leaves it.
  Taper,   ///< It thins to nothing.
};

/// Where a stroke ends: the middle of the cut, the centre of the round cap, the tip of the taper.
struct EndTruth {
  Vec2 at = Vec2::Zero();   ///< [px]
  Vec2 out = Vec2::Zero();  ///< Unit direction of the stroke there, outwards.
};

struct EndPage {
  int width = 0, height = 0;
  std::vector<float> coverage;  ///< Exact area of ink, pixel by pixel, 0..1.
  std::vector<EndTruth> ends;   ///< Two a stroke.
};

/// Twelve strokes of this width [px], well apart, in twelve directions, every third bent, both ends alike. Tapers are
/// eight widths long, at least 24 px and at most 72.
EndPage endPage(StrokeEnd, double widthPx);

}  // namespace batten::test
