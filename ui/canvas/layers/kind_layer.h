// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

namespace batten {

/// Which ink is traced as what: strokes as wide as they are, shapes filled. Painter in widget coordinates.
void paintKinds(QPainter&, const CanvasScene&);
/// What the user has painted.
void paintPainted(QPainter&, const CanvasScene&);
/// A course as wide as the brush, in the colour of what it makes of ink.
void paintCourse(QPainter&, const CanvasScene&, const PaintedInk&);
QColor colourOf(EdgeMode);

}  // namespace batten
