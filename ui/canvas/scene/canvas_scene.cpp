// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/canvas_scene.h"
#include "ui/session/growing_player.h"
#include "ui/session/view/judged_view.h"

namespace batten {

const CurveComb* CanvasScene::selectedComb() const {
  if (!combs || combs->selected != session.selectedCurve() || !combs->selected) return nullptr;
  return combs->of(*combs->selected);
}

std::optional<int> CanvasScene::curveNear(const Vec2& px) const {
  if (!shapes || view.isScanOnly()) return std::nullopt;
  const double reach = reachImagePx();
  const QPointF at(px.x(), px.y());
  double best = reach;
  std::optional<int> found;
  for (std::size_t i = 0; i < shapes->curves.size(); ++i) {
    const CurveShape& shape = shapes->curves[i];
    if (!shape.bounds.adjusted(-reach, -reach, reach, reach).contains(at)) continue;
    // Only what is painted can be clicked. What is left out is painted dotted, and in its tool always.
    const bool sketched = view.isVisible(Layer::Curve) || (!shape.isIncluded && view.tool() == Tool::Lines);
    const bool faired = view.isVisible(Layer::Faired) && shape.isIncluded;
    const auto look = [&](const QPainterPath& path) {
      const auto distance = distanceTo(path, px);
      if (!distance || *distance > best) return;
      best = *distance;
      found = static_cast<int>(i);
    };
    if (sketched) look(shape.sketched);
    if (faired) look(shape.faired.isEmpty() ? shape.sketched : shape.faired);
  }
  return found;
}

bool CanvasScene::areExtremaShown() const {
  const bool isCurveShown = view.isVisible(Layer::Curve) || judgedIn(view) == Judged::Result;
  return view.isVisible(Layer::Extrema) && isCurveShown && !view.isScanOnly() && !session.growing().isOpen();
}

bool CanvasScene::isResultShown() const { return judgedIn(view) == Judged::Result && shapes && shapes->source.faired; }

bool CanvasScene::isSelectionShown() const {
  const bool isResult = view.isVisible(Layer::Faired) && isResultShown();
  return (view.isVisible(Layer::Curve) || isResult) && !session.growing().isOpen();
}

bool CanvasScene::areCombsShown() const { return view.isVisible(Layer::Comb) && !session.growing().isOpen(); }

const ExtremumMark* CanvasScene::extremumNear(const Vec2& px) const {
  if (!areExtremaShown()) return nullptr;
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
