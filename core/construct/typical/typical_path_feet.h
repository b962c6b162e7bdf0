// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_geometry.h"

namespace batten {

/// Where on a path a point lies.
struct PathFoot {
  std::size_t element = 0;
  double t = 0.0;         ///< Parameter of the element, 0..1.
  double distance = 0.0;  ///< [px] Signed, positive to the left of the path.
};

/// Feet of points in order, each searched from where it was, or at first from the one before.
void followFeet(const std::vector<PathGeometry>& geometry, const std::vector<Vec2>& points,
                std::vector<PathFoot>& feet);

}  // namespace batten
