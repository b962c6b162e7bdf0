// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/bits/run_pieces.h"

namespace batten {

/// findPieces() of what is set in `from` and not in `without`, which is as large, without an image of it.
RunPieces findPiecesOfDifference(const BitImage& from, const BitImage& without, Connectivity connectivity,
                                 const RunContext& context);

}  // namespace batten
