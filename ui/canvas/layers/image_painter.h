// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QPainterPath>
#include <functional>

#include "ui/canvas/scene/canvas_scene.h"

namespace batten {

/// An open path through places [image px]; one place alone is a dot.
/// @param at the place of one of the points.
template <class Points, class At = std::identity>
QPainterPath pathThrough(const Points& points, const At& at = {}) {
  QPainterPath path;
  for (const auto& point : points) {
    const Vec2& p = std::invoke(at, point);
    if (path.elementCount() == 0) path.moveTo(p.x(), p.y());
    path.lineTo(p.x(), p.y());
  }
  return path;
}

/// Paints in image px with pens whose width is given in widget px, until it is destroyed.
class ImagePainter {
 public:
  ImagePainter(QPainter& painter, const CanvasScene& scene);
  ~ImagePainter() { painter_.restore(); }
  ImagePainter(const ImagePainter&) = delete;
  ImagePainter& operator=(const ImagePainter&) = delete;

  void stroke(const QPainterPath& path, const QColor& color, double width, Qt::PenStyle style = Qt::SolidLine);
  void fill(const QPainterPath& path, const QColor& color);
  /// Whether a box [image px] reaches into the view.
  bool sees(const QRectF& bounds) const;

 private:
  QPainter& painter_;
  double unit_;
  QRectF seen_;
};

}  // namespace batten
