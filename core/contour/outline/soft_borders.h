// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// A tone laid up to an edge and fading out on its other sides has a border all round, but a line only where it is
/// sharp. Cuts the soft stretches out of a refined outline: where the grey changes over 22 px more than twice as much
/// as over 6 px, for 30 px and more of the way. What is left are open lines, in order of travel; an outline without
/// soft stretches, and one that is soft nearly all round, comes back as it was. The border of the page counts as soft
/// where something else does, else as sharp.
std::vector<Contour> cutSoftBorders(const Contour& outline, const GreyImage& grey, const RunContext& context);

}  // namespace batten
