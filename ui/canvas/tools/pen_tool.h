// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Draws lines by hand, which are traced with those of the scan; a click selects a line, and Del removes it.
std::unique_ptr<CanvasTool> makePenTool(CanvasScene&);

}  // namespace batten
