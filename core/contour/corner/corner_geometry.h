// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

/// A parabola fitted to the stretch inner..outer [px of arc] on one side of a point of a contour; s grows away from it.
/// The nearest pixels are left out and the fit is extrapolated back to the point: this distinguishes a corner from a
/// tight arc.
struct OneSidedFit {
  LocalQuadratic fit;
  double reach = 0.0;  ///< [px] > 0. Arc actually covered.
};
/// `side` is +1 along the contour, -1 against it. Stops at open ends and after half of a closed contour. Nothing where
/// there are too few points for a direction.
std::optional<OneSidedFit> fitOneSide(const Contour& contour, int index, int side, double inner, double outer,
                                      int maxOrder = 2);

/// The point of a contour that is nearest to a place.
struct NearestPoint {
  int index = 0;
  double distance = 0.0;  ///< [px]
};
/// Looks from the point `at` over `reach` points on either side; of equally near ones `at` itself, then the first.
NearestPoint nearestAlong(const Contour& contour, int at, const Vec2& position, int reach);

/// Change of direction at a point, from two one-sided fits.
struct Turning {
  double angleRad = 0.0;  ///< -pi..pi, positive to the left in the model frame (image: y down).
  double score = 0.0;     ///< |angle|, lowered where the fits do not describe the points or do not meet.
};
/// @param maxOrder 1: the sides are straight, 2: parabolas.
std::optional<Turning> turningAt(const Contour& contour, int index, double inner, double outer, int maxOrder = 2);

/// [px] Largest distance from the end of a contour to the tip that its sides lead to; less for wider angles.
inline constexpr double kFarthestTipPx = 60.0;

/// Where the two sides of a contour meet when extended. At most `outer` px of each side are used.
/// @param grey if given, the pixels around the corner of an outline are fitted, too (corner_pixels.h).
struct CornerFix {
  /// [px]
  Vec2 position = Vec2::Zero();
  double angleRad = 0.0;  ///< By which the direction of travel turns.
  double zonePx = 4.0;    ///< [px] nearer points are unreliable: rounded by blur, or shifted by the other side.
  bool exact = false;     ///< False: the sides do not meet well; position is the contour point.
};
CornerFix locateCorner(const Contour& contour, int index, double inner, double outerBefore, double outerAfter,
                       const GreyImage* grey = nullptr);

/// The same for all corners of a contour, given by their point indices in ascending order. No side extends beyond the
/// next corner. Not complete when cancelled.
std::vector<CornerFix> locateCorners(const Contour& contour, std::span<const int> indices, const RunContext&,
                                     const GreyImage* grey = nullptr);

/// [px] Points nearer than this to a corner are rounded by blur (outlines) or by the other side's ink (strokes).
double roundedZonePx(const Contour& contour, int index);

}  // namespace batten
