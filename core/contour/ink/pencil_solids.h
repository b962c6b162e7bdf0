// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The solids in the ink of a pencil whose grain is closed: what holds a disc of five pens and is a step wider than the
/// strokes that run into it. Where a stroke leaves without a step in width it is a taper of the solid, which goes on
/// along it; what is taper for the most part is no solid but a stroke that swells.
/// @param body all ink of the pencil. @param shapes what of it no pen width explains (labelInk).
/// @param penPx width of its strokes. Unfinished when cancelled.
BitImage pencilSolids(const BitImage& body, const BitImage& shapes, double penPx, const RunContext& context);

}  // namespace batten
