// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Click selects regions of the page; a drag, the wheel and keys change their thresholds.
std::unique_ptr<CanvasTool> makeThresholdTool(CanvasScene&);

}  // namespace batten
