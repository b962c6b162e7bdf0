// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"

namespace batten {

/// Drops lines that are the edge of a sheet in the picture, or the shadow along it, and counts them in the report as
/// margins: those that are long, lie near the border of the page all along, and so are nearly straight, and have
/// nothing drawn beyond or close by. Lines whose ink the user chose stay, and so does the only line.
void dropPageEdgeLines(ContourSet&, int pageWidth, int pageHeight);

}  // namespace batten
