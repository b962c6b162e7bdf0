// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The parts of centre lines that lie in their ink or within the larger of 2 px and half a width of it, or in a
/// declared bridge between two such parts: a line is cut where it runs over paper unannounced. Order kept.
std::vector<Contour> keepOnInk(std::vector<Contour> lines, const BitImage& ink);

}  // namespace batten
