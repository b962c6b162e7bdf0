// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_choices.h"

namespace batten {

/// Whether the borders of holes in the ink are followed, too.
enum class InnerOutlines {
  Automatic,  ///< Those of shapes, on pages that are not followed by outlines only.
  On,
  Off,
};

struct EdgeParams {
  EdgeMode mode = EdgeMode::Automatic;
  InnerOutlines internal = InnerOutlines::Automatic;  ///< Outline: also the borders of holes inside the ink.
  bool subpixel = true;        ///< Place the points on the raw grey values; off: crack midpoints or skeleton pixels.
  double strokeWidth = 0.025;  ///< [-] 0.005..0.1. Without effect; read so that recipes that name it stay valid.
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
  double minWidths = 3.0;    ///< [stroke widths] 0..1000. Shorter lines are left out.
  double minLengthPx = 0.0;  ///< [px] >= 0. And lines shorter than this.
  int maxCount = 0;          ///< 0..100000. At most this many, the longest; says when it cuts. 0 = no limit.
  bool operator==(const ContourParams&) const = default;
};
std::optional<Error> validate(const ContourParams&);

/// [px] The shortest centre line that is kept, by its own width.
double leastLinePx(const ContourParams&, const Contour& line);
/// [px] The shortest border that is kept: by the pen of the page, where it is known; else 40 px, to be no dirt.
double leastOutlinePx(const ContourParams&, double penPx);

}  // namespace batten
