// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QString>
#include <optional>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// Marks of the junctions that are doubtful or paired by hand; with the tool for them, small ones of all others.
void paintJunctions(QPainter&, const CanvasScene&);
/// How the strokes of a junction go through it: one line from branch to branch for each, a tick where one ends.
void paintPairs(QPainter&, const CanvasScene&, const StrokeJunction&);

/// Index of the junction whose mark is nearest to a place within `reachWidgetPx`. `marked`: of those alone that are
/// doubtful or paired by hand.
std::optional<int> junctionNear(const CanvasScene&, const Vec2& px, double reachWidgetPx, bool marked);
/// What is told of a junction under the mouse.
QString junctionHint(const CanvasScene&, const StrokeJunction&);

}  // namespace batten
