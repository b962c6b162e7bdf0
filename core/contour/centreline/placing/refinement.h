// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// How the centre is read from the profile across a stroke.
enum class CentreRule {
  None,       ///< Skeleton positions, smoothed to even steps.
  HalfLevel,  ///< Midpoint of the two half levels: ink.
  Centroid,   ///< Centroid of darkness: pencil and bundles of strokes, which have no clear borders.
};

struct RefineSettings {
  CentreRule rule = CentreRule::HalfLevel;
  double smoothShiftPx = 0.0;  ///< [px] Gaussian over the shifts along the stroke path (Centroid).
};

struct RefinedStrokes {
  std::vector<Contour> contours;
  std::vector<Vec2> faint;  ///< [px] places where ends go on over ink that only the grey values show, not the mask.
};

/// Turns stroke paths into contours: points about 1 px apart, moved to the middle of the stroke on the grey values,
/// interpolated through junctions, and ended where the pen was lifted (placeEnds). One contour per stroke path, same
/// order. Not complete when the context is cancelled.
RefinedStrokes refineStrokePaths(const std::vector<StrokePath>& paths, const GreyImage& grey,
                                 const RefineSettings& settings, const RunContext& context);

}  // namespace batten
