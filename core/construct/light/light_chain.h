// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/construct/light/light_curve.h"
#include "core/construct/light/light_reference.h"

namespace batten {

/// Extrema of a section to begin with; a section that nothing lighter is found for is cut once more into halves
/// and these again, down to one extremum.
inline constexpr int kExtremaPerSection = 6;

/// Spans of a dense curve that are made light together: the search for the fewest control points tries more of them,
/// and each try costs more, the longer a section is.
inline constexpr int kMostSectionSpans = 400;

/// How a dense curve is cut into sections that are made light one by one.
struct LightSections {
  int extrema = 0;           ///< Significant ones of the whole.
  std::vector<double> cuts;  ///< Parameters, ascending, where one section goes over into the next, ends not included.
};
/// Cuts lie where a tight turn was joined on (knots of multiplicity 3 and more), and between extrema, after every few
/// of them, where the curvature changes fastest; and at knots, after kMostSectionSpans without another cut. Closed
/// curves begin where their reference does (startedAt).
LightSections lightSections(const NurbsCurve& dense, const LightReference&, const LightOptions&,
                            int extremaPerSection = kExtremaPerSection);

/// The sections, each as light as it comes, in one quintic: they meet with one tangent and curvature, at knots of
/// multiplicity 4. None when not one of them became lighter, when the sum has more extrema than the dense curve, or
/// when cancelled.
std::optional<LightCurve> lightChain(const NurbsCurve& dense, const LightReference&, const LightSections&,
                                     const LightOptions&, const RunContext&);

/// Joins clamped quintics end to start that agree in position and tangent: their domains are stretched so that the
/// speeds agree (C1, a knot of multiplicity 4), or where they differ too much are kept (a knot of multiplicity 5).
/// @return none when a joint has no common tangent.
std::optional<NurbsCurve> joinedWithTangents(const std::vector<NurbsCurve>& parts);

}  // namespace batten
