// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/cancel_check.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Cuts lines where they turn sharply at the scale of the stroke's width: what was drawn in several strokes was drawn
/// from corner to corner, and a merged line that runs on through a corner joins two of them. A corner turns by more
/// than 40 degrees between chords of 4 widths on either side, and by 24 more than a line that bends on as it does
/// beyond them, and most of it lies between chords of 2 widths; tight arcs stay whole. No part is shorter than 3
/// widths. The parts share the point of the cut; a closed line with one corner opens there. In the order of the lines.
/// @pre widthPx > 0.
std::vector<Contour> cutAtTurns(const std::vector<Contour>& lines, double widthPx, CancelCheck check = {});
/// The points of a line at which cutAtTurns() cuts it, ascending.
std::vector<int> sharpPlacesOf(const Contour& line, double widthPx);
/// The points from..to of a line, both included; of a closed one `to` may pass its end. Always open.
Contour cutPart(const Contour& line, int from, int to);

}  // namespace batten
