// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/light/light_curve.h"

namespace batten {

/// A ragged line as it was meant, at the scale of LightOptions::tolerance: sharp corners of that scale (cornersAtScale)
/// stay sharp, and between them a curve of the fewest control points lies within the tolerance of the line, which is
/// smoothed by .4 of it first; beside corners the result may leave the line by
/// a little more. Spikes and inlets thinner than the tolerance are cut off first (LightReport::necks);
/// LightReport::worst is the largest distance of what is left from the result. A
/// More than LightOptions::mostPoints: LightObstacle::Points. A
/// part that finds no such curve is cut where it is farthest from its chord, which is then a corner. None when
/// cancelled or if nothing is gained.
std::optional<LightCurve> simplifiedCurve(const NurbsCurve& dense, bool closed, const LightOptions&, const RunContext&);

}  // namespace batten
