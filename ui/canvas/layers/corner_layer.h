// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Corners as squares where the user marked them, as diamonds where they were found; marks without a line crossed out.
void paintCorners(QPainter&, const CanvasScene&);
/// A square: a corner that a mark asks for. @param half its side, halved [widget px]
void paintCornerSquare(QPainter&, QPointF centre, double half, const QColor& color, bool filled);
/// A diamond: a corner that no mark asked for.
void paintFoundCorner(QPainter& painter, QPointF centre, double half, const QColor& color);

}  // namespace batten
