// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/invented_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/explanation_source.h"

namespace batten {

void paintInvented(QPainter& painter, const CanvasScene& scene) {
  const auto explanation = scene.session.explanation().found();
  if (!explanation) return;
  ImagePainter image(painter, scene);
  for (const InventedStretch& stretch : explanation->inventions) {
    const QPainterPath path = pathThrough(stretch.linePx);
    if (!image.sees(path.controlPointRect())) continue;
    // Wide enough that a stretch of a few pixels is found on the whole page.
    image.stroke(path, colors::casing(), 7.0);
    image.stroke(path, colors::invented(), 4.0);
  }
}

}  // namespace batten
