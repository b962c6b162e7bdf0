// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// The lines as strokes of the hand: cut where they turn sharply, since at a crossing of bundles a line often turns
/// from the one into the other. `turns` gets the places of the cuts.
std::vector<MeanLine> strokesOf(const std::vector<Contour>& lines, double distancePx, std::vector<Vec2>& turns);

/// Finds the ends at which another line goes on (MeanLine::continues): within this many px, about straight on.
void findContinuations(std::vector<MeanLine>& strokes, double nearPx);

}  // namespace batten
