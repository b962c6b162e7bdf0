// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

namespace batten {

/// Stretches of curves that have no ink under them. Painter in widget coordinates.
void paintInvented(QPainter&, const CanvasScene&);

}  // namespace batten
