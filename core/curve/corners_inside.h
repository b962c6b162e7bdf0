// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// Parameters inside the domain, ascending, at which the direction of a curve breaks by more than a milliradian: knots
/// of multiplicity = degree and more.
std::vector<double> cornersInside(const NurbsCurve&);

/// Whether the direction breaks where a closed curve begins.
bool beginsAtCorner(const NurbsCurve& closed);

}  // namespace batten
