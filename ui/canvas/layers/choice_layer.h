// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// A line that a click would leave out (red) or take in (blue).
void paintChoice(QPainter&, const CanvasScene&, const CurveShape&);

}  // namespace batten
