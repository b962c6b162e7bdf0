// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Click on a junction: the next pairing of its strokes. Click on one of its branches, then on another: these
/// two are one stroke, or come apart.
std::unique_ptr<CanvasTool> makeJunctionTool(CanvasScene&);

}  // namespace batten
