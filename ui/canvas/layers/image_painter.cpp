// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/image_painter.h"

#include <QPen>

namespace batten {

ImagePainter::ImagePainter(QPainter& painter, const CanvasScene& scene)
    : painter_(painter), unit_(scene.transform.imagePerWidget()), seen_(scene.transform.visibleImage()) {
  painter_.save();
  painter_.setRenderHint(QPainter::Antialiasing);
  const double ratio = scene.transform.ratio();
  painter_.translate(QPointF(scene.transform.origin()) / ratio);
  painter_.scale(scene.transform.zoom() / ratio, scene.transform.zoom() / ratio);
  painter_.setBrush(Qt::NoBrush);
}

void ImagePainter::stroke(const QPainterPath& path, const QColor& color, double width, Qt::PenStyle style) {
  painter_.setPen(QPen(color, width * unit_, style, Qt::RoundCap, Qt::RoundJoin));
  painter_.drawPath(path);
}

void ImagePainter::fill(const QPainterPath& path, const QColor& color) {
  painter_.setPen(Qt::NoPen);
  painter_.setBrush(color);
  painter_.drawPath(path);
  painter_.setBrush(Qt::NoBrush);
}

bool ImagePainter::sees(const QRectF& bounds) const {
  const double margin = 4.0 * unit_;
  // A straight line has a flat box, which QRectF::intersects would call empty.
  return bounds.left() <= seen_.right() + margin && bounds.right() >= seen_.left() - margin &&
         bounds.top() <= seen_.bottom() + margin && bounds.bottom() >= seen_.top() - margin;
}

}  // namespace batten
