// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QString>

#include "ui/canvas/canvas_scene.h"

/// Painters of what lies over the pixels. All take a painter in widget coordinates and leave its state as it was.
namespace batten {

void paintSegments(QPainter&, const CanvasScene&);
/// The pinned result and the curves with uniform knots, thin.
void paintOverlay(QPainter&, const CanvasScene&);
void paintSketched(QPainter&, const CanvasScene&);
void paintFaired(QPainter&, const CanvasScene&);
void paintCombs(QPainter&, const CanvasScene&);
void paintDeviation(QPainter&, const CanvasScene&);
void paintCorners(QPainter&, const CanvasScene&);
/// Where the user wants typical curves to meet.
void paintSegmentPoints(QPainter&, const CanvasScene&);
/// The step of the growing chain that is played.
void paintGrowing(QPainter&, const CanvasScene&);
/// Curvature extrema of the selected curve: filled = certain, half = probable, hollow = dropped, ringed = the user's.
void paintExtrema(QPainter&, const CanvasScene&);
/// Widths of strokes, bands of merged ones, bridged gaps.
void paintStrokes(QPainter&, const CanvasScene&);
/// Points that could not be placed on the grey values.
void paintFallback(QPainter&, const CanvasScene&);
/// The regions of interest; what lies outside is veiled.
void paintRegions(QPainter&, const CanvasScene&);
void paintRegionGrid(QPainter&, const CanvasScene&);
/// Lines that the user has left out, so that they can be found again.
void paintLeftOut(QPainter&, const CanvasScene&);
/// A line that a click would leave out (red) or take in (blue).
void paintChoice(QPainter&, const CanvasScene&, const CurveShape&);
/// The hovered target, dashed.
void paintGhost(QPainter&, const CanvasScene&, const QPainterPath& ghost);
/// The place that canvas and plots have in common.
void paintCursor(QPainter&, const CanvasScene&);

void paintCornerSquare(QPainter&, QPointF centre, double half, const QColor& color, bool filled);

enum class ChipPlace { TopLeft, TopRight, BottomLeft, BottomRight };
void paintChip(QPainter&, const CanvasScene&, const QString& text, ChipPlace);
/// A small label beside a place.
void paintLabel(QPainter&, const CanvasScene&, const QString& text, QPointF beside);
/// The facts in the corners of the view.
void paintChips(QPainter&, const CanvasScene&);
void paintDropHint(QPainter&, const CanvasScene&);

/// The texts of the chips; empty = nothing to say.
QString curveText(const CanvasScene&);
QString pageText(const CanvasScene&);
QString cursorText(const CanvasScene&);
QString workText(const CanvasScene&);

}  // namespace batten
