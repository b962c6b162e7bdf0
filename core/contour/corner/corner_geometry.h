// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

/// A parabola fitted to the stretch inner..outer [px of arc] on one side of a point of a contour; s grows away from it.
/// Leaving out the nearest pixels and extrapolating back is what tells a corner from a tight arc.
struct OneSidedFit {
  LocalQuadratic fit;
  double reach = 0.0;  ///< [px] arc actually covered; 0: no fit.
};
/// `side` is +1 along the contour, -1 against it. Stops at open ends and after half of a closed contour.
OneSidedFit fitOneSide(const Contour& contour, int index, int side, double inner, double outer, int maxOrder = 2);

/// What two one-sided fits say of a point.
struct Turning {
  double angleRad = 0.0;  ///< -pi..pi, positive to the left in the model frame (image: y down).
  double score = 0.0;     ///< |angle|, lowered where the fits do not describe the points or do not meet.
};
/// @param maxOrder 1: the sides are straight, 2: parabolas.
std::optional<Turning> turningAt(const Contour& contour, int index, double inner, double outer, int maxOrder = 2);

/// [px] Farthest that a contour may end before the tip its sides lead to; less where they open wider.
inline constexpr double kFarthestTipPx = 60.0;

/// Where the two sides of a contour meet when extended, at most `outer` px of each looked at.
/// @param grey if given, the pixels around the corner of an outline have a say (corner_pixels.h).
struct CornerFix {
  Vec2 position = Vec2::Zero();
  double angleRad = 0.0;
  double zonePx = 4.0;  ///< [px] points nearer than this are not to be trusted: rounded, or squeezed by the other leg.
  bool exact = false;   ///< False: the sides do not meet well; position is the contour point.
};
CornerFix locateCorner(const Contour& contour, int index, double inner, double outerBefore, double outerAfter,
                       const GreyImage* grey = nullptr);

/// The same for the corners of a contour, given by their points in ascending order: no side is looked at beyond the
/// next corner.
std::vector<CornerFix> locateCorners(const Contour& contour, std::span<const int> indices,
                                     const GreyImage* grey = nullptr);

/// [px] Points nearer than this to a corner are rounded by blur (outlines) or by the other leg's ink (strokes).
double roundedZonePx(const Contour& contour, int index);

}  // namespace batten
