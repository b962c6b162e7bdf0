// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// Reads the curves of an IGES file (5.3 and before, ASCII), whoever wrote it: entities 126 (rational B-spline), 110
/// (line), 100 (arc), 104 (ellipse), 106 (points and linear paths) and 112 (parametric spline), moved by their matrices
/// (124), z left out. The curves of a composite (102) come in its order, the others in that of the directory. Blanked
/// curves and those in the parameter space of a surface are passed over; what else is no curve is counted in `left`.
/// Takes time in proportion to the file; hears a cancel. A parser of its own: no library of CAD stands damaged files.
/// @return BadParameter if it is no IGES or damaged: the message says where.
Result<CadDrawing> parseIges(std::string_view text, const RunContext& context = {});

}  // namespace batten
