// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/contour_set.h"

namespace batten {

/// Drops lines that are the margin of the scanner or the edge of the sheet: those that touch the border of the page
/// nearly all along; and straight ones that run along it near by, are long, and have nothing drawn beyond or close by.
/// @param pixelsPerPx lines as thin as that many px touch the border.
/// @return How many were dropped.
int dropPageBorderLines(std::vector<Contour>&, int pageWidth, int pageHeight, double pixelsPerPx);

}  // namespace batten
