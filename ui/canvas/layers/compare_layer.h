// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// The curves with uniform knots, thin; they lie under the others.
void paintUniform(QPainter&, const CanvasScene&);
/// The pinned result, dashed over the present curves, so that both are seen where they coincide.
void paintPinned(QPainter&, const CanvasScene&);

}  // namespace batten
