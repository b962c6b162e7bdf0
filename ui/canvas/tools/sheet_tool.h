// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// The corners of the sheet: each can be dragged, Enter rectifies the page by them.
std::unique_ptr<CanvasTool> makeSheetTool(CanvasScene&);

}  // namespace batten
