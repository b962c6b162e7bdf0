// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/direction_layer.h"

#include <QPen>
#include <QPolygonF>
#include <cmath>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintDirection(QPainter& painter, const CanvasScene& scene) {
  const CurveComb* comb = scene.selectedComb();
  if (comb == nullptr || comb->points.size() < 2) return;
  constexpr double kLong = 13.0, kClear = 10.0;  // [widget px]
  // Behind the mark of a corner, along the curve and not along its first pixel.
  const double pxPerMm = 1.0 / scene.combs->source.frame.lengthToModel(scene.transform.imagePerWidget());
  if (!(comb->lengthMm * pxPerMm > 3.0 * (kClear + kLong))) return;
  const QPointF from = scene.transform.toWidget(comb->at(kClear / pxPerMm).px);
  const QPointF to = scene.transform.toWidget(comb->at((kClear + kLong) / pxPerMm).px);
  const double length = std::hypot(to.x() - from.x(), to.y() - from.y());
  if (!(length > 0.0)) return;
  const QPointF along = (to - from) / length;
  paintDirectionArrow(painter, from + kLong * along, along);
}

void paintDirectionArrow(QPainter& painter, QPointF tip, QPointF along) {
  constexpr double kBack = 6.0, kHalf = 5.0;  // [widget px]
  const QPointF across(-along.y(), along.x()), heel = tip - (kBack + kHalf) * along;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(Qt::white, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(colors::accent());
  painter.drawPolygon(QPolygonF({tip, heel + kHalf * across, heel + 0.35 * kBack * along, heel - kHalf * across}));
  painter.restore();
}

}  // namespace batten
