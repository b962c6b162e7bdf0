// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The parts of centre lines that lie in their ink or within the larger of 2 px and half a width of it, or in a
/// declared bridge between two such parts: a line is cut where it runs over paper unannounced. Order kept.
/// @param pixelsPerPx of the ink, along a pixel of the page (fine_page.h), whose pixels the 2 px are.
std::vector<Contour> keepOnInk(std::vector<Contour> lines, const BitImage& ink, double pixelsPerPx = 1.0);

}  // namespace batten
