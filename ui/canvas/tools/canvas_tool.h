// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <optional>

#include "ui/canvas/scene/canvas_scene.h"

class QKeyEvent;

namespace batten {

inline constexpr double kDragStartPx = 4.0;  ///< [widget px] A smaller move is a click.

/// A mouse position as tools take it.
struct ToolEvent {
  QPointF widget;
  Vec2 px = Vec2::Zero();  ///< The same place in image px.
  Qt::KeyboardModifiers modifiers;
};

/// What the left button does on the canvas. A tool owns its gesture and what it paints; the scene is shared. Functions
/// that return bool say whether the event was used; unused ones go to the canvas (pan, zoom) or to the window.
class CanvasTool {
 public:
  explicit CanvasTool(CanvasScene& scene) : scene_(scene) {}
  virtual ~CanvasTool() = default;
  virtual void press(const ToolEvent&) {}
  virtual void move(const ToolEvent&, bool /*isPressed*/) {}
  virtual void release(const ToolEvent&) {}
  virtual void doubleClick(const ToolEvent&) {}
  /// @param steps wheel notches, positive away from the user.
  virtual bool wheel(const ToolEvent&, double /*steps*/) { return false; }
  virtual bool key(QKeyEvent*) { return false; }
  /// Esc while the button is down: takes back what the gesture has changed so far.
  virtual void abort() {}
  /// A gesture goes on with the button up: Esc is its own.
  virtual bool isUnderWay() const { return false; }
  /// Tab or Shift+Tab: true = it chose another mark, false = there is none behind the last, none = not the tool's.
  virtual std::optional<bool> tab(bool /*next*/) { return std::nullopt; }
  /// The recipe has changed, by undo, a panel or the tool itself.
  virtual void recipeChanged() {}
  virtual void leave() {}
  /// The drawing or the tool has changed: forget what referred to it.
  virtual void reset() {}
  virtual void paint(QPainter&) {}
  virtual Qt::CursorShape cursorShape() const { return Qt::ArrowCursor; }

 protected:
  CanvasScene& scene_;
};

}  // namespace batten
