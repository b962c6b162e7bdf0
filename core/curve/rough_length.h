// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/curve/nurbs_curve.h"

namespace batten {

/// Length of a curve between two parameters, by a polygon of eight chords: never too long. For choosing numbers of
/// steps. [unit of the curve]
double roughLength(const NurbsCurve&, double from, double to);

}  // namespace batten
