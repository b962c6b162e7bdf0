// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/fairing/fairing.h"

namespace batten {

/// Whether a target's curve can be advised, said alike wherever the targets are shown. @pre isTargetDegree(degree)
/// The target is met, and its curve stays within the tolerance.
bool isWithinTolerance(const TargetOutcomes&, int degree, double toleranceMm);
/// Its curve has more curvature extrema than the sketch.
bool addsExtrema(const TargetOutcomes&, int degree);
/// Within the tolerance, without more extrema than before; it moves the curve at all, and its profile is like the
/// sketch's (similarity S of 0.2 and more).
bool isAdvisable(const TargetOutcomes&, int degree, double toleranceMm);
/// The recommended degree that can be advised; absent: none.
std::optional<int> advisedDegree(const TargetOutcomes&, double toleranceMm);
/// Meeting a target that takes so much of the curve's size makes another shape of it: the tolerance is not worth
/// raising for it. [mm] of a curve of this extent.
double mostSensibleToleranceMm(const NurbsCurve&);

}  // namespace batten
