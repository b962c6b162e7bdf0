// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Marks corners; the selected one is the session's, so that the list in the panel shows the same.
std::unique_ptr<CanvasTool> makeCornerTool(CanvasScene&);

}  // namespace batten
