// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QString>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

enum class ChipPlace { TopLeft, TopRight, BottomLeft, BottomRight };
/// A text in a corner of the view; none where it is empty.
void paintChip(QPainter&, const CanvasScene&, const QString& text, ChipPlace);
/// A small label beside a place.
void paintLabel(QPainter&, const CanvasScene&, const QString& text, QPointF beside);

}  // namespace batten
