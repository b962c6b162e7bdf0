// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// A diamond: a corner that no mark asked for.
void paintFoundCorner(QPainter& painter, QPointF centre, double half, const QColor& color);
void paintCorners(QPainter&, const CanvasScene&);
/// Where the user wants typical curves to meet.
void paintSegmentPoints(QPainter&, const CanvasScene&);
void paintRegionGrid(QPainter&, const CanvasScene&);
void paintCornerSquare(QPainter&, QPointF centre, double half, const QColor& color, bool filled);

}  // namespace batten
