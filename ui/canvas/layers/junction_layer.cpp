// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/junction_layer.h"

#include <QCoreApplication>
#include <QPainterPath>
#include <QPen>
#include <algorithm>
#include <array>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/junction_edits.h"

namespace batten {
namespace {

constexpr double kMarkPx = 5.0, kDotPx = 2.0;  // [widget px] radii

bool isMarked(const CanvasScene& scene, const StrokeJunction& junction) {
  return junction.isDoubtful || isPairedByHand(scene.session, junction);
}

QString layerText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

}  // namespace

void paintJunctions(QPainter& painter, const CanvasScene& scene) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const bool isTool = scene.view.tool() == Tool::Junctions;
  const QRectF view(QPointF(), QSizeF(scene.transform.viewSize()) / scene.transform.ratio());
  for (const StrokeJunction& junction : junctionsOf(scene.session)) {
    const QPointF at = scene.transform.toWidget(junction.positionPx);
    if (!view.contains(at)) continue;
    const bool byHand = isPairedByHand(scene.session, junction);
    const QColor color = byHand ? colors::accent() : colors::target();
    const double radius = junction.isDoubtful || byHand ? kMarkPx : kDotPx;
    if (radius == kDotPx && !isTool) continue;
    painter.setBrush(byHand ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.setPen(QPen(colors::casing(), 3.5));
    painter.drawEllipse(at, radius, radius);
    painter.setPen(QPen(color, 1.4));
    painter.drawEllipse(at, radius, radius);
  }
  painter.restore();
}

void paintPairs(QPainter& painter, const CanvasScene& scene, const StrokeJunction& junction) {
  static const std::array kOfStroke = {colors::accent(), colors::corner(), colors::segment(), colors::pinned()};
  const EndPairs pairs = askedPairs(scene.session, junction);
  const auto widgetOf = [&](int branch) { return scene.transform.toWidget(junction.branchesPx[branch]); };
  const QPointF centre = scene.transform.toWidget(junction.positionPx);
  std::vector<bool> isPaired(junction.branchesPx.size(), false);
  const auto draw = [&](const QPainterPath& path, const QColor& color, Qt::PenStyle style) {
    painter.setPen(QPen(colors::casing(), 5.0, Qt::SolidLine, Qt::RoundCap));
    painter.drawPath(path);
    painter.setPen(QPen(color, 2.4, style, Qt::RoundCap));
    painter.drawPath(path);
  };
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [a, b] = pairs[i];
    isPaired[a] = isPaired[b] = true;
    QPainterPath path(widgetOf(a));
    path.quadTo(centre, widgetOf(b));
    draw(path, kOfStroke[i % kOfStroke.size()], Qt::SolidLine);
  }
  for (int i = 0; i < std::ssize(isPaired); ++i) {
    if (isPaired[i]) continue;
    // It ends before the others.
    QPainterPath path(widgetOf(i));
    path.lineTo(widgetOf(i) + 0.5 * (centre - widgetOf(i)));
    draw(path, colors::sketched(), Qt::DotLine);
  }
  painter.restore();
}

std::optional<int> junctionNear(const CanvasScene& scene, const Vec2& px, double reachWidgetPx, bool marked) {
  double least = reachWidgetPx * scene.transform.imagePerWidget();
  std::optional<int> nearest;
  const auto junctions = junctionsOf(scene.session);
  for (int i = 0; i < std::ssize(junctions); ++i) {
    const double distance = (junctions[i].positionPx - px).norm();
    if (distance > least || (marked && !isMarked(scene, junctions[i]))) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

QString junctionHint(const CanvasScene& scene, const StrokeJunction& junction) {
  const auto now = std::find(junction.pairings.begin(), junction.pairings.end(), askedPairs(scene.session, junction));
  const QString number = now == junction.pairings.end() ? QString()
                                                        : layerText(" (%1 of %2)")
                                                              .arg(now - junction.pairings.begin() + 1)
                                                              .arg(static_cast<qint64>(junction.pairings.size()));
  if (isPairedByHand(scene.session, junction))
    return layerText("Strokes paired by hand%1. Click for the next pairing.").arg(number);
  if (junction.isDoubtful)
    return layerText("These strokes might be paired differently%1. Click for the next pairing.").arg(number);
  return layerText("Click for the next pairing of these strokes%1.").arg(number);
}

}  // namespace batten
