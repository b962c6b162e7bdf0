// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/canvas_scene.h"

namespace batten {

const CurveComb* CanvasScene::selectedComb() const {
  if (!combs || combs->selected != session.selectedCurve() || combs->selected < 0) return nullptr;
  return combs->of(combs->selected);
}

std::optional<int> CanvasScene::curveNear(const Vec2& px) const {
  if (!shapes) return std::nullopt;
  const double reach = reachImagePx();
  const QPointF at(px.x(), px.y());
  double best = reach;
  std::optional<int> found;
  for (std::size_t i = 0; i < shapes->curves.size(); ++i) {
    const CurveShape& shape = shapes->curves[i];
    if (!shape.bounds.adjusted(-reach, -reach, reach, reach).contains(at)) continue;
    for (const QPainterPath* path : {&shape.sketched, &shape.faired})
      if (const auto distance = distanceTo(*path, px); distance && *distance <= best) {
        best = *distance;
        found = static_cast<int>(i);
      }
  }
  return found;
}

const ExtremumMark* CanvasScene::extremumNear(const Vec2& px) const {
  if (!view.isVisible(Layer::Extrema) || view.isScanOnly()) return nullptr;
  const ExtremumMark* best = nullptr;
  double least = kMarkReachPx * transform.imagePerWidget();
  for (const ExtremumMark& mark : extrema) {
    const double distance = (mark.px - px).norm();
    if (distance > least) continue;
    least = distance;
    best = &mark;
  }
  return best;
}

}  // namespace batten
