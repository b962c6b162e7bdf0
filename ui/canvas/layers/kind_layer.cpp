// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/kind_layer.h"

#include <algorithm>
#include <vector>

#include "core/base/statistics.h"
#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

constexpr int kKindAlpha = 130, kCourseAlpha = 70;  // of 255: the ink below shows

QPainterPath pathOf(const Contour& line) {
  QPainterPath path = pathThrough(line.points, &ContourPoint::at);
  if (line.closed) path.closeSubpath();
  return path;
}

}  // namespace

QColor colourOf(EdgeMode mode) {
  return mode == EdgeMode::Outline      ? colors::shapeInk()
         : mode == EdgeMode::Centreline ? colors::strokeInk()
                                        : colors::pageInk();
}

void paintKinds(QPainter& painter, const CanvasScene& scene) {
  const auto& contours = scene.session.output().contours;
  if (!contours) return;
  ImagePainter image(painter, scene);
  QColor stroke = colors::strokeInk(), shape = colors::shapeInk();
  stroke.setAlpha(kKindAlpha);
  shape.setAlpha(kKindAlpha);
  QPainterPath shapes;
  shapes.setFillRule(Qt::OddEvenFill);
  for (const Contour& line : contours->contours) {
    if (line.kind == ContourKind::Outline && line.closed) shapes.addPath(pathOf(line));
    if (line.kind != ContourKind::Centreline) continue;
    const QPainterPath path = pathOf(line);
    std::vector<float> widths = strokeWidthsOf(line.points);
    const double widthPx = widths.empty() ? 0.0 : static_cast<double>(upperMedian(widths));
    if (image.sees(path.controlPointRect()))
      image.stroke(path, stroke, std::max(2.0, widthPx / scene.transform.imagePerWidget()));
  }
  image.fill(shapes, shape);
}

void paintCourse(QPainter& painter, const CanvasScene& scene, const PaintedInk& painted) {
  if (painted.coursePx.empty()) return;
  const QPainterPath path = pathThrough(painted.coursePx);
  ImagePainter image(painter, scene);
  QRectF bounds = path.controlPointRect();
  bounds.adjust(-painted.radiusPx, -painted.radiusPx, painted.radiusPx, painted.radiusPx);
  if (!image.sees(bounds)) return;
  QColor colour = colourOf(painted.mode);
  colour.setAlpha(kCourseAlpha);
  image.stroke(path, colour, 2.0 * painted.radiusPx / scene.transform.imagePerWidget());
}

void paintPainted(QPainter& painter, const CanvasScene& scene) {
  for (const PaintedInk& painted : scene.session.recipe().edges.painted) paintCourse(painter, scene, painted);
}

}  // namespace batten
