// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/ghost_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintGhost(QPainter& painter, const CanvasScene& scene, const QPainterPath& ghost) {
  ImagePainter image(painter, scene);
  image.stroke(ghost, QColor(255, 255, 255, 150), 3.2);
  image.stroke(ghost, colors::target(), 1.7, Qt::DashLine);
}

}  // namespace batten
