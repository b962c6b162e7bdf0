// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>

#include "ui/canvas/scene/canvas_scene.h"

namespace batten {

/// Where the targets of the selected curve are split, and the span that is pointed at. Widget coordinates.
void paintSpans(QPainter&, const CanvasScene&);

}  // namespace batten
