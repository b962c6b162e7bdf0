// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/point_tool.h"

#include <QKeyEvent>
#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// The way an arrow key moves a mark: 1 px, with Shift 0.1 px; image frame.
std::optional<Vec2> arrowOf(const QKeyEvent* event) {
  const double step = event->modifiers().testFlag(Qt::ShiftModifier) ? 0.1 : 1.0;
  switch (event->key()) {
    case Qt::Key_Left:
      return Vec2(-step, 0.0);
    case Qt::Key_Right:
      return Vec2(step, 0.0);
    case Qt::Key_Up:
      return Vec2(0.0, -step);
    case Qt::Key_Down:
      return Vec2(0.0, step);
    default:
      return std::nullopt;
  }
}

}  // namespace

void PointTool::change(const QString& what, Recipe after, GestureId gesture) {
  isChanging_ = true;
  scene_.session.change(what, std::move(after), gesture);
  isChanging_ = false;
  scene_.repaint();
}

void PointTool::press(const ToolEvent& event) {
  pressed_ = event.widget;
  held_ = markAt(event.px);
  isDragging_ = isNew_ = false;
  nudgeGesture_.reset();
  gesture_ = scene_.session.newGesture();
  before_ = scene_.session.recipe();
  wasSelected_ = held_ && selected() == held_;
  if (held_) return select(held_);
  if (pressElse(event, gesture_)) return update(event);
  const auto at = placeFor(event);
  if (!at) {
    scene_.flash(event.px);
    return;
  }
  Recipe recipe = scene_.session.recipe();
  add(recipe, *at);
  change(steps().set, std::move(recipe), gesture_);
  held_ = count() - 1;
  isNew_ = true;
  select(held_);
  update(event);
}

void PointTool::move(const ToolEvent& event, bool isPressed) {
  if (!isPressed) return update(event);
  last_ = event;
  if (!held_) return;
  const QPointF moved = event.widget - pressed_;
  if (!isDragging_ && std::hypot(moved.x(), moved.y()) < kDragStartPx) return;
  isDragging_ = true;
  const auto at = placeFor(event);
  Recipe recipe = scene_.session.recipe();
  if (!at || *held_ >= count()) return;
  place(recipe, *held_, *at);
  change(steps().move, std::move(recipe), gesture_);
}

void PointTool::release(const ToolEvent& event) {
  if (held_ && wasSelected_ && !isDragging_ && !isNew_) remove(*held_);
  held_.reset();
  before_.reset();
  isDragging_ = false;
  update(event);
}

void PointTool::abort() {
  if (before_) change(steps().move, *std::exchange(before_, std::nullopt), gesture_);
  held_.reset();
  isDragging_ = false;
  recipeChanged();
}

bool PointTool::key(QKeyEvent* event) {
  if (const auto step = arrowOf(event)) return nudge(*step);
  if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
  const Index mark = hovered_ ? hovered_ : selected();
  if (!mark) return false;
  remove(*mark);
  return true;
}

std::optional<bool> PointTool::tab(bool next) {
  if (count() == 0) return std::nullopt;
  const Index now = selected();
  const auto last = static_cast<std::ptrdiff_t>(count()) - 1;
  const std::ptrdiff_t wanted =
      now ? static_cast<std::ptrdiff_t>(*now) + (next ? 1 : -1) : (next ? std::ptrdiff_t{0} : last);
  const bool isInside = wanted >= 0 && wanted <= last;
  select(isInside ? Index(wanted) : std::nullopt);
  nudgeGesture_.reset();
  scene_.repaint();
  return isInside;
}

void PointTool::leave() {
  last_.reset();
  snapped_.reset();
  hovered_.reset();
  scene_.repaint();
}

void PointTool::reset() {
  last_.reset();
  snapped_.reset();
  hovered_.reset();
  held_.reset();
  before_.reset();
  select(std::nullopt);
  nudgeGesture_.reset();
  isDragging_ = false;
}

void PointTool::recipeChanged() {
  // Undo and the panels move and remove marks under the mouse: what it is over is looked for anew.
  if (isChanging_ || isDragging_) return;
  nudgeGesture_.reset();
  if (selected_ && *selected_ >= count()) selected_.reset();
  if (last_)
    update(*last_);
  else
    hovered_.reset();
}

PointTool::Index PointTool::nearest(const Vec2& px, double reachPx) const {
  Index found;
  for (std::size_t i = 0; i < count(); ++i) {
    const double distance = std::min((shown(i) - px).norm(), (stored(i) - px).norm());
    if (distance <= reachPx) reachPx = distance, found = i;
  }
  return found;
}

void PointTool::update(const ToolEvent& event) {
  last_ = event;
  hovered_ = markAt(event.px);
  snapped_ = hovered_ || event.modifiers.testFlag(Qt::AltModifier) ? std::nullopt : placeFor(event);
  scene_.hint(hintText());
  scene_.repaint();
}

/// Moves the selected mark; without one the arrow pans.
bool PointTool::nudge(const Vec2& step) {
  const Index mark = selected();
  if (!mark || *mark >= count()) return false;
  if (!nudgeGesture_) nudgeGesture_ = scene_.session.newGesture();
  Recipe recipe = scene_.session.recipe();
  place(recipe, *mark, stored(*mark) + step);
  change(steps().move, std::move(recipe), nudgeGesture_);
  return true;
}

void PointTool::remove(std::size_t mark) {
  if (mark >= count()) return;
  Recipe recipe = scene_.session.recipe();
  erase(recipe, mark);
  hovered_.reset();
  select(std::nullopt);
  change(steps().remove, std::move(recipe));
}

}  // namespace batten
