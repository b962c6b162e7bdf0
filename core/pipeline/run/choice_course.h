// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/corner/corner_marks.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// A choice as a piece has it that lies on the course of its anchors. What the choice says along the line is said in
/// the direction of its anchors; steps before it may hand the line on the other way round, begin a closed one
/// elsewhere, or divide it. So the drawn profile is brought to the piece's direction (its curvatures change their sign
/// with it), begun where the piece begins and cut to the part that the piece has; the holds of both ends change places
/// where the piece runs against the course. What lies by place on the page needs no turning and stays. A line that has
/// only been moved a little keeps the choice exactly: ends within 3 % of the course are the same end. A choice with a
/// single anchor knows no direction and is returned as it is.
PieceChoice alongPiece(PieceChoice choice, const Piece& piece);

}  // namespace batten
