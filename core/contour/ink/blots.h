// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/contour/ink/ink_split.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// Pieces of stroke ink that no line follows. What a pencil drew is one only where it is wider than its strokes: the
/// rest are specks. What the user wants to be longer is a short line.
/// @param rows dots of broken lines, which are no specks.
/// @param minWidths ContourParams::minWidths.
BitImage findBlots(const InkSplit&, const ContourSet& lines, const BitImage& rows, double minWidths, const RunContext&);

/// What may be the dashes and dots of broken lines: strokes too short to be kept by themselves, in rows.
/// @param minWidths ContourParams::minWidths.
BitImage findRows(const InkSplit&, double minWidths, const RunContext&);

/// Places of pen strokes that are wider than the pen, and that the lines with their widths leave out: what strokes
/// enclose and fill, knots, scribbles. Ink that two strokes across each other could hold is none, nor is what lines
/// that run through a ribbon of ink leave out of it in places. Up to the strokes, which stay strokes. Of what a pencil
/// drew, only places where a solid goes on.
BitImage findFillings(const InkSplit&, const ContourSet& lines, const RunContext&);

/// Of blots, those in regions that the user chose for: where the page is followed along its middles, no others are.
BitImage chosenOf(const BitImage& blots, const RunPieces& regions, const EdgeParams&);
/// Of fillings, those that the user neither painted nor chose to be followed along their middle.
BitImage notChosen(BitImage fillings, const RunPieces& regions, const std::optional<BitImage>& painted,
                   const EdgeParams&);

}  // namespace batten
