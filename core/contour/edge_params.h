// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/contour/edge_choices.h"

namespace batten {

/// Whether the borders of holes inside the ink are followed, where ink is followed along its border.
enum class InnerBorders {
  Automatic,  ///< Those of shapes are, as in letters; not the inner sides of strokes when the page is followed by
              ///< outline.
  On,
  Off,
};

struct EdgeParams {
  EdgeMode mode = EdgeMode::Automatic;
  InnerBorders internal = InnerBorders::Automatic;
  bool subpixel = true;        ///< Place the points on the raw grey values; off: crack midpoints or skeleton pixels.
  double strokeWidth = 0.025;  ///< [-] 0.005..0.1. Without effect; kept for old recipes.
  double gapFactor = 4.0;      ///< [stroke widths] 0..20. Longest gap that is bridged between two ends that face each
                           ///< other, and to the line or the corner that a long line points at (near_ends.h); 0 = none.
  double mergeWidths =
      0.0;  ///< [stroke widths] 0..20. Strokes closer together than this are merged into one line; 0 = off.
  /// Lines that were drawn over more than once become the intended curves, found place by place; mergeWidths,
  /// where it is not 0, is the distance to begin with. Pages without such lines stay as they are.
  bool intent = false;
  double spurFactor = 1.5;   ///< [stroke widths] 0..5. Side branches of the skeleton shorter than this are dropped.
  double maxBendDeg = 40.0;  ///< [deg] 0..90. A stroke that bends by less than this continues through a crossing;
                             ///< strokes that share ink go through it along their arcs.
  std::vector<EdgeChoice> choices;        ///< Pieces of ink with a trace mode of their own.
  std::vector<PaintedInk> painted;        ///< Parts of ink with one; a choice for what was painted counts more.
  std::vector<JunctionChoice> junctions;  ///< Junctions whose strokes the user has paired.
  bool operator==(const EdgeParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const EdgeParams&);

struct ContourParams {
  /// [stroke widths] 0..100. Shorter lines are left out. Up to the default those that part two faces of the paper stay.
  double minWidths = 3.0;
  double minLengthPx = 0.0;  ///< [px] >= 0. So are lines shorter than this.
  int maxCount = 0;          ///< 0..100000. At most this many, the longest; says when it cuts. 0 = all.
  bool operator==(const ContourParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const ContourParams&);
/// Whether the user says how short a line may be.
bool hasOwnLengths(const ContourParams&);

}  // namespace batten
