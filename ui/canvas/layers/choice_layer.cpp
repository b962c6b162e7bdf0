// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/choice_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintChoice(QPainter& painter, const CanvasScene& scene, const CurveShape& shape) {
  QColor color = shape.isIncluded ? colors::corner() : colors::accent();
  color.setAlpha(110);
  ImagePainter image(painter, scene);
  image.stroke(shape.sketched, color, 8.0);
}

}  // namespace batten
