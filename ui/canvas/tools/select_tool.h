// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Click selects a curve, says whether an extremum is kept, pairs the strokes of a marked junction, or shows the
/// targets of a span of the selected curve.
std::unique_ptr<CanvasTool> makeSelectTool(CanvasScene&);

}  // namespace batten
