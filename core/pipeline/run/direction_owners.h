// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// What the direction and start marks of a recipe mean for the pieces of a drawing.
struct DirectionOwners {
  struct Direction {
    std::size_t mark = 0;     ///< Index into Recipe::directions.
    bool isReversed = false;  ///< The curve is to run the other way than its piece.
  };
  std::vector<std::optional<Direction>> ofPiece;        ///< One entry per piece.
  std::map<int, std::size_t> startOfContour;            ///< By contour: index into Recipe::starts.
  std::vector<std::size_t> lostDirections, lostStarts;  ///< Marks near which no line lies: indices into the recipe's.
};

/// Each mark belongs to the piece nearest to it within 24 px; of several for one piece, or one contour, the last
/// counts.
DirectionOwners assignDirections(const PieceSet&, const Recipe&);

/// The mark that makes the curve of a piece run the other way than it does with the marks there are: at half its
/// points. It takes the place of those that belong to the piece.
void reverseDirection(Recipe&, const PieceSet&, std::size_t piece);

/// Begins the closed line of a piece at a place; takes the place of the mark that the line had.
void setStart(Recipe&, const PieceSet&, std::size_t piece, const Vec2& px);

}  // namespace batten
