// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/ruling_layer.h"

#include <QPen>
#include <QPolygonF>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintRulings(QPainter& painter, const CanvasScene& scene) {
  const auto& page = scene.session.output().page;
  if (!page || scene.session.recipe().preparation.rulings == RulingUse::Keep) return;
  if (page->rulings.empty() && page->dots.empty()) return;
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
  constexpr double kDotRadiusPx = 3.0;  // [widget px]
  for (const PrintedDot& dot : page->dots)
    painter.drawEllipse(scene.transform.toWidget(dot.atPx), kDotRadiusPx, kDotRadiusPx);
  painter.restore();
}

}  // namespace batten
