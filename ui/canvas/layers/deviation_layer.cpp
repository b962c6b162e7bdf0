// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/deviation_layer.h"

#include <QPen>
#include <QPolygonF>
#include <algorithm>

namespace batten {

void paintDeviation(QPainter& painter, const CanvasScene& scene) {
  const CurveComb* comb = scene.selectedComb();
  const TracedCurve* traced = scene.session.selected();
  if (comb == nullptr || traced == nullptr || comb->whiskers.empty()) return;
  double largest = 0.0;
  for (const Whisker& whisker : comb->whiskers) largest = std::max(largest, whisker.mm);
  const double tolerance = traced->fairingUsed.toleranceMm;
  if (!(largest > 0.0) || !(tolerance > 0.0)) return;
  // Drawn larger than life, so that the tolerance is 28 px wide at any zoom but never smaller than it is.
  const double pxPerMm =
      std::max(28.0 / tolerance, 1.0 / scene.transform.imagePerWidget() / scene.combs->source.frame.mmPerPx);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF tips;
  for (const Whisker& whisker : comb->whiskers) {
    const QPointF foot = scene.transform.toWidget(whisker.toPx);
    const Vec2 offset = whisker.fromPx - whisker.toPx;
    const Vec2 unit = offset.norm() > 0.0 ? Vec2(offset / offset.norm()) : Vec2(0.0, 0.0);
    const QPointF tip = foot + QPointF(unit.x(), unit.y()) * (whisker.mm * pxPerMm);
    const double share = std::clamp(whisker.mm / tolerance, 0.0, 1.0);
    painter.setPen(QPen(QColor::fromHsvF(static_cast<float>(0.38 * (1.0 - share)), 0.85F, 0.72F), 1.4));
    painter.drawLine(foot, tip);
    tips.append(tip);
  }
  painter.setPen(QPen(QColor(60, 60, 60, 140), 1.0));
  painter.drawPolyline(tips);
  painter.restore();
}

}  // namespace batten
