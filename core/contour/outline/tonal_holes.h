// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Drops inner borders of areas that a pencil filled where no edge was drawn, but its tone gets lighter: those that are
/// much fainter than the outer borders, and ragged ones that the ends of hatching make.
/// Counts them in the report as holes. Outlines whose ink the user chose stay.
void dropTonalHoles(ContourSet&, const GreyImage&, const RunContext&);

}  // namespace batten
