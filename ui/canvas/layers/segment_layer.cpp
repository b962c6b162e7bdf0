// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/segment_layer.h"

#include <QPainterPath>
#include <algorithm>

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintSegments(QPainter& painter, const CanvasScene& scene) {
  const auto& segments = scene.session.output().segments;
  if (!segments) return;
  const QRectF seen = scene.transform.visibleImage();
  const double tick = 3.0 * scene.transform.imagePerWidget();
  QPainterPath lines;
  for (const PieceSegments& piece : segments->pieces)
    for (const Station& station : piece.stations) {
      const Vec2 &a = station.from, &b = station.to;
      if (std::max(a.x(), b.x()) < seen.left() || std::min(a.x(), b.x()) > seen.right() ||
          std::max(a.y(), b.y()) < seen.top() || std::min(a.y(), b.y()) > seen.bottom())
        continue;
      const Vec2 across = tick * Vec2(-station.direction.y(), station.direction.x());
      lines.moveTo(a.x(), a.y());
      lines.lineTo(b.x(), b.y());
      for (const Vec2& end : {a, b}) {
        lines.moveTo(end.x() - across.x(), end.y() - across.y());
        lines.lineTo(end.x() + across.x(), end.y() + across.y());
      }
    }
  ImagePainter image(painter, scene);
  image.stroke(lines, colors::segment(), 1.2);
}

}  // namespace batten
