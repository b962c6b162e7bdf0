// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/compare_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintUniform(QPainter& painter, const CanvasScene& scene) {
  if (!scene.overlay || scene.overlay->uniform.isEmpty()) return;
  ImagePainter image(painter, scene);
  image.stroke(scene.overlay->uniform, colors::uniform(), 1.2);
}

void paintPinned(QPainter& painter, const CanvasScene& scene) {
  if (!scene.overlay || scene.overlay->pinned.isEmpty() || !scene.view.comparesPinned()) return;
  ImagePainter image(painter, scene);
  image.stroke(scene.overlay->pinned, colors::pinned(), 1.8, Qt::DashLine);
}

}  // namespace batten
