// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Drag over ink paints its trace mode. Shows which ink is traced as what.
std::unique_ptr<CanvasTool> makePaintTool(CanvasScene&);

}  // namespace batten
