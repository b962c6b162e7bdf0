// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QString>

#include "ui/canvas/scene/canvas_scene.h"

/// Painters take a painter in widget coordinates and leave its state as it was.
namespace batten {

enum class ChipPlace { TopLeft, TopRight, BottomLeft, BottomRight };
/// A text in a corner of the view; none where it is empty. It makes way for the mouse, so that what lies beneath can be
/// seen and clicked.
void paintChip(QPainter&, const CanvasScene&, const QString& text, ChipPlace);
/// The same in the first corner where it does not lie on the page; none where the page fills all of them.
void paintChipBesidePage(QPainter&, const CanvasScene&, const QString& text);
/// Whether the mouse may lie on a chip there, or did: the view is to be painted again when it moves.
bool isBesideChips(const CanvasScene&, QPointF mouse);
/// A small label beside a place.
void paintLabel(QPainter&, const CanvasScene&, const QString& text, QPointF beside);

}  // namespace batten
