// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// A number that a curve got, and places along its line, from start to end, as they were when it was last there.
struct NumberedCurve {
  int number = 0;                ///< >= 1; no other curve of the drawing ever gets it.
  std::vector<Vec2> placesPx{};  ///< One to kMostPlacesOfCurve.
  bool operator==(const NumberedCurve&) const = default;
};

/// The numbers given to the curves of a drawing so far: "Curve 3" is the same line after a threshold has moved, a
/// corner has been marked elsewhere or the drawing is opened again. No user's decision, so no undo takes it back.
struct CurveNumbers {
  int lastGiven = 0;                    ///< New curves are counted on from here.
  std::vector<NumberedCurve> curves{};  ///< Those of the last result by number, then those that it does not have.
  bool operator==(const CurveNumbers&) const = default;
};

inline constexpr std::size_t kMostPlacesOfCurve = 16;  // limit of input

}  // namespace batten
