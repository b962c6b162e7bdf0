// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/contour/label/label_rules.h"

namespace batten {

/// What one piece of ink brings to the vote.
struct PieceVote {
  bool isMostlyShape = false;        ///< More than half of its area.
  std::optional<InkLabel> decision;  ///< All of it; absent = as its paths say.
};

/// One treatment for pieces that are alike in size and in width, as the letters of an alphabet: where one pen width
/// does not explain them they were drawn with a broad nib or a brush and are shapes; else most of them decide.
/// @param votes one per piece, with `isMostlyShape` set; `decision` is filled in.
/// @param pixelsPerPx of the ink, along a pixel of the page: narrower contrasts are no nib's.
void voteAmongAlike(std::vector<PieceVote>& votes, const InkGraph&, const PiecesOfPage&, double pageDiagonalPx,
                    double pixelsPerPx);

}  // namespace batten
