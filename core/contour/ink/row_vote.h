// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// The piece of ink that the middle of a stroke path lies in, as its first run.
std::optional<int> pieceOfPath(const RunPieces&, const StrokePath&);

/// The pieces of ink of a page, and what is known of them.
struct InkPieces {
  const RunPieces& pieces;               ///< Of all ink.
  const std::vector<StrokePath>& paths;  ///< Of all its strokes.
  const BitImage& labelled;              ///< What labelInk() takes for shapes, of all ink; may be those voted on.
  const BitImage* pencil;                ///< What a pencil drew, whole pieces; absent: pens drew all.
};

/// One treatment for the letters of a word and for a row of bars: pieces alike in the width of their strokes and in
/// height that stand beside one another, no further apart than they are high, and pieces that lie above one another and
/// are alike in width, are all strokes or all shapes, as most of them are by length and by number. Where pens drew most
/// of a row, what labelInk() says of all of it counts: grain in a part of it is a brush that ran dry. Two pieces are no
/// row, and ink that holds a larger disc than strokes of its width where they cross is solid and in none.
/// @param strokes, shapes: all ink; what changes is moved. Unfinished when cancelled.
void voteInRows(const InkPieces& ink, BitImage& strokes, BitImage& shapes, const RunContext& context);

}  // namespace batten
