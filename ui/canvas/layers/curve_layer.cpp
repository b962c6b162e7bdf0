// SPDX-License-Identifier: GPL-3.0-or-later
#include <QPen>
#include <algorithm>

#include "ui/canvas/canvas_colors.h"
#include "ui/canvas/layers/vector_layers.h"

namespace batten {
namespace {

/// Paints in image px with pens whose width is given in widget px.
class ImagePainter {
 public:
  ImagePainter(QPainter& painter, const CanvasScene& scene)
      : painter_(painter), unit_(scene.transform.imagePerWidget()), seen_(scene.transform.visibleImage()) {
    painter_.save();
    painter_.setRenderHint(QPainter::Antialiasing);
    const double ratio = scene.transform.ratio();
    painter_.translate(QPointF(scene.transform.origin()) / ratio);
    painter_.scale(scene.transform.zoom() / ratio, scene.transform.zoom() / ratio);
    painter_.setBrush(Qt::NoBrush);
  }
  ~ImagePainter() { painter_.restore(); }
  ImagePainter(const ImagePainter&) = delete;
  ImagePainter& operator=(const ImagePainter&) = delete;

  void stroke(const QPainterPath& path, const QColor& color, double width, Qt::PenStyle style = Qt::SolidLine) {
    painter_.setPen(QPen(color, width * unit_, style, Qt::RoundCap, Qt::RoundJoin));
    painter_.drawPath(path);
  }
  bool sees(const QRectF& bounds) const {
    const double margin = 4.0 * unit_;
    // A straight line has a flat box, which QRectF::intersects would call empty.
    return bounds.left() <= seen_.right() + margin && bounds.right() >= seen_.left() - margin &&
           bounds.top() <= seen_.bottom() + margin && bounds.bottom() >= seen_.top() - margin;
  }

 private:
  QPainter& painter_;
  double unit_;
  QRectF seen_;
};

bool fairedIsShown(const CanvasScene& scene, const CurveShape& shape) {
  return scene.view.isVisible(Layer::Faired) && !shape.faired.isEmpty();
}

}  // namespace

void paintOverlay(QPainter& painter, const CanvasScene& scene) {
  if (!scene.overlay) return;
  ImagePainter image(painter, scene);
  if (!scene.overlay->uniform.isEmpty()) image.stroke(scene.overlay->uniform, colors::uniform(), 1.2);
  if (!scene.overlay->pinned.isEmpty()) image.stroke(scene.overlay->pinned, colors::pinned(), 1.2);
}

void paintSketched(QPainter& painter, const CanvasScene& scene) {
  if (!scene.shapes) return;
  ImagePainter image(painter, scene);
  const int selected = scene.session.selectedCurve();
  for (std::size_t i = 0; i < scene.shapes->curves.size(); ++i) {
    const CurveShape& shape = scene.shapes->curves[i];
    if (!image.sees(shape.bounds)) continue;
    const bool isSelected = static_cast<int>(i) == selected;
    if (!shape.isIncluded) {
      image.stroke(shape.sketched, colors::sketchedFaint(), 1.0, Qt::DotLine);
      continue;
    }
    if (isSelected && !fairedIsShown(scene, shape)) {
      image.stroke(shape.sketched, colors::halo(), 7.0);
      image.stroke(shape.sketched, colors::accent(), 1.8);
    } else {
      image.stroke(shape.sketched, colors::sketched(), isSelected ? 1.8 : 1.4);
    }
  }
}

void paintFaired(QPainter& painter, const CanvasScene& scene) {
  if (!scene.shapes) return;
  ImagePainter image(painter, scene);
  const int selected = scene.session.selectedCurve();
  for (std::size_t i = 0; i < scene.shapes->curves.size(); ++i) {
    const CurveShape& shape = scene.shapes->curves[i];
    if (shape.faired.isEmpty() || !shape.isIncluded || !image.sees(shape.bounds)) continue;
    const bool isSelected = static_cast<int>(i) == selected;
    if (isSelected) image.stroke(shape.faired, colors::halo(), 7.0);
    image.stroke(shape.faired, colors::accent(), isSelected ? 2.2 : 1.5);
  }
}

void paintGhost(QPainter& painter, const CanvasScene& scene, const QPainterPath& ghost) {
  ImagePainter image(painter, scene);
  image.stroke(ghost, QColor(255, 255, 255, 150), 3.2);
  image.stroke(ghost, colors::target(), 1.7, Qt::DashLine);
}

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
