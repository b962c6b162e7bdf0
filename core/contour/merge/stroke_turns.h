// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// Lines as strokes of the hand.
struct HandStrokes {
  std::vector<MeanLine> strokes;
  std::vector<Vec2> turns;  ///< [px] where lines were cut.
};
/// Cuts the lines where they turn sharply, since at a crossing of bundles a line often turns from the one into the
/// other.
HandStrokes strokesOf(const std::vector<Contour>& lines, double distancePx);

/// Finds the ends at which another line goes on (MeanLine::continues): within this many px, about straight on.
void findContinuations(std::vector<MeanLine>& strokes, double nearPx);

}  // namespace batten
