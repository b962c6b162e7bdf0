// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The ink pixels at which the 8-neighbour Laplacian of the binary picture (000 Eq 2) changes sign: those with at least
/// one paper pixel among their 8 neighbours; outside the page counts as paper. Shown as the "edges" layer; the cracks
/// between these pixels and the paper are what traceContours follows.
Result<BitImage> laplacianEdges(const BitImage& ink, const RunContext&);

}  // namespace batten
