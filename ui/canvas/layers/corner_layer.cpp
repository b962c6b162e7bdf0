// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/corner_layer.h"

#include <QPen>
#include <QPolygonF>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintCornerSquare(QPainter& painter, QPointF centre, double half, const QColor& color, bool filled) {
  painter.setPen(QPen(QColor(255, 255, 255, 200), 4.0, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
  painter.setBrush(Qt::NoBrush);
  const QRectF square(centre.x() - half, centre.y() - half, 2.0 * half, 2.0 * half);
  painter.drawRect(square);
  painter.setPen(QPen(color, 1.8, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
  painter.setBrush(filled ? QBrush(color) : QBrush(QColor(255, 255, 255, 170)));
  painter.drawRect(square);
}

void paintFoundCorner(QPainter& painter, QPointF centre, double half, const QColor& color) {
  const QPolygonF diamond(
      {centre + QPointF(0, -half), centre + QPointF(half, 0), centre + QPointF(0, half), centre + QPointF(-half, 0)});
  painter.setPen(QPen(QColor(255, 255, 255, 200), 3.5, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolygon(diamond);
  painter.setPen(QPen(color, 1.4, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
  painter.drawPolygon(diamond);
}

void paintCorners(QPainter& painter, const CanvasScene& scene) {
  const auto& pieces = scene.session.output().pieces;
  const auto& marks = scene.session.recipe().cornerMarks;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  if (pieces && !scene.session.isStale(StageId::Pieces)) {
    for (const Corner& corner : pieces->corners) {
      const QPointF at = scene.transform.toWidget(corner.positionPx);
      if (corner.mark) {
        paintCornerSquare(painter, at, 5.0, colors::corner(), false);
      } else {
        paintFoundCorner(painter, at, 5.0, colors::corner());
      }
    }
    for (const int lost : pieces->lostMarks) {
      if (lost < 0 || lost >= std::ssize(marks)) continue;
      const QPointF at = scene.transform.toWidget(marks[lost].positionPx);
      paintCornerSquare(painter, at, 5.0, colors::lost(), false);
      painter.drawLine(at + QPointF(-5, -5), at + QPointF(5, 5));
      painter.drawLine(at + QPointF(-5, 5), at + QPointF(5, -5));
    }
  } else {
    for (const CornerMark& mark : marks)
      paintCornerSquare(painter, scene.transform.toWidget(mark.positionPx), 5.0, colors::corner(), false);
  }
  painter.restore();
}

}  // namespace batten
