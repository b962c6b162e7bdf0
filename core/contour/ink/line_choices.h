// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_choices.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// Notes on every line which choice of the user its ink follows (Contour::traceMode), and in the report which choices
/// lie near no ink or requested the middle of ink that has none.
/// @param regions what a choice holds for. @param blots ink that has no middle and is followed along its border.
/// @param pixelsPerPx of these pictures, along a pixel of the page.
void noteChoices(ContourSet& set, const RunPieces& regions, std::span<const EdgeChoice> choices, const BitImage& blots,
                 double pixelsPerPx, const RunContext& context);

/// Notes junctions chosen by the user that are not found: a choice near no junction waits for one; a pair of places
/// that are not on two branches is left out. Where lines were made of several strokes, junctions are not known.
void noteJunctionChoices(ContourSet& set, const EdgeParams& edges);

/// Adds a sentence to the note of the report.
void addNote(ContourSet& set, const std::string& sentence);

}  // namespace batten
