// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// Indices of the points of a polyline that must stay, ascending: the first, the last and the sharp ones between them
/// (`sharp` is ascending).
std::vector<int> pointsThatStay(int count, std::span<const int> sharp);

// Fewer points for a polyline: both return the indices of the points to keep, among them those that must stay.

/// By arc length (004 section 3.1): points about `step` apart along the line, evenly between two points that must stay;
/// a step of 0 keeps all.
std::vector<int> thinnedByStep(std::span<const Vec2> points, std::span<const int> sharp, double step);

/// By tolerance: no removed point lies farther than `tolerance` from the chord that replaces it. Douglas and Peucker,
/// Cartographica 10 (1973).
std::vector<int> thinnedByTolerance(std::span<const Vec2> points, std::span<const int> sharp, double tolerance);

}  // namespace batten
