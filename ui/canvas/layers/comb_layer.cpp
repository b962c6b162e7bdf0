// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/comb_layer.h"

#include <QPen>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/canvas/scene/comb_runs.h"

namespace batten {
namespace {

/// The line through the tips; it breaks off where quills are cut, and runs on dotted over a long stretch of them.
void paintEnvelope(QPainter& painter, const std::vector<CombPoint>& points, const std::vector<CombRun>& runs,
                   const CombScale& scale, const ViewTransform& transform) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const CombRun& run = runs[r];
    if (run.isSpike) continue;
    QPolygonF line;
    line.reserve(static_cast<qsizetype>(run.last - run.first + 3));
    if (!run.isCut && r > 0 && runs[r - 1].isCut)
      line.append(combTip(combCrossing(points[run.first], points[run.first - 1], scale), scale, transform));
    for (std::size_t i = run.first; i <= run.last; ++i) line.append(combTip(points[i], scale, transform));
    if (!run.isCut && r + 1 < runs.size() && runs[r + 1].isCut)
      line.append(combTip(combCrossing(points[run.last], points[run.last + 1], scale), scale, transform));
    QPen pen = painter.pen();
    pen.setStyle(run.isCut ? Qt::DotLine : Qt::SolidLine);
    painter.setPen(pen);
    painter.drawPolyline(line);
  }
}

/// Says that a quill goes on: two short strokes aslant across its end.
void paintCut(QPainter& painter, QPointF foot, QPointF tip) {
  const QPointF quill = tip - foot;
  const double length = std::hypot(quill.x(), quill.y());
  if (!(length > 0.0)) return;
  const QPointF along = quill / length, across(-along.y(), along.x());
  const QPointF aslant = 4.0 * across + 2.0 * along;
  for (const double back : {0.0, 4.0}) {
    const QPointF at = tip - back * along;
    painter.drawLine(at - aslant, at + aslant);
  }
}

/// What the noise of the scan leaves open of the curvature: +-2 standard deviations about the comb's tips.
void paintNoise(QPainter& painter, const CanvasScene& scene, const std::vector<CombPoint>& points,
                const CombScale& scale) {
  if (std::none_of(points.begin(), points.end(),
                   [](const CombPoint& point) { return point.sigma.value_or(0.0) > 0.0; }))
    return;
  QColor fill = colors::sketched();
  fill.setAlpha(54);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  for (const CombRun& run : combRuns(points, scale)) {
    // Where the comb is cut there is nothing for it to lie about.
    if (run.isCut) continue;
    QPolygonF noise;
    noise.reserve(2 * static_cast<qsizetype>(run.last - run.first + 1));
    const auto edge = [&](CombPoint point, double side) {
      point.kappa += side * 2.0 * point.sigma.value_or(0.0);
      noise.append(combTip(point, scale, scene.transform));
    };
    for (std::size_t i = run.first; i <= run.last; ++i) edge(points[i], 1.0);
    for (std::size_t i = run.last + 1; i-- > run.first;) edge(points[i], -1.0);
    painter.drawPolygon(noise, Qt::WindingFill);
  }
}

void paintComb(QPainter& painter, const CanvasScene& scene, const CurveComb& comb, const CombScale& scale,
               bool isSelected) {
  const ViewTransform& transform = scene.transform;
  if (isSelected && scene.view.isVisible(Layer::Band)) {
    paintNoise(painter, scene, comb.isFaired ? comb.sketched : comb.points, scale);
  }
  if (!comb.sketched.empty() && scene.view.isVisible(Layer::Curve)) {
    painter.setPen(QPen(colors::sketchedFaint(), 1.0));
    paintEnvelope(painter, comb.sketched, combRuns(comb.sketched, scale), scale, transform);
  }
  const std::vector<CombRun> runs = combRuns(comb.points, scale);
  QColor color = colors::accent();
  color.setAlpha(isSelected ? 120 : 60);
  painter.setPen(QPen(color, 0.8));
  const int quills = scene.view.combDensity();
  QVector<QLineF> lines;
  lines.reserve(quills);
  const double last = static_cast<double>(comb.points.size() - 1);
  auto run = runs.begin();
  for (int i = 0; i < quills; ++i) {
    const std::size_t at = std::lround(last * i / (quills - 1));
    while (run->last < at) ++run;
    if (run->isSpike) continue;
    lines.append(QLineF(transform.toWidget(comb.points[at].px), combTip(comb.points[at], scale, transform)));
  }
  painter.drawLines(lines);
  color.setAlpha(isSelected ? 255 : 130);
  painter.setPen(QPen(color, isSelected ? 1.3 : 1.0));
  paintEnvelope(painter, comb.points, runs, scale, transform);
  painter.setPen(QPen(color, 1.0));
  for (const CombRun& cut : runs) {
    if (!cut.isCut) continue;
    const CombPoint& peak = comb.points[cut.peak];
    const QPointF foot = transform.toWidget(peak.px), tip = combTip(peak, scale, transform);
    if (cut.isSpike) painter.drawLine(foot, tip);
    paintCut(painter, foot, tip);
  }
}

