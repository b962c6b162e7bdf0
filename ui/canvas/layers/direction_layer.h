// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// An arrow where the selected curve begins: the way in which its length is counted.
void paintDirection(QPainter&, const CanvasScene&);
/// The arrow itself. @param along of length 1
void paintDirectionArrow(QPainter&, QPointF tip, QPointF along);

}  // namespace batten
