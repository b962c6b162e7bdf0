// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "ui/canvas/tools/canvas_tool.h"

namespace batten {

/// Marks on lines: a press beside them sets one, which the drag then slides along the line; a click on a mark selects
/// it, a click on the selected one removes it; arrows nudge the selected one, Tab walks, Del removes, Esc takes a drag
/// back. What the marks are is the derived tool's.
class PointTool : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;
  void press(const ToolEvent&) final;
  void move(const ToolEvent&, bool isPressed) final;
  void release(const ToolEvent&) final;
  void abort() final;
  bool key(QKeyEvent*) final;
  std::optional<bool> tab(bool next) final;
  void leave() final;
  void reset() final;
  void recipeChanged() final;
  Qt::CursorShape cursorShape() const final { return snapped_ || hovered_ ? Qt::PointingHandCursor : Qt::ArrowCursor; }

 protected:
  using Index = std::optional<std::size_t>;
  /// Names of the undo steps.
  struct Steps {
    QString set, move, remove;
  };
  virtual Steps steps() const = 0;
  virtual std::size_t count() const = 0;
  /// Where a mark is stored, and where it is shown.
  virtual Vec2 stored(std::size_t mark) const = 0;
  virtual Vec2 shown(std::size_t mark) const { return stored(mark); }
  virtual void add(Recipe&, const Vec2& px) const = 0;
  virtual void place(Recipe&, std::size_t mark, const Vec2& px) const = 0;
  virtual void erase(Recipe&, std::size_t mark) const = 0;
  /// Lets a press beside all marks do something else, with the undo step that it is given; true: it did.
  virtual bool pressElse(const ToolEvent&, GestureId /*gesture*/) { return false; }
  /// Where a press sets a mark, or none.
  virtual std::optional<Vec2> placeFor(const ToolEvent&) const = 0;
  virtual QString hintText() const = 0;
  virtual Index selected() const { return selected_; }
  virtual void select(Index mark) { selected_ = mark; }

  Index nearest(const Vec2& px, double reachPx) const;
  Index hovered() const { return hovered_; }
  std::optional<Vec2> snapped() const { return snapped_; }

 private:
  Index markAt(const Vec2& px) const { return nearest(px, scene_.reachImagePx()); }
  void update(const ToolEvent&);
  bool nudge(const Vec2& step);
  void remove(std::size_t mark);
  void change(const QString& what, Recipe after, GestureId gesture = {});

  std::optional<Vec2> snapped_;
  Index hovered_, held_, selected_;
  bool isDragging_ = false, isNew_ = false, wasSelected_ = false, isChanging_ = false;
  QPointF pressed_;
  GestureId gesture_, nudgeGesture_;  ///< Arrow presses in a row are one step.
  std::optional<Recipe> before_;      ///< Of the gesture in progress.
  std::optional<ToolEvent> last_;     ///< Where the mouse is, while it is over the drawing.
};

}  // namespace batten
