// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/curve_layer.h"

#include <QPen>
#include <algorithm>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/growing_player.h"

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
  void fill(const QPainterPath& path, const QColor& color) {
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(color);
    painter_.drawPath(path);
    painter_.setBrush(Qt::NoBrush);
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

QRectF boundsOf(const std::vector<ContourPoint>& points) {
  if (points.empty()) return {};
  Vec2 low = points.front().at, high = low;
  for (const ContourPoint& p : points) {
    low = low.cwiseMin(p.at);
    high = high.cwiseMax(p.at);
  }
  return QRectF(QPointF(low.x(), low.y()), QPointF(high.x(), high.y()));
}

/// What a line covers to its left and right at a point; nothing where that is not known. [px]
std::optional<StrokeBand> widthAt(const ContourPoint& p) {
  if (!p.widthPx) return std::nullopt;
  return StrokeBand{0.5f * *p.widthPx, 0.5f * *p.widthPx};
}

/// The ground that a line covers, by `coverAt` of its points.
template <class CoverAt>
QPainterPath ribbon(const Contour& line, const CoverAt& coverAt) {
  const std::size_t n = line.points.size();
  QPolygonF left, right;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : line.closed ? n - 1 : 0;
    const std::size_t after = i + 1 < n ? i + 1 : line.closed ? 0 : n - 1;
    const Vec2 along = line.points[after].at - line.points[before].at;
    const std::optional<StrokeBand> cover = coverAt(line.points[i]);
    if (!cover || !(along.norm() > 0.0)) continue;
    const Vec2 out = leftNormal(along) / along.norm();
    const Vec2 a = line.points[i].at + static_cast<double>(cover->left) * out;
    const Vec2 b = line.points[i].at - static_cast<double>(cover->right) * out;
    left.append(QPointF(a.x(), a.y()));
    right.append(QPointF(b.x(), b.y()));
  }
  QPainterPath path;
  path.setFillRule(line.closed ? Qt::OddEvenFill : Qt::WindingFill);
  if (left.size() < 2) return path;
  if (line.closed) {
    path.addPolygon(left);
    path.closeSubpath();
    path.addPolygon(right);
  } else {
    std::reverse(right.begin(), right.end());
    path.addPolygon(left + right);
  }
  path.closeSubpath();
  return path;
}

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
      // What grows is drawn over it.
      const bool isWatched = scene.session.growing().isOpen();
      image.stroke(shape.sketched, isWatched ? colors::sketchedFaint() : colors::accent(), 1.8);
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

void paintLeftOut(QPainter& painter, const CanvasScene& scene) {
  if (!scene.shapes) return;
  ImagePainter image(painter, scene);
  for (const CurveShape& shape : scene.shapes->curves) {
    if (shape.isIncluded || !image.sees(shape.bounds)) continue;
    image.stroke(shape.sketched, QColor(255, 255, 255, 170), 3.0);
    image.stroke(shape.sketched, colors::corner(), 1.4, Qt::DotLine);
  }
}

void paintChoice(QPainter& painter, const CanvasScene& scene, const CurveShape& shape) {
  QColor color = shape.isIncluded ? colors::corner() : colors::accent();
  color.setAlpha(110);
  ImagePainter image(painter, scene);
  image.stroke(shape.sketched, color, 8.0);
}

void paintGhost(QPainter& painter, const CanvasScene& scene, const QPainterPath& ghost) {
  ImagePainter image(painter, scene);
  image.stroke(ghost, QColor(255, 255, 255, 150), 3.2);
  image.stroke(ghost, colors::target(), 1.7, Qt::DashLine);
}

void paintStrokes(QPainter& painter, const CanvasScene& scene) {
  const auto& contours = scene.session.output().contours;
  if (!contours) return;
  ImagePainter image(painter, scene);
  for (const Contour& line : contours->contours) {
    if (!image.sees(boundsOf(line.points))) continue;
    image.fill(ribbon(line, [](const ContourPoint& p) { return p.band; }), QColor(200, 112, 0, 70));
    image.fill(ribbon(line, widthAt), QColor(20, 130, 80, 60));
    for (const auto& [first, last] : line.bridges) {
      QPainterPath bridge;
      for (int i = std::max(0, first); i <= last && i < static_cast<int>(line.points.size()); ++i) {
        const Vec2& p = line.points[i].at;
        if (bridge.elementCount() == 0) bridge.moveTo(p.x(), p.y());
        bridge.lineTo(p.x(), p.y());
      }
      image.stroke(bridge, QColor(255, 255, 255, 200), 4.5);
      image.stroke(bridge, colors::target(), 2.0, Qt::DashLine);
    }
  }
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
