// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/region_of_interest_layer.h"

#include <QPainterPath>
#include <QPen>
#include <QPolygonF>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintRegions(QPainter& painter, const CanvasScene& scene) {
  const auto& regions = scene.session.recipe().regions;
  if (regions.empty()) return;
  QPainterPath inside;
  inside.setFillRule(Qt::WindingFill);
  for (const RegionOfInterest& region : regions) {
    QPolygonF polygon;
    for (const Vec2& p : region.cornersPx) polygon.append(scene.transform.toWidget(p));
    QPainterPath one;
    one.addPolygon(polygon);
    one.closeSubpath();
    inside = inside.united(one);
  }
  const QSize page = scene.transform.imageSize();
  QPainterPath outside;
  outside.addRect(QRectF(scene.transform.toWidget({0.0, 0.0}),
                         scene.transform.toWidget({double(page.width()), double(page.height())})));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(218, 216, 211, 150));
  painter.drawPath(outside.subtracted(inside));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colors::accent(), 1.2, Qt::DashLine));
  painter.drawPath(inside);
  painter.restore();
}

}  // namespace batten
