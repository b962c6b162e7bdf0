// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/contour/contour_set.h"

namespace batten {

/// A place that looks like a corner. Shown hollow, never applied silently.
struct CornerSuggestion {
  int contour = 0;
  int pointIndex = 0;
  Vec2 positionPx = Vec2::Zero();
  double turningAngleRad = 0.0;
};

/// A stretch of a contour that is known to turn sharply: its points first..last; of a closed contour `last` may pass
/// the number of points.
struct SharpTurn {
  int contour = 0;
  int first = 0, last = 0;
};

/// Places where two one-sided local parabolas, extrapolated to the point, differ in direction by at least
/// `minAngleRad`; one suggestion per turn. `scalePx` is the length looked at on either side, and more where the line is
/// ragged. `turns` of about `minAngleRad` and more stand before what is found near
/// them, unless the line is ragged. The angle is that of the
/// located corner, as a mark would give it; where none can be located, that of the place.
std::vector<CornerSuggestion> suggestCorners(const ContourSet&, double minAngleRad, double scalePx,
                                             std::span<const SharpTurn> turns = {});

/// The suggestions of which no two stand for one corner: a mark at each finds a corner, with this snap distance, that
/// no mark at another one finds.
std::vector<CornerSuggestion> oncePerCorner(const ContourSet&, const std::vector<CornerSuggestion>&,
                                            double snapDistancePx);

}  // namespace batten
