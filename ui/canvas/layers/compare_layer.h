// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// The pinned result and the curves with uniform knots, thin.
void paintOverlay(QPainter&, const CanvasScene&);

}  // namespace batten
