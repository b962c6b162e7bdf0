// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/merge/overlap_removal.h"

namespace batten {

/// Joins pieces into lines. Where pieces meet, those with matching positions and directions continue as one line; a
/// remainder no longer than twice `distancePx` is an overshoot and is dropped. Lines that share a short stretch
/// continue at its other end as they came. Free ends that face each other within the distance are joined, and a line
/// that meets itself is closed. A single stroke that leaves the others smoothly and ends counts as an overshoot up to a
/// greater length. `widestPx` is the largest distance that strokes are merged over in the end. Not complete when
/// cancelled.
std::vector<MeanLine> joinPieces(RemainingLines pieces, double distancePx, double widestPx, const RunContext& context);

}  // namespace batten
