// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/centreline/stroke_paths.h"

namespace batten {

/// Bridges the gaps between stroke ends: joins free ends that face each other and are each other's best partner. The
/// length of a gap (EdgeParams::gapFactor) is measured from ink to ink.
void bridgeGaps(std::vector<StrokePath>& paths, const BitImage& ink, const EdgeParams& params,
                const RunContext& context);

}  // namespace batten
