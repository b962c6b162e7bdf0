// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// Blur moves the half level of a curved edge, and the middle of a curved stroke, towards the centre of curvature by
/// blur^2 kappa / 2 (the mean of a parabola under a Gaussian). Moves the points back along their unit normals. The
/// curvature is the smallest of three windows of 13 points, so that a corner is not mistaken for a tight arc.
/// @param blur [px] standard deviation of the total blur, including pixel size and averaging along the line.
void undoCurvatureShift(std::vector<Vec2>& points, const std::vector<Vec2>& normal, bool closed, double blur);

}  // namespace batten
