// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/corner/corner_marks.h"
#include "core/pipeline/recipe/curve_numbers.h"

namespace batten {

/// The number of every piece, and what is known of all numbers given so far, for the next time.
struct PieceNumbers {
  std::vector<int> ofPiece;  ///< One entry per piece, >= 1, all different.
  CurveNumbers known;
};

/// Gives every piece the number that its line had, else a new one. A line has kept its number if at least two of the
/// places noted for it lie on the piece: within 8 px, where no other piece is nearer. Where several lines would have a
/// piece the one with the most places on it within 1.5 px gets it, then within 8 px, then the oldest; each number goes
/// to one piece. So the longer part of a line that was divided keeps its number, and the whole gets it back. Pieces
/// without one are counted on from the last number given, in their order. A cancelled run gives no numbers.
PieceNumbers numberPieces(const PieceSet&, const CurveNumbers& known, const RunContext& context = {});

/// "Curve 3": how the window, reports and files call a curve.
std::string curveName(int number);
/// The number in a name of that kind; absent for other names.
std::optional<int> numberOfCurveName(std::string_view name);
/// Whether Batten made the name: "Curve 3" of a curve; "curve-3", "curve-3-2" or "curve-3-sketched" of a path.
bool isMadeName(std::string_view name);

}  // namespace batten
