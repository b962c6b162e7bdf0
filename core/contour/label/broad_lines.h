// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/label/ink_graph.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Gives back to the strokes what is shape along a broad line in a net of finer ones. Such a line is ink that hangs
/// together and is wider than lines of the page's pen where they cross; if more of its length is strokes than shapes,
/// and the shapes have no step in width against the strokes, all of it is one line, with the ends where it thins out.
/// @param penPx width of the page's pen. @param widestPenPx wider ink was not drawn with a pen.
/// @param shapes as the labels of the graph were painted. @return whether anything was relabelled.
bool releaseBroadLines(InkGraph& graph, double penPx, double widestPenPx, const BitImage& shapes);

}  // namespace batten
