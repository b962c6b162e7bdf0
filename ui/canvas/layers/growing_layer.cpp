// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/growing_layer.h"

#include <QPen>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/growing_player.h"

namespace batten {
namespace {

QPolygonF outlineOf(const TypicalCurve& curve, const CanvasScene& scene) {
  constexpr int kPieces = 32;  // of a polygon for the curve
  const auto q = curve.controlPoints();
  QPolygonF line;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = double(i) / kPieces, s = 1.0 - t;
    const Vec2 p = s * s * s * q[0] + 3 * s * s * t * q[1] + 3 * s * t * t * q[2] + t * t * t * q[3];
    line << scene.transform.toWidget(scene.session.output().frame.pointToImage(p));
  }
  return line;
}

/// A tick across the end of a curve: where segments meet.
void paintJoint(QPainter& painter, const QPolygonF& line) {
  const QPointF chord = line.back() - line[line.size() - 2];
  const double length = std::hypot(chord.x(), chord.y());
  if (!(length > 0.0)) return;
  const QPointF across(-chord.y() / length * 6.0, chord.x() / length * 6.0);
  painter.drawLine(line.back() - across, line.back() + across);
}

}  // namespace

void paintGrowing(QPainter& painter, const CanvasScene& scene) {
  const GrowingPlayer& player = scene.session.growing();
  if (!player.steps() || !player.step()) return;
  const int shown = *player.step();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  const auto stroke = [&](const QPolygonF& line, const QColor& color, double width, Qt::PenStyle style) {
    painter.setPen(QPen(QColor(255, 255, 255, 170), width + 2.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
    painter.setPen(QPen(color, width, style, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  };
  for (int i = 0; i < shown; ++i) {
    const GrowingStep& step = (*player.steps())[i];
    if (step.kind != GrowingStep::Kind::Kept) continue;
    const QPolygonF line = outlineOf(step.curve, scene);
    stroke(line, colors::accent(), 2.2, Qt::SolidLine);
    paintJoint(painter, line);
  }
  const GrowingStep& now = (*player.steps())[shown];
  const QPolygonF line = outlineOf(now.curve, scene);
  switch (now.kind) {
    case GrowingStep::Kind::Seed:
      stroke(line, colors::segment(), 2.6, Qt::SolidLine);
      break;
    case GrowingStep::Kind::Extrapolated:
      stroke(line, colors::target(), 2.2, Qt::DashLine);
      break;
    case GrowingStep::Kind::Fitted:
      stroke(line, now.stops ? colors::lost() : colors::segment(), 2.6, Qt::SolidLine);
      break;
    case GrowingStep::Kind::Kept:
      stroke(line, colors::accent(), 2.6, Qt::SolidLine);
      break;
  }
  paintJoint(painter, line);
  painter.restore();
}

}  // namespace batten
