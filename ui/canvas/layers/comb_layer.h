// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"
#include "ui/canvas/scene/comb_runs.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Curvature combs of all curves, and the marks on that of the selected one.
void paintCombs(QPainter&, const CanvasScene&);
/// One scale for all curves, so that combs can be compared; empty where no comb can be drawn. @pre combs are there
CombScale combScale(const CanvasScene&);
/// Where the quill of a point ends [widget px].
QPointF combTip(const CombPoint&, const CombScale&, const ViewTransform&);

/// The mark of an inflection at a place of the view.
void paintInflection(QPainter&, QPointF at);

}  // namespace batten
