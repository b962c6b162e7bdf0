// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/contour/edge_choices.h"

namespace batten {

struct EdgeParams {
  EdgeMode mode = EdgeMode::Automatic;
  bool internal = false;       ///< Outline: also the borders of holes inside the ink.
  bool subpixel = true;        ///< Place the points on the raw grey values; off: crack midpoints or skeleton pixels.
  double strokeWidth = 0.025;  ///< [-] 0.005..0.1. Strokes narrower than this part of sqrt(width * height) are lines,
                               ///< wider ones are shapes.
  double gapFactor =
      4.0;  ///< [stroke widths] 0..20. Longest gap that is bridged between two ends that face each other; 0 = none.
  double mergeWidths =
      0.0;  ///< [stroke widths] 0..20. Strokes of one intended line closer than this are merged into one; 0 = off.
  double spurFactor = 1.5;   ///< [stroke widths] 0..5. Side branches of the skeleton shorter than this are dropped.
  double maxBendDeg = 40.0;  ///< [deg] 0..90. StrokePaths bending less than this continue through a crossing.
  std::vector<EdgeChoice> choices;  ///< Pieces of ink that are followed in a way of their own.
  bool operator==(const EdgeParams&) const = default;
};
std::optional<Error> validate(const EdgeParams&);

struct ContourParams {
  double minLengthPx = 40.0;  ///< [px] >= 0. Shorter lines are left out.
  int maxCount = 400;         ///< 1..100000. At most this many, the longest; says when it cuts.
  bool operator==(const ContourParams&) const = default;
};
std::optional<Error> validate(const ContourParams&);

}  // namespace batten
