// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QKeyEvent>
#include <QPen>
#include <cmath>
#include <numbers>

#include "ui/canvas/canvas_colors.h"
#include "ui/canvas/layers/vector_layers.h"
#include "ui/canvas/tools/canvas_tool.h"

namespace batten {
namespace {

constexpr double kDragStartPx = 4.0;

QString tr(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class CornerTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    pressed_ = event.widget;
    held_ = markAt(event.px);
    isDragging_ = false;
    nudgeGesture_ = -1;
    selected_ = held_;
    if (held_) {
      gesture_ = scene_.session.newGesture();
      return;
    }
    const auto place = placeFor(event);
    if (!place) {
      scene_.flash(event.px);
      return;
    }
    Recipe recipe = scene_.session.recipe();
    recipe.cornerMarks.push_back({*place});
    selected_ = recipe.cornerMarks.size() - 1;
    scene_.session.change(tr("Mark corner"), recipe);
    update(event);
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed && held_) {
      const QPointF way = event.widget - pressed_;
      if (!isDragging_ && std::hypot(way.x(), way.y()) < kDragStartPx) return;
      isDragging_ = true;
      drag(event);
      return;
    }
    if (!isPressed) update(event);
  }

  void release(const ToolEvent& event) override {
    if (held_ && !isDragging_) remove(*held_);
    held_.reset();
    isDragging_ = false;
    update(event);
  }

  bool key(QKeyEvent* event) override {
    if (const auto way = arrowOf(event)) return nudge(*way);
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    const auto mark = hovered_ ? hovered_ : selected_;
    if (!mark) return false;
    remove(*mark);
    return true;
  }

  void leave() override {
    snapped_.reset();
    hovered_.reset();
    scene_.repaint();
  }
  void reset() override {
    snapped_.reset();
    hovered_.reset();
    held_.reset();
    selected_.reset();
    nudgeGesture_ = -1;
    isDragging_ = false;
  }
  Qt::CursorShape cursorShape() const override {
    return snapped_ || hovered_ ? Qt::PointingHandCursor : Qt::ArrowCursor;
  }

