// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/vec2.h"

namespace batten {

/// Principal axis of a group of points (000 III): centroid, unit direction pointing from the first to the last point,
/// and the stretch between the extreme projections. Population covariance. @pre at least 2 points that differ.
struct PcaLine {
  Vec2 centroid, direction, from, to;
  double residualRms = 0.0;                             ///< [unit of the points] From the axis.
  double eigenvalueMajor = 0.0, eigenvalueMinor = 0.0;  ///< [its square] Variances along the axis and across it.
};

PcaLine pcaLine(std::span<const Vec2> points);

}  // namespace batten
