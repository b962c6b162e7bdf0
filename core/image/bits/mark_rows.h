// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Of small pieces of ink those that lie in a row: the dashes and dots of a broken line, which dirt is not. On both
/// sides of such a mark, in one direction, ink that is no broader begins after a gap of at most kMostMarkGap times its
/// length, and the two gaps are alike; the last mark of a row has a neighbour on one side only. A row has three members
/// at least, of which ends of longer lines count; marks near them and within 30 degrees of the row are of it, too. Rows
/// beside rows on all sides are a lattice and none: halftone, cloth.
/// @param marks the small pieces. @param ink all ink, these among it.
/// @return the marks that stay, whole pieces.
BitImage marksInRows(const BitImage& marks, const BitImage& ink, const RunContext& context);

/// [lengths of the mark] Dashes of a drawing are as long as their gaps or longer; dots are shorter.
inline constexpr double kMostMarkGap = 4.0;

}  // namespace batten
