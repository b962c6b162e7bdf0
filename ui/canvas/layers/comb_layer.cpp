// SPDX-License-Identifier: GPL-3.0-or-later
#include <QPen>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "ui/canvas/canvas_colors.h"
#include "ui/canvas/layers/vector_layers.h"

namespace batten {
namespace {

constexpr double kAutomaticHeight = 0.13;  ///< Of the curve's extent, for the 95 % curvature at scale 1.
constexpr double kLargestHeight = 2.0;     ///< Automatic heights; a spike does not fill the drawing.

/// Height [image px] per curvature [mm]: one scale for all curves, so that combs can be compared.
struct CombScale {
  double pxPerKappa = 0.0, limitPx = 0.0;
};
CombScale combScale(const CanvasScene& scene) {
  const CurveComb* reference = scene.selectedComb();
  if (reference == nullptr)
    for (const CurveComb& comb : scene.combs->combs)
      if (reference == nullptr || comb.extentPx > reference->extentPx) reference = &comb;
  if (reference == nullptr) return {};
  const double extentMm = scene.combs->source.frame.lengthToModel(reference->extentPx);
  if (!(reference->robustKappa * extentMm > kStraightCurvature)) return {};
  const double height = kAutomaticHeight * reference->extentPx * scene.view.combScale();
  return {height / reference->robustKappa, kLargestHeight * height};
}

QPointF tipOf(const CombPoint& point, const CombScale& scale, const ViewTransform& transform) {
  const double height = std::clamp(point.kappa * scale.pxPerKappa, -scale.limitPx, scale.limitPx);
  return transform.toWidget(point.px + height * point.outPx);
}

QPolygonF envelope(const std::vector<CombPoint>& points, const CombScale& scale, const ViewTransform& transform) {
  QPolygonF line;
  line.reserve(static_cast<qsizetype>(points.size()));
  for (const CombPoint& point : points) line.append(tipOf(point, scale, transform));
  return line;
}

/// What the noise of the scan leaves open of the curvature: +-2 standard deviations about the comb's tips.
void paintBand(QPainter& painter, const CanvasScene& scene, const std::vector<CombPoint>& points,
               const CombScale& scale) {
  if (std::none_of(points.begin(), points.end(), [](const CombPoint& point) { return point.sigma > 0.0; })) return;
  QPolygonF band;
  band.reserve(2 * static_cast<qsizetype>(points.size()));
  const auto edge = [&](CombPoint point, double side) {
    point.kappa += side * 2.0 * point.sigma;
    band.append(tipOf(point, scale, scene.transform));
  };
  for (const CombPoint& point : points) edge(point, 1.0);
  for (auto point = points.rbegin(); point != points.rend(); ++point) edge(*point, -1.0);
  QColor fill = colors::sketched();
  fill.setAlpha(54);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  painter.drawPolygon(band, Qt::WindingFill);
}

void paintComb(QPainter& painter, const CanvasScene& scene, const CurveComb& comb, const CombScale& scale,
               bool isSelected) {
  const ViewTransform& transform = scene.transform;
  if (isSelected && scene.view.isVisible(Layer::Band)) {
    paintBand(painter, scene, comb.isFaired ? comb.sketched : comb.points, scale);
  }
  if (!comb.sketched.empty() && scene.view.isVisible(Layer::Curve)) {
    painter.setPen(QPen(colors::sketchedFaint(), 1.0));
    painter.drawPolyline(envelope(comb.sketched, scale, transform));
  }
  QColor color = colors::accent();
  color.setAlpha(isSelected ? 120 : 60);
  painter.setPen(QPen(color, 0.8));
  const int quills = scene.view.combDensity();
  QVector<QLineF> lines;
  lines.reserve(quills);
  const double last = static_cast<double>(comb.points.size() - 1);
  for (int i = 0; i < quills; ++i) {
    const auto& point = comb.points[static_cast<std::size_t>(std::lround(last * i / (quills - 1)))];
    lines.append(QLineF(transform.toWidget(point.px), tipOf(point, scale, transform)));
  }
  painter.drawLines(lines);
  color.setAlpha(isSelected ? 255 : 130);
  painter.setPen(QPen(color, isSelected ? 1.3 : 1.0));
  painter.drawPolyline(envelope(comb.points, scale, transform));
}

/// Extrema: a short bar across the comb's tip. Inflections: a small diamond on the curve.
void paintMarks(QPainter& painter, const CanvasScene& scene, const CurveComb& comb, const CombScale& scale) {
  const ViewTransform& transform = scene.transform;
  for (const CombMark& mark : comb.marks) {
    const QPointF foot = transform.toWidget(mark.px);
    if (mark.isInflection) {
      painter.setPen(QPen(colors::accent(), 1.3));
      painter.setBrush(Qt::white);
      painter.drawPolygon(QPolygonF(
          {foot + QPointF(0, -4.5), foot + QPointF(4.5, 0), foot + QPointF(0, 4.5), foot + QPointF(-4.5, 0)}));
      continue;
    }
    CombPoint point;
    point.px = mark.px, point.outPx = mark.outPx, point.kappa = mark.kappa;
    const QPointF tip = tipOf(point, scale, transform);
    const QPointF across(-mark.outPx.y() * 6.0, mark.outPx.x() * 6.0);
    painter.setPen(QPen(colors::accent(), 1.0));
    painter.drawLine(foot, tip);
    painter.setPen(QPen(colors::accent(), 2.0));
    painter.drawLine(tip - across, tip + across);
  }
}

}  // namespace

void paintCombs(QPainter& painter, const CanvasScene& scene) {
  if (!scene.combs || scene.combs->combs.empty()) return;
  const CombScale scale = combScale(scene);
  if (!(scale.pxPerKappa > 0.0)) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const CurveComb* selected = scene.selectedComb();
  for (const CurveComb& comb : scene.combs->combs)
    if (!comb.points.empty() && &comb != selected) paintComb(painter, scene, comb, scale, false);
  if (selected != nullptr) {
    paintComb(painter, scene, *selected, scale, true);
    paintMarks(painter, scene, *selected, scale);
  }
  painter.restore();
}

void paintDeviation(QPainter& painter, const CanvasScene& scene) {
  const CurveComb* comb = scene.selectedComb();
  const TracedCurve* traced = scene.session.selected();
  if (comb == nullptr || traced == nullptr || comb->whiskers.empty()) return;
  double largest = 0.0;
  for (const Whisker& whisker : comb->whiskers) largest = std::max(largest, whisker.mm);
  const double budget = traced->fairingUsed.toleranceMm;
  if (!(largest > 0.0) || !(budget > 0.0)) return;
  // Drawn larger than life, so that the budget is 28 px wide at any zoom but never smaller than it is.
  const double pxPerMm =
      std::max(28.0 / budget, 1.0 / scene.transform.imagePerWidget() / scene.combs->source.frame.mmPerPx);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF tips;
  for (const Whisker& whisker : comb->whiskers) {
    const QPointF foot = scene.transform.toWidget(whisker.toPx);
    const Vec2 way = whisker.fromPx - whisker.toPx;
    const Vec2 unit = way.norm() > 0.0 ? Vec2(way / way.norm()) : Vec2(0.0, 0.0);
    const QPointF tip = foot + QPointF(unit.x(), unit.y()) * (whisker.mm * pxPerMm);
    const double share = std::clamp(whisker.mm / budget, 0.0, 1.0);
    painter.setPen(QPen(QColor::fromHsvF(static_cast<float>(0.38 * (1.0 - share)), 0.85F, 0.72F), 1.4));
    painter.drawLine(foot, tip);
    tips.append(tip);
  }
  painter.setPen(QPen(QColor(60, 60, 60, 140), 1.0));
  painter.drawPolyline(tips);
  painter.restore();
}

void paintCursor(QPainter& painter, const CanvasScene& scene) {
  const auto s = scene.session.cursor();
  const CurveComb* comb = scene.selectedComb();
  if (!s || comb == nullptr) return;
  const CombPoint place = comb->at(*s);
  const QPointF foot = scene.transform.toWidget(place.px);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const CombScale scale = scene.view.isVisible(Layer::Comb) ? combScale(scene) : CombScale{};
  if (scale.pxPerKappa > 0.0) {
    painter.setPen(QPen(colors::accent(), 1.2));
    painter.drawLine(foot, tipOf(place, scale, scene.transform));
  }
  painter.setPen(QPen(colors::accent(), 2.0));
  painter.setBrush(Qt::white);
  painter.drawEllipse(foot, 4.0, 4.0);
  painter.restore();
}

}  // namespace batten
