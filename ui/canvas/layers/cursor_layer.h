// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// The place that canvas and plots have in common, with its quill while combs are shown.
void paintCursor(QPainter&, const CanvasScene&);

}  // namespace batten
