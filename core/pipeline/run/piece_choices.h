// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// Which choices belong to which pieces.
struct ChoiceOwners {
  std::vector<std::optional<std::size_t>> ofPiece;  ///< One entry per piece: an index into the choices, or none.
  std::vector<std::size_t> waiting;  ///< Choices that say something but find no line now: kept until it is back.
};

/// The choices of all pieces, as runPipeline applies them and the window edits them. A choice belongs to every piece of
/// which more than half lies on the course of its anchors: within 8 px, where no other piece is nearer to the course,
/// and not past its ends. So the parts of a line that was split share its choice, and a line beside it does not. A
/// choice with a single anchor belongs to the nearest piece within 24 px. Of two choices for one piece the nearer one
/// counts, the later one of those about as near.
ChoiceOwners assignChoices(const PieceSet&, const std::vector<PieceChoice>&);

/// The choice to be edited for one piece, index into `choices`: its own one, which is made where there is none. Where
/// it shares one with other pieces it gets a copy, so that the others keep what they have.
std::size_t makeOwnChoice(std::vector<PieceChoice>& choices, const PieceSet&, std::size_t piece);

/// The extremum choices of every piece: each belongs to the nearest piece within 24 px. Indices into
/// recipe.extremumChoices, one list per piece.
std::vector<std::vector<std::size_t>> assignExtremumChoices(const PieceSet&, const Recipe&);

/// The place that stands for a piece: its point at half its points.
Vec2 anchorOf(const Piece&);

/// The anchors of a choice for a piece: few places between which the line runs straight to 1.5 px, in order, rounded to
/// 0.1 px. Of a closed line the first place is also the last.
std::vector<Vec2> anchorsOf(const Piece&);

/// The choices that compete for a curve's method and detail: those with one, and those made for a part of a line. No
/// others, so that the curves are not constructed again when those change.
std::vector<PieceChoice> choicesForMethods(const Recipe&);

}  // namespace batten
