// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// Reads the LINE, ARC, CIRCLE, ELLIPSE, SPLINE (by control points), LWPOLYLINE and POLYLINE entities of an ASCII DXF
/// of any version, in the order of the file, z left out; what cannot be read is counted in `left`. Entities inside
/// blocks are not read. An independent parser, so that it verifies what the library wrote.
/// @return BadParameter if it is not a DXF or damaged: the message says where.
Result<CadDrawing> readDxf(std::string_view text);

}  // namespace batten