  void paint(QPainter& painter) override {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colors::corner(), 1.4, Qt::DotLine));
    for (const CornerSuggestion& suggestion : scene_.suggestions)
      if (!nearestMark(suggestion.positionPx, scene_.session.recipe().corners.snapDistancePx))
        painter.drawEllipse(scene_.transform.toWidget(suggestion.positionPx), 7.0, 7.0);
    if (selected_ && *selected_ < scene_.session.recipe().cornerMarks.size()) {
      painter.setPen(QPen(colors::corner(), 1.2));
      const QPointF at = scene_.transform.toWidget(positionOf(*selected_));
      painter.drawRect(QRectF(at - QPointF(9.0, 9.0), QSizeF(18.0, 18.0)));
    }
    if (hovered_) {
      const Vec2 at = positionOf(*hovered_);
      paintCornerSquare(painter, scene_.transform.toWidget(at), 6.5, colors::corner(), false);
      paintLabel(painter, scene_, angleText(*hovered_), scene_.transform.toWidget(at));
    } else if (snapped_) {
      const QPointF at = scene_.transform.toWidget(*snapped_);
      painter.setPen(QPen(Qt::white, 4.0));
      painter.drawEllipse(at, 6.0, 6.0);
      painter.setPen(QPen(colors::corner(), 2.0));
      painter.drawEllipse(at, 6.0, 6.0);
    }
    painter.restore();
  }

 private:
  bool isFresh() const { return scene_.session.output().pieces && !scene_.session.isStale(StageId::Pieces); }

  /// Where a mark is shown: at its corner once that is known.
  Vec2 positionOf(std::size_t mark) const {
    if (isFresh())
      for (const Corner& corner : scene_.session.output().pieces->corners)
        if (corner.mark == static_cast<int>(mark)) return corner.positionPx;
    const auto& marks = scene_.session.recipe().cornerMarks;
    return mark < marks.size() ? marks[mark].positionPx : Vec2::Zero();
  }

  QString angleText(std::size_t mark) const {
    if (!isFresh()) return {};
    for (const Corner& corner : scene_.session.output().pieces->corners)
      if (corner.mark == static_cast<int>(mark))
        return tr("turns %1°")
            .arg(QString::number(std::abs(corner.turningAngleRad) * 180.0 / std::numbers::pi, 'f', 1));
    return tr("no line within %1 px").arg(scene_.session.recipe().corners.snapDistancePx, 0, 'f', 0);
  }

  std::optional<std::size_t> nearestMark(const Vec2& px, double reach) const {
    const auto& marks = scene_.session.recipe().cornerMarks;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const double distance = std::min((positionOf(i) - px).norm(), (marks[i].positionPx - px).norm());
      if (distance <= reach) reach = distance, found = i;
    }
    return found;
  }
  std::optional<std::size_t> markAt(const Vec2& px) const { return nearestMark(px, scene_.reachImagePx()); }

  /// Where a click marks: the nearest place of a line within reach; with Alt the place itself.
  std::optional<Vec2> placeFor(const ToolEvent& event) const {
    const auto& contours = scene_.session.output().contours;
    if (event.modifiers.testFlag(Qt::AltModifier)) return event.px;
    if (!contours) return std::nullopt;
    // A suggestion within reach is what is meant.
    const double reach = scene_.reachImagePx();
    for (const CornerSuggestion& suggestion : scene_.suggestions)
      if ((suggestion.positionPx - event.px).norm() <= reach) return suggestion.positionPx;
    const auto corner = nearestContourPoint(*contours, event.px, reach);
    if (!corner) return std::nullopt;
    return corner->positionPx;
  }

  void update(const ToolEvent& event) {
    hovered_ = markAt(event.px);
    snapped_ = hovered_ || event.modifiers.testFlag(Qt::AltModifier) ? std::nullopt : placeFor(event);
    scene_.hint(hovered_   ? tr("Click to remove this corner; drag to move it.")
                : snapped_ ? tr("Click to mark a corner.")
                           : tr("Click a line where it has a sharp corner."));
    scene_.repaint();
  }

  void drag(const ToolEvent& event) {
    const auto place = placeFor(event);
    Recipe recipe = scene_.session.recipe();
    if (!place || *held_ >= recipe.cornerMarks.size()) return;
    recipe.cornerMarks[*held_].positionPx = *place;
    scene_.session.change(tr("Move corner"), recipe, gesture_);
    scene_.repaint();
  }

  /// The way an arrow key moves a mark: 1 px, with Shift 0.1 px; image frame.
  static std::optional<Vec2> arrowOf(const QKeyEvent* event) {
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

  /// Moves the selected mark; without one the arrow pans.
  bool nudge(const Vec2& way) {
    Recipe recipe = scene_.session.recipe();
    if (!selected_ || *selected_ >= recipe.cornerMarks.size()) return false;
    if (nudgeGesture_ < 0) nudgeGesture_ = scene_.session.newGesture();
    recipe.cornerMarks[*selected_].positionPx += way;
    scene_.session.change(tr("Move corner"), recipe, nudgeGesture_);
    scene_.repaint();
    return true;
  }

  void remove(std::size_t mark) {
    Recipe recipe = scene_.session.recipe();
    if (mark >= recipe.cornerMarks.size()) return;
    recipe.cornerMarks.erase(recipe.cornerMarks.begin() + static_cast<std::ptrdiff_t>(mark));
    hovered_.reset();
    selected_.reset();
    scene_.session.change(tr("Remove corner"), recipe);
    scene_.repaint();
  }

  std::optional<Vec2> snapped_;
  std::optional<std::size_t> hovered_, held_, selected_;
  int nudgeGesture_ = -1;  ///< Arrow presses in a row are one step.
  QPointF pressed_;
  bool isDragging_ = false;
  int gesture_ = -1;
};

}  // namespace

std::unique_ptr<CanvasTool> makeCornerTool(CanvasScene& scene) { return std::make_unique<CornerTool>(scene); }

}  // namespace batten
