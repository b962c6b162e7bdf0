// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Leads the ends of centre lines that lie in the ink of another line (Contour::endsInInk) on to that line, or back to
/// it where they run past: to the middle of a stroke, to the border of a shape. A skeleton leans towards a branch where
/// one joins, so that its junctions lie beside the middle of the stroke that goes through; and a stroke that leaves
/// another one gradually has a middle of its own only where it has left it. An end is led on as it bends; where it
/// would only come close, it touches. An end from which no line is met within the ink stays where it is.
/// @param grey of the page on which the lines lie: where it pales between the two, only blur joins them.
void leadToLines(std::vector<Contour>& lines, const GreyImage& grey, const RunContext& context);

}  // namespace batten
