// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Takes out lines that are the edge of a sheet in the picture, or the shadow along it, into
/// ContourSet::sheetEdges, and counts them in the report as margins: those that are long, lie near the border of the
/// page all along, and so are nearly straight, and have nothing drawn beyond or close by. Farther from the border the
/// page must also be brighter on one side than on the other along most of them, and together the pieces of an edge that
/// is found in parts must be long. So are straight lines right across the picture near its border that paper dims
/// towards and that nothing comes near: the gutter of a book. Lines whose ink the user chose stay, and so does the only
/// line.
void dropPageEdgeLines(ContourSet&, const GreyImage&);

}  // namespace batten
