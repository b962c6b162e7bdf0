// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/span_layer.h"

#include <QPainterPath>
#include <algorithm>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/fairing/target/natural_spans.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/view/judged_view.h"

namespace batten {
namespace {

constexpr double kTickPx = 7.0, kTickGapPx = 3.0, kSpanWidthPx = 11.0;  // [widget px]
/// Points of the pointed span as drawn.
constexpr int kSpanPoints = 160;

class SpanPainter {
 public:
  SpanPainter(const CanvasScene& scene, const NurbsCurve& curve) : scene_(scene), curve_(curve), arc_(curve) {}

  void tick(QPainter& painter, double share) const {
    const double u = arc_.parameter(share * arc_.total());
    const QPointF at = toWidget(u);
    const Vec2 along = curve_.derivatives(u, 1)[1];
    if (!(along.norm() > 0.0)) return;
    // Widget y goes down.
    const QPointF across(along.y() / along.norm(), along.x() / along.norm());
    for (const double side : {-1.0, 1.0})
      painter.drawLine(at + side * kTickGapPx * across, at + side * (kTickGapPx + kTickPx) * across);
  }

  QPainterPath path(const ProfileSpan& span) const {
    QPainterPath result;
    for (int i = 0; i <= kSpanPoints; ++i) {
      const double f = span.from + (span.to - span.from) * i / kSpanPoints;
      const QPointF at = toWidget(arc_.parameter((f > 1.0 ? f - 1.0 : f) * arc_.total()));
      i == 0 ? result.moveTo(at) : result.lineTo(at);
    }
    return result;
  }

 private:
  QPointF toWidget(double u) const {
    return scene_.transform.toWidget(scene_.session.output().frame.pointToImage(curve_.point(u)));
  }

  const CanvasScene& scene_;
  const NurbsCurve& curve_;
  ArcLength arc_;
};

}  // namespace

void paintSpans(QPainter& painter, const CanvasScene& scene) {
  const TracedCurve* selected = scene.session.selected();
  if (!selected || selected->sketched.isEmpty() || !selected->included || judgedIn(scene.view) != Judged::Result)
    return;
  const auto pointed = scene.session.pointedSpan();
  if (!pointed && fairingAsked(scene.session).mode != FairingMode::Target) return;
  std::vector<double> splits = splitsOf(scene.session);
  std::sort(splits.begin(), splits.end());
  if (splits.empty()) return;
  const SpanPainter spans(scene, selected->sketched);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  if (pointed) {
    QColor color = colors::target();
    color.setAlpha(80);
    painter.setPen(QPen(color, kSpanWidthPx, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
    painter.drawPath(spans.path(spanBetween(splits, *pointed, selected->closed)));
  }
  for (const double share : splits) {
    painter.setPen(QPen(Qt::white, 3.0));
    spans.tick(painter, share);
    painter.setPen(QPen(colors::target(), 1.4));
    spans.tick(painter, share);
  }
  painter.restore();
}

}  // namespace batten
