// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// A drawing as a 3DM of version 3, which every Rhino since its third opens and OpenNURBS reads: every curve a NURBS
/// curve in the plane z = 0 with its name, on its layer, the unit from the drawing (mm or inch). Little-endian chunks
/// with CRC-32; knots without the first and the last, as OpenNURBS has them.
/// @pre clamped curves and no other shapes (see curvesOnly).
Result<std::string> writeRhino(const CadDrawing&);

/// The drawing with every line, arc and circle as the curve that it is.
Result<CadDrawing> curvesOnly(const CadDrawing&);

}  // namespace batten
