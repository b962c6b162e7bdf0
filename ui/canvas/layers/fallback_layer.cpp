// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/fallback_layer.h"

#include <QPen>
#include <QPolygonF>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintFallback(QPainter& painter, const CanvasScene& scene) {
  const auto& contours = scene.session.output().contours;
  if (!contours) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QColor color = colors::target();
  color.setAlpha(200);
  painter.setPen(QPen(color, 3.0, Qt::SolidLine, Qt::RoundCap));
  const QRectF seen = scene.transform.visibleImage();
  QPolygonF dots;
  for (const Contour& contour : contours->contours)
    for (const ContourPoint& p : contour.points)
      if (!p.refined && isWithin(seen, p.at, 2.0)) dots.append(scene.transform.toWidget(p.at));
  painter.drawPoints(dots);
  painter.restore();
}

}  // namespace batten
