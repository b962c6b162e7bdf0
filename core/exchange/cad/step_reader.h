// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// Reads the curves of a STEP file (AP203, AP214, AP242), whoever wrote it: B-splines, rational or not, Bézier and
/// quasi-uniform curves, lines, circles, ellipses, polylines, trimmed and composite curves and edges between vertices;
/// z left out. Curves are those of its geometric sets, else those of its edges, else all that stand by themselves.
/// Where parts of an assembly are placed elsewhere, they come where they were drawn. What else is a curve is counted in
/// `left`. Takes time in proportion to the file; hears a cancel. A parser of its own: CAD libraries do not survive
/// damaged files.
/// @return BadParameter if it is no STEP file or damaged: the message says where.
Result<CadDrawing> parseStep(std::string_view text, const RunContext& context = {});

}  // namespace batten
