// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Cuts the soft stretches out of a refined outline. A tone that ends at an edge and fades out on its other sides has a
/// border all round, but a line only where it is sharp. A stretch is soft where, over 30 px or more, the grey changes
/// more than twice as much within 22 px as within 6 px. The sharp stretches are returned as open lines in order of
/// travel. An outline without soft stretches, or one that is soft nearly all round, is returned unchanged. The border
/// of the page counts as soft if any other stretch is.
std::vector<Contour> cutSoftBorders(const Contour& outline, const GreyImage& grey, const RunContext& context);

}  // namespace batten
