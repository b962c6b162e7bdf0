// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/extremum_layer.h"

#include <QPen>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

constexpr double kMarkRadius = 4.5, kRingRadius = 8.0;  // [widget px]

}  // namespace

void paintExtremum(QPainter& painter, const ExtremumMark& mark, QPointF at) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(255, 255, 255, 220), 4.0));
  painter.drawEllipse(at, kMarkRadius, kMarkRadius);
  const QColor color = mark.isKept ? colors::accent() : colors::sketched();
  QColor fill = mark.isKept ? color : QColor(255, 255, 255, 230);
  if (mark.isKept && !mark.isCertain) fill = QColor(168, 202, 240);
  painter.setPen(QPen(color, 1.6));
  painter.setBrush(fill);
  painter.drawEllipse(at, kMarkRadius, kMarkRadius);
  if (!mark.wantedToKeep) return;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colors::target(), 1.6));
  painter.drawEllipse(at, kRingRadius, kRingRadius);
  if (!*mark.wantedToKeep) painter.drawLine(at + QPointF(-5.6, 5.6), at + QPointF(5.6, -5.6));
}

void paintExtrema(QPainter& painter, const CanvasScene& scene) {
  if (scene.extrema.empty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF seen = scene.transform.visibleImage();
  const double margin = 2.0 * kRingRadius * scene.transform.imagePerWidget();
  // What is kept lies over what was dropped.
  for (const bool kept : {false, true})
    for (const ExtremumMark& mark : scene.extrema)
      if (mark.isKept == kept && isWithin(seen, mark.px, margin))
        paintExtremum(painter, mark, scene.transform.toWidget(mark.px));
  painter.restore();
}

}  // namespace batten
