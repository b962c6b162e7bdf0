// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Curvature extrema of the selected curve: filled = certain, half = probable, hollow = dropped, ringed = the user's.
void paintExtrema(QPainter&, const CanvasScene&);

/// One mark at a place of the view.
void paintExtremum(QPainter&, const ExtremumMark&, QPointF at);

}  // namespace batten