/// Extrema: a short bar across the comb's tip. Inflections: a small diamond on the curve.
void paintMarks(QPainter& painter, const CanvasScene& scene, const CurveComb& comb, const CombScale& scale) {
  const ViewTransform& transform = scene.transform;
  for (const CombMark& mark : comb.marks) {
    const QPointF foot = transform.toWidget(mark.px);
    if (mark.isInflection) {
      paintInflection(painter, foot);
      continue;
    }
    // A quill that is cut says so itself.
    if (scale.cuts(mark.kappa)) continue;
    CombPoint point;
    point.px = mark.px, point.outPx = mark.outPx, point.kappa = mark.kappa;
    const QPointF tip = combTip(point, scale, transform);
    const QPointF across(-mark.outPx.y() * 6.0, mark.outPx.x() * 6.0);
    painter.setPen(QPen(colors::accent(), 1.0));
    painter.drawLine(foot, tip);
    painter.setPen(QPen(colors::accent(), 2.0));
    painter.drawLine(tip - across, tip + across);
  }
}

}  // namespace

void paintInflection(QPainter& painter, QPointF at) {
  painter.setPen(QPen(colors::accent(), 1.3));
  painter.setBrush(Qt::white);
  painter.drawPolygon(
      QPolygonF({at + QPointF(0, -4.5), at + QPointF(4.5, 0), at + QPointF(0, 4.5), at + QPointF(-4.5, 0)}));
}

CombScale combScale(const CanvasScene& scene) {
  const CurveComb* reference = scene.selectedComb();
  if (reference == nullptr)
    for (const CurveComb& comb : scene.combs->combs)
      if (reference == nullptr || comb.extentPx > reference->extentPx) reference = &comb;
  if (reference == nullptr) return {};
  const double extentMm = scene.combs->source.frame.lengthToModel(reference->extentPx);
  if (!(reference->robustKappa * extentMm > kStraightCurvature)) return {};
  const QSizeF view = QSizeF(scene.transform.viewSize()) / scene.transform.ratio();
  // By the sketched curve, so that fairing does not change the scale under the eye.
  const auto curves = scene.session.curves();
  const int at = reference->index;
  const int extrema = at >= 0 && at < std::ssize(curves) ? curves[at].sketchedFigures.extrema : 0;
  const double lengthPx = reference->lengthMm / scene.combs->source.frame.lengthToModel(1.0);
  const CombedCurve curve{reference->robustKappa, reference->extentPx, lengthPx, extrema};
  const double viewPx = std::min(view.width(), view.height()) * scene.transform.imagePerWidget();
  return scene.view.combShowsRadius() ? radiusScaleFor(curve, reference->points, scene.view.combScale(), viewPx)
                                      : combScaleFor(curve, scene.view.combScale(), viewPx);
}

QPointF combTip(const CombPoint& point, const CombScale& scale, const ViewTransform& transform) {
  return transform.toWidget(point.px + scale.heightOf(point.kappa) * point.outPx);
}

void paintCombs(QPainter& painter, const CanvasScene& scene) {
  if (!scene.combs || scene.combs->combs.empty()) return;
  const CombScale scale = combScale(scene);
  if (scale.isEmpty()) return;
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

}  // namespace batten
