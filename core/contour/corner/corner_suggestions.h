// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A place that looks like a corner.
struct CornerSuggestion {
  int contour = 0;     ///< Index into the contour set.
  int pointIndex = 0;  ///< Nearest point of the contour.
  Vec2 positionPx = Vec2::Zero();
  double turningAngleRad = 0.0;  ///< [rad] Change of direction, signed as Turning.
  double certainty = 0.0;  ///< 0..1 (CornerJudge; of a like corner on a stroke kCertainCorner). From that on it is
                           ///< set without a mark.
  bool isLocated = false;  ///< Found between short sides (cornersOfShortSides): positionPx is where these meet.
};

/// A sharp feature: a stretch of a contour that is known to turn sharply, points first..last. On a closed contour
/// `last` may exceed the number of points.
struct SharpFeature {
  int contour = 0;
  int first = 0, last = 0;
};

/// Places where two one-sided local parabolas, extrapolated to the point, differ in direction by at least
/// `minAngleRad`; one suggestion per turn. `scalePx` is the length used on either side, more where the line is ragged.
/// `features` of about `minAngleRad` or more take precedence over what is found near them, unless the line is ragged.
/// The angle is that of the located corner, as a mark would give it; where none can be located, that at the point. Not
/// complete when cancelled.
std::vector<CornerSuggestion> suggestCorners(const ContourSet&, double minAngleRad, double scalePx, const RunContext&,
                                             std::span<const SharpFeature> features = {});

/// Removes duplicate suggestions of the same corner: a mark at each remaining one finds a corner of its own, with
/// this snap distance. Not complete when cancelled.
std::vector<CornerSuggestion> oncePerCorner(const ContourSet&, const std::vector<CornerSuggestion>&,
                                            double snapDistancePx, const RunContext&);

}  // namespace batten
