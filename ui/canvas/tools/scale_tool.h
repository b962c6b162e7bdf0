// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Measures a known length: a drag, or two clicks. Ends can be dragged later.
std::unique_ptr<CanvasTool> makeScaleTool(CanvasScene&);

}  // namespace batten
