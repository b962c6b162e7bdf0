// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Widths of strokes, bundles of merged ones, bridged gaps.
void paintStrokes(QPainter&, const CanvasScene&);

}  // namespace batten
