// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/document/report_pages/figure.h"
#include "core/fairing/profile/target_profiles.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// The profile that a curve was faired towards; absent where its mode follows none.
std::optional<TargetProfile> targetOf(const TracedCurve&);

/// Whether fairing gave the curve a shape of its own, so that both are worth showing.
bool isShownFaired(const TracedCurve&);

/// All curves that are exported at their true size, sketched in grey below faired, each with its number. The figure
/// is as large as the curves with a margin; an empty one where there is none.
/// @param numbers of the curves, from 1.
/// @return Numerical if a curve cannot be drawn.
Result<Figure> drawingFigure(const std::vector<const TracedCurve*>&, const std::vector<int>& numbers);

/// The curve with its curvature comb, as large as the frame allows: quills to the side from which the curve bends away,
/// their length proportional to the curvature.
Figure combFigure(const TracedCurve&, double widthMm, double heightMm);

/// Radius of curvature over arc length, logarithmic: sketched, faired, and the target, dashed. Straighter stretches
/// than 20 times the size of the curve lie on the upper border.
Figure radiusFigure(const TracedCurve&, const std::optional<TargetProfile>&, double widthMm, double heightMm);

}  // namespace batten
