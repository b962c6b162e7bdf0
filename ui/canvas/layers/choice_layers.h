// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Curvature extrema of the selected curve: filled = certain, half = probable, hollow = dropped, ringed = the user's.
void paintExtrema(QPainter&, const CanvasScene&);
/// Points that could not be placed on the grey values.
void paintFallback(QPainter&, const CanvasScene&);
/// Printed lines of the paper that were left out, faintly.
void paintRulings(QPainter&, const CanvasScene&);
/// What lies beside the sheet of a photograph, veiled.
void paintSheet(QPainter&, const CanvasScene&);
/// The regions of interest; what lies outside is veiled.
void paintRegions(QPainter&, const CanvasScene&);

}  // namespace batten
