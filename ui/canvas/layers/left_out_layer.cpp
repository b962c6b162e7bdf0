// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/left_out_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintLeftOut(QPainter& painter, const CanvasScene& scene) {
  if (!scene.shapes) return;
  ImagePainter image(painter, scene);
  for (const CurveShape& shape : scene.shapes->curves) {
    if (shape.isIncluded || !image.sees(shape.bounds)) continue;
    image.stroke(shape.sketched, QColor(255, 255, 255, 170), 3.0);
    image.stroke(shape.sketched, colors::corner(), 1.4, Qt::DotLine);
  }
}

}  // namespace batten
