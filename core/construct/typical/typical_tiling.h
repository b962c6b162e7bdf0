// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/typical/typical_line.h"
#include "core/construct/typical/typical_path.h"

namespace batten {

/// A path laid along the true and fair fit of its line (TypicalLine::fair), as long pieces as go: typical curves
/// wherever the curvature keeps its sign and goes one way quickly enough for h <= cos(phi) or h >= 1 / cos(phi);
/// quintic Hermite pieces at inflections, straight parts, circular arcs and flat extrema, which typical curves cannot
/// draw. So the path begins with the extrema and inflections that the points prove, and every typical curve with the
/// way its curvature goes. No piece is a sliver. In the line's units (px). Absent without a fair fit, or where the line
/// is too short.
std::optional<TypicalPath> tiledPath(const TypicalLine& line);

}  // namespace batten
