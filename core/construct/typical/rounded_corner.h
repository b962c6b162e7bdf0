// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "core/construct/typical/typical_curve.h"

namespace batten {

/// A corner rounded by two typical curves (002 figure 6): the curvature rises to where they meet and falls behind it,
/// each way monotone.
struct RoundedCorner {
  std::array<TypicalCurve, 2> arcs;
  bool curvatureAtEnds = false;  ///< G2 at both ends; else G1 there, as towards straight lines.
};

/// The two arcs between a place before and a place behind a corner. They share place, direction and curvature where
/// they meet. Where both neighbours bend the way the corner turns, clearly enough for arcs to take their curvature, the
/// ends are G2; else G1 (a typical curve cannot start straight).
/// @param form 0.2..1: how evenly the corner is rounded. 1 is nearest to a circular arc, less is sharper in the middle.
/// Used where the ends are G1; G2 ends leave no choice.
/// @return absent where the directions do not meet ahead of the first and behind the second place, or the turn is
/// below 0.01 or above 3.0 radians.
std::optional<RoundedCorner> roundCorner(const Joint& before, const Joint& behind, double form);

}  // namespace batten
