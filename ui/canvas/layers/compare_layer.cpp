// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/compare_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintOverlay(QPainter& painter, const CanvasScene& scene) {
  if (!scene.overlay) return;
  ImagePainter image(painter, scene);
  if (!scene.overlay->uniform.isEmpty()) image.stroke(scene.overlay->uniform, colors::uniform(), 1.2);
  if (!scene.overlay->pinned.isEmpty()) image.stroke(scene.overlay->pinned, colors::pinned(), 1.2);
}

}  // namespace batten
