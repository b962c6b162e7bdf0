// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

/// A drawing as DXF, ASCII: AutoCAD 2000, or R12 for the profile Cnc, with $INSUNITS and $MEASUREMENT from its unit (mm
/// or inch), a layer of its own colour per kind of curve and, but in R12, the name of every entity as extended data of
/// the application BATTEN. Splines are clamped and planar (flag 8), never flagged closed or periodic, which readers
/// unwrap differently; weights only where they differ. Characters beyond ASCII as \U+XXXX.
/// @pre clamped curves; polylines only for Cnc.
Result<std::string> writeDxf(const CadDrawing&, DxfProfile);

}  // namespace batten
