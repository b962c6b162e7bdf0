// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/choice_layers.h"

#include <QPen>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

constexpr double kMarkRadius = 4.5, kRingRadius = 8.0;

bool sees(const QRectF& seen, const Vec2& px, double margin) {
  return px.x() >= seen.left() - margin && px.x() <= seen.right() + margin && px.y() >= seen.top() - margin &&
         px.y() <= seen.bottom() + margin;
}

void paintMark(QPainter& painter, const ExtremumMark& mark, QPointF at) {
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

}  // namespace

void paintExtrema(QPainter& painter, const CanvasScene& scene) {
  if (scene.extrema.empty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF seen = scene.transform.visibleImage();
  const double margin = 2.0 * kRingRadius * scene.transform.imagePerWidget();
  // What is kept lies over what was dropped.
  for (const bool kept : {false, true})
    for (const ExtremumMark& mark : scene.extrema)
      if (mark.isKept == kept && sees(seen, mark.px, margin))
        paintMark(painter, mark, scene.transform.toWidget(mark.px));
  painter.restore();
}

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
      if (!p.refined && sees(seen, p.at, 2.0)) dots.append(scene.transform.toWidget(p.at));
  painter.drawPoints(dots);
  painter.restore();
}

void paintRulings(QPainter& painter, const CanvasScene& scene) {
  const auto& page = scene.session.output().page;
  if (!page || page->rulings.empty() || scene.session.recipe().preparation.rulings == RulingUse::Keep) return;
  constexpr double kChoiceStepPx = 12.0;  // [widget px] the lines are nearly straight
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colors::ruling(), 1.0));
  for (const RulingFamily& family : page->rulings) {
    for (const RulingLine& line : family.lines) {
      QPolygonF shown;
      for (std::size_t i = 0; i < line.coursePx.size(); ++i) {
        const QPointF at = scene.transform.toWidget(line.coursePx[i]);
        const bool isEnd = i + 1 == line.coursePx.size();
        if (shown.isEmpty() || isEnd || (at - shown.last()).manhattanLength() >= kChoiceStepPx) shown.append(at);
      }
      painter.drawPolyline(shown);
    }
  }
  painter.restore();
}

void paintSheet(QPainter& painter, const CanvasScene& scene) {
  const auto& page = scene.session.output().page;
  if (!page || !page->sheet || scene.session.recipe().preparation.sheet == SheetUse::Off) return;
  QPolygonF polygon;
  for (const Vec2& p : page->sheet->outlinePx) polygon.append(scene.transform.toWidget(p));
  QPainterPath inside, outside;
  inside.addPolygon(polygon);
  inside.closeSubpath();
  const QSize size = scene.transform.imageSize();
  outside.addRect(QRectF(scene.transform.toWidget({0.0, 0.0}),
                         scene.transform.toWidget({double(size.width()), double(size.height())})));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(218, 216, 211, 190));
  painter.drawPath(outside.subtracted(inside));
  painter.restore();
}

void paintRegions(QPainter& painter, const CanvasScene& scene) {
  const auto& regions = scene.session.recipe().regions;
  if (regions.empty()) return;
  QPainterPath inside;
  inside.setFillRule(Qt::WindingFill);
  for (const RegionOfInterest& region : regions) {
    QPolygonF polygon;
    for (const Vec2& p : region.cornersPx) polygon.append(scene.transform.toWidget(p));
    QPainterPath one;
    one.addPolygon(polygon);
    one.closeSubpath();
    inside = inside.united(one);
  }
  const QSize page = scene.transform.imageSize();
  QPainterPath outside;
  outside.addRect(QRectF(scene.transform.toWidget({0.0, 0.0}),
                         scene.transform.toWidget({double(page.width()), double(page.height())})));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(218, 216, 211, 150));
  painter.drawPath(outside.subtracted(inside));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colors::accent(), 1.2, Qt::DashLine));
  painter.drawPath(inside);
  painter.restore();
}

}  // namespace batten
