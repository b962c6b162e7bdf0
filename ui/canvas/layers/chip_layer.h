// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QString>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

/// The facts in the corners of the view.
void paintChips(QPainter&, const CanvasScene&);
/// The texts of the chips; empty = nothing to say.
QString curveText(const CanvasScene&);
QString pageText(const CanvasScene&);
QString cursorText(const CanvasScene&);
QString workText(const CanvasScene&);

}  // namespace batten
