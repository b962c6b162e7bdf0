// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Click on an ink leaves it out or traces it again, Shift+click traces it alone.
std::unique_ptr<CanvasTool> makeInkTool(CanvasScene&);

}  // namespace batten
