// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Shows in which direction curves are exported and where they begin; click turns, drag of the ring of a closed line
/// moves its start.
std::unique_ptr<CanvasTool> makeDirectionTool(CanvasScene&);

}  // namespace batten
