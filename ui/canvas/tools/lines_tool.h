// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Click leaves a line out of fairing and export, click again takes it in.
std::unique_ptr<CanvasTool> makeLinesTool(CanvasScene&);

}  // namespace batten
