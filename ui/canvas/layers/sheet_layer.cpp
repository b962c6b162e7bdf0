// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/sheet_layer.h"

#include <QPainterPath>
#include <QPolygonF>

namespace batten {

void paintSheet(QPainter& painter, const CanvasScene& scene) {
  const auto& page = scene.session.output().page;
  if (!page || !page->sheet || scene.session.recipe().preparation.sheet == SheetUse::Off) return;
  QPolygonF polygon;
  for (const Vec2& p : page->sheet->outlinePx) polygon.append(scene.transform.toWidget(p));
  QPainterPath inside, outside;
  inside.addPolygon(polygon);
  inside.closeSubpath();
  const QSize size = scene.transform.imageSize();
  outside.addRect(QRectF(scene.transform.toWidget({0.0, 0.0}),
                         scene.transform.toWidget({double(size.width()), double(size.height())})));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(218, 216, 211, 190));
  painter.drawPath(outside.subtracted(inside));
  painter.restore();
}

}  // namespace batten
