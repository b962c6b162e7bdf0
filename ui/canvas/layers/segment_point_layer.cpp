// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/segment_point_layer.h"

#include <QPen>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintSegmentPoints(QPainter& painter, const CanvasScene& scene) {
  const auto& recipe = scene.session.recipe();
  if (recipe.construct.method != ConstructMethod::Typical && scene.view.tool() != Tool::Segments) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const SegmentPoint& point : recipe.segmentPoints) {
    const QPointF at = scene.transform.toWidget(point.positionPx);
    painter.setPen(QPen(Qt::white, 1.6));
    painter.setBrush(colors::segment());
    painter.drawEllipse(at, 4.5, 4.5);
  }
  painter.restore();
}

}  // namespace batten
