// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// Lines cut into strokes.
struct HandStrokes {
  std::vector<MeanLine> strokes;
  std::vector<Vec2> turns;  ///< [px] where lines were cut.
};
/// Cuts the lines at sharp turns, because at a crossing of two bundles a line often turns from one into the other.
HandStrokes strokesOf(const std::vector<Contour>& lines, double distancePx);

/// Sets MeanLine::continues where another line continues within `nearPx`, about straight on.
void findContinuations(std::vector<MeanLine>& strokes, double nearPx);

}  // namespace batten
