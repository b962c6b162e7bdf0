// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/stroke_layer.h"

#include <QPolygonF>
#include <algorithm>
#include <optional>
#include <span>

#include "ui/canvas/layers/image_painter.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

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
std::optional<BundleWidths> widthAt(const ContourPoint& p) {
  if (!p.widthPx) return std::nullopt;
  return BundleWidths{0.5f * *p.widthPx, 0.5f * *p.widthPx};
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
    const std::optional<BundleWidths> cover = coverAt(line.points[i]);
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

}  // namespace

void paintStrokes(QPainter& painter, const CanvasScene& scene) {
  const auto& contours = scene.session.output().contours;
  if (!contours) return;
  ImagePainter image(painter, scene);
  for (const Contour& line : contours->contours) {
    if (!image.sees(boundsOf(line.points))) continue;
    image.fill(ribbon(line, [](const ContourPoint& p) { return p.bundle; }), QColor(200, 112, 0, 70));
    image.fill(ribbon(line, widthAt), QColor(20, 130, 80, 60));
    for (const auto& [first, last] : line.bridges) {
      const int begin = std::max(0, first), end = std::min(last + 1, static_cast<int>(line.points.size()));
      if (begin >= end) continue;
      const QPainterPath bridge = pathThrough(std::span(line.points).subspan(begin, end - begin), &ContourPoint::at);
      image.stroke(bridge, QColor(255, 255, 255, 200), 4.5);
      image.stroke(bridge, colors::target(), 2.0, Qt::DashLine);
    }
  }
}

}  // namespace batten
