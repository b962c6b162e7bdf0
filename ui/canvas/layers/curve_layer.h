// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QPainterPath>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

void paintSegments(QPainter&, const CanvasScene&);
/// The pinned result and the curves with uniform knots, thin.
void paintOverlay(QPainter&, const CanvasScene&);
void paintSketched(QPainter&, const CanvasScene&);
void paintFaired(QPainter&, const CanvasScene&);
/// Widths of strokes, bands of merged ones, bridged gaps.
void paintStrokes(QPainter&, const CanvasScene&);
/// Lines that the user has left out, so that they can be found again.
void paintLeftOut(QPainter&, const CanvasScene&);
/// A line that a click would leave out (red) or take in (blue).
void paintChoice(QPainter&, const CanvasScene&, const CurveShape&);
/// The hovered target, dashed.
void paintGhost(QPainter&, const CanvasScene&, const QPainterPath& ghost);

}  // namespace batten
