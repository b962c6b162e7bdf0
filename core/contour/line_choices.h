// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_choices.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// Notes on every line which choice of the user its ink follows (Contour::traceMode), and in the report which choices
/// lie near no ink or asked for the middle of ink that has none.
/// @param regions what a choice holds for. @param blots ink that has no middle and is followed along its border.
void noteChoices(ContourSet& set, const RunPieces& regions, std::span<const EdgeChoice> choices, const BitImage& blots,
                 const RunContext& context);

/// Adds a sentence to the note of the report.
void addNote(ContourSet& set, const std::string& sentence);

}  // namespace batten
