// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/sketched_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/growing_player.h"

namespace batten {

void paintSketched(QPainter& painter, const CanvasScene& scene) {
  if (!scene.shapes) return;
  ImagePainter image(painter, scene);
  const auto selected = scene.session.selectedCurve();
  for (std::size_t i = 0; i < scene.shapes->curves.size(); ++i) {
    const CurveShape& shape = scene.shapes->curves[i];
    if (!image.sees(shape.bounds)) continue;
    const bool isSelected = static_cast<int>(i) == selected;
    if (!shape.isIncluded) {
      image.stroke(shape.sketched, colors::casing(), 2.6);
      image.stroke(shape.sketched, colors::sketched(), 1.0, Qt::DotLine);
      continue;
    }
    if (scene.isResultShown()) {
      // Under both lines, so that neither border covers the other line.
      image.stroke(shape.sketched, colors::casing(), isSelected ? 4.4 : 3.6);
      if (!shape.faired.isEmpty()) image.stroke(shape.faired, colors::casing(), isSelected ? 4.4 : 3.6);
      image.stroke(shape.sketched, colors::sketched(), isSelected ? 1.8 : 1.4);
      continue;
    }
    if (isSelected) image.stroke(shape.sketched, colors::halo(), 8.0);
    // A pale border keeps the line apart from the ink that it follows: what was traced and what was missed is seen.
    image.stroke(shape.sketched, colors::casing(), isSelected ? 4.4 : 3.6);
    // What grows is drawn over it.
    const bool isWatched = isSelected && scene.session.growing().isOpen();
    image.stroke(shape.sketched, isWatched ? colors::sketchedFaint() : colors::accent(), isSelected ? 2.2 : 1.5);
  }
}

}  // namespace batten
