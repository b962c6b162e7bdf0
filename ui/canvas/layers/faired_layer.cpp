// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/faired_layer.h"

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintFaired(QPainter& painter, const CanvasScene& scene) {
  if (!scene.isResultShown()) return;
  ImagePainter image(painter, scene);
  const auto selected = scene.session.selectedCurve();
  for (std::size_t i = 0; i < scene.shapes->curves.size(); ++i) {
    const CurveShape& shape = scene.shapes->curves[i];
    if (!shape.isIncluded || !image.sees(shape.bounds)) continue;
    const bool isSelected = static_cast<int>(i) == selected;
    // One that fairing left as it was is a result like the others.
    const QPainterPath& result = shape.faired.isEmpty() ? shape.sketched : shape.faired;
    // Where the sketched curves are hidden, nobody has drawn the border that keeps a line apart from its ink.
    if (!scene.view.isVisible(Layer::Curve)) image.stroke(result, colors::casing(), isSelected ? 4.4 : 3.6);
    if (isSelected) image.stroke(result, colors::halo(), 7.0);
    image.stroke(result, colors::accent(), isSelected ? 2.2 : 1.5);
  }
}

}  // namespace batten
