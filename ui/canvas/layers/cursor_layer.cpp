// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/cursor_layer.h"

#include <QPen>

#include "ui/canvas/layers/comb_layer.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintCursor(QPainter& painter, const CanvasScene& scene) {
  const auto s = scene.session.cursor();
  const CurveComb* comb = scene.selectedComb();
  if (!s || comb == nullptr) return;
  const CombPoint place = comb->at(*s);
  const QPointF foot = scene.transform.toWidget(place.px);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const CombScale scale = scene.areCombsShown() ? combScale(scene) : CombScale{};
  if (!scale.isEmpty()) {
    painter.setPen(QPen(colors::accent(), 1.2));
    painter.drawLine(foot, combTip(place, scale, scene.transform));
  }
  painter.setPen(QPen(colors::accent(), 2.0));
  painter.setBrush(Qt::white);
  painter.drawEllipse(foot, 4.0, 4.0);
  painter.restore();
}

}  // namespace batten
