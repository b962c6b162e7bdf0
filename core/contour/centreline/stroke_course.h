// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/contour/centreline/stroke_paths.h"
#include "core/contour/contour_set.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/image/grey_image.h"

namespace batten {

/// A stroke path on its way to a contour: even steps of about 1 px, everything per point in vectors of one size.
struct StrokeCourse {
  std::vector<Vec2> chain;    ///< [px] skeleton positions, evened.
  std::vector<Vec2> base;     ///< [px] where the profiles stand.
  std::vector<Vec2> tangent;  ///< Unit direction of travel at `base`.
  std::vector<float> radius;  ///< [px] of the ink in the mask.
  std::vector<StrokePart> part;
  std::vector<float> shift;  ///< [px] from `base` to the middle of the stroke, along the left normal.
  std::vector<float> measuredWidth;
  std::vector<std::uint8_t> measured;
  struct Tone {
    float contrast = 0.0f;               ///< [grey] paper minus the middle of the stroke.
    float paper = 255.0f, slope = 0.0f;  ///< [grey, grey/px] at `base` and along the left normal.
    float reach = 0.0f;                  ///< [px] no other ink nearer than this.
  };
  std::vector<Tone> tone;                     ///< Where measured, as the profile of the last round had it.
  std::vector<PointInformation> information;  ///< Of those placed on the pixels themselves; empty: none were.
  bool closed = false;
  bool tip[2] = {false, false};
  double widthPx = 1.0;  ///< Median.
  int profileHalf = 0;   ///< [samples]
};

/// Position, direction of travel and bend (second derivative, 1/px) at point `border` by a parabola through the points
/// from there on to side +1 or -1, at most `reach` px and not into a junction.
struct CourseApproach {
  Vec2 at = Vec2::Zero(), direction = Vec2::Zero(), bend = Vec2::Zero();
  bool ok = false;
};
CourseApproach approachAt(const StrokeCourse& course, int border, int side, double reach);

/// Even, smooth positions of a stroke path, ready to be measured.
StrokeCourse resample(const StrokePath& path);
/// Refuses shifts that cannot be (and those in junctions and corners), and fills these from their neighbours.
void rejectImplausibleShifts(StrokeCourse& course, bool checkWidth);
/// Moves the points to the middle found; `again`: and prepares the next round.
void moveCourse(StrokeCourse& course, bool again);
/// Replaces the points within junctions by a cubic that goes on from both sides.
void layThroughJunctions(StrokeCourse& course);

}  // namespace batten
