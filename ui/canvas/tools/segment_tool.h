// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Sets the places where typical curves meet.
std::unique_ptr<CanvasTool> makeSegmentTool(CanvasScene&);

}  // namespace batten
