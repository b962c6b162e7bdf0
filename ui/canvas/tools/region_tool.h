// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Drag draws a region of interest: a rectangle, or freely.
std::unique_ptr<CanvasTool> makeRegionTool(CanvasScene&, bool isLasso);

}  // namespace batten
