// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QKeyEvent>
#include <QPen>
#include <cmath>

#include "ui/canvas/canvas_colors.h"
#include "ui/canvas/layers/vector_layers.h"
#include "ui/canvas/tools/canvas_tool.h"

namespace batten {
namespace {

constexpr double kDragStartPx = 4.0;

QString tr(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

/// Sets the places where typical curves meet.
class SegmentTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    pressed_ = event.widget;
    held_ = pointAt(event.px);
    isDragging_ = false;
    if (held_) {
      gesture_ = scene_.session.newGesture();
      return;
    }
    const auto place = onLine(event.px);
    if (!place) {
      scene_.flash(event.px);
      return;
    }
    Recipe recipe = scene_.session.recipe();
    recipe.segmentPoints.push_back({*place});
    scene_.session.change(tr("Set segment point"), recipe);
    update(event);
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (!isPressed || !held_) {
      if (!isPressed) update(event);
      return;
    }
    const QPointF way = event.widget - pressed_;
    if (!isDragging_ && std::hypot(way.x(), way.y()) < kDragStartPx) return;
    isDragging_ = true;
    const auto place = onLine(event.px);
    Recipe recipe = scene_.session.recipe();
    if (!place || *held_ >= recipe.segmentPoints.size()) return;
    recipe.segmentPoints[*held_].positionPx = *place;
    scene_.session.change(tr("Move segment point"), recipe, gesture_);
    scene_.repaint();
  }

  void release(const ToolEvent& event) override {
    if (held_ && !isDragging_) remove(*held_);
    held_.reset();
    isDragging_ = false;
    update(event);
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    if (!hovered_) return false;
    remove(*hovered_);
    return true;
  }

  void leave() override {
    hovered_.reset();
    snapped_.reset();
    scene_.repaint();
  }
  void reset() override {
    hovered_.reset();
    snapped_.reset();
    held_.reset();
    isDragging_ = false;
  }
  Qt::CursorShape cursorShape() const override {
    return snapped_ || hovered_ ? Qt::PointingHandCursor : Qt::ArrowCursor;
  }

  void paint(QPainter& painter) override {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    // Undo may have taken away what the mouse was over.
    const auto& points = scene_.session.recipe().segmentPoints;
    const bool isOver = hovered_ && *hovered_ < points.size();
    if (const std::optional<Vec2> place = isOver ? std::optional(points[*hovered_].positionPx) : snapped_) {
      const QPointF at = scene_.transform.toWidget(*place);
      painter.setPen(QPen(Qt::white, 4.0));
      painter.drawEllipse(at, 7.0, 7.0);
      painter.setPen(QPen(colors::segment(), 2.0));
      painter.drawEllipse(at, 7.0, 7.0);
    }
    painter.restore();
  }

 private:
  std::optional<std::size_t> pointAt(const Vec2& px) const {
    const auto& points = scene_.session.recipe().segmentPoints;
    double reach = scene_.reachImagePx();
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = (points[i].positionPx - px).norm();
      if (distance <= reach) reach = distance, found = i;
    }
    return found;
  }

  std::optional<Vec2> onLine(const Vec2& px) const {
    const auto& contours = scene_.session.output().contours;
    if (!contours) return std::nullopt;
    const auto place = nearestContourPoint(*contours, px, scene_.reachImagePx());
    return place ? std::optional(place->positionPx) : std::nullopt;
  }

  void update(const ToolEvent& event) {
    hovered_ = pointAt(event.px);
    snapped_ = hovered_ ? std::nullopt : onLine(event.px);
    const bool typical = scene_.session.recipe().construct.method == ConstructMethod::Typical;
    scene_.hint(hovered_   ? tr("Click to remove this segment point; drag to move it.")
                : !typical ? tr("Segment points count for the method Typical curves; choose it under Curves.")
                : snapped_ ? tr("Click to let two typical curves meet here.")
                           : tr("Click a line where two typical curves are to meet."));
    scene_.repaint();
  }

  void remove(std::size_t point) {
    Recipe recipe = scene_.session.recipe();
    if (point >= recipe.segmentPoints.size()) return;
    recipe.segmentPoints.erase(recipe.segmentPoints.begin() + static_cast<std::ptrdiff_t>(point));
    hovered_.reset();
    scene_.session.change(tr("Remove segment point"), recipe);
    scene_.repaint();
  }

  std::optional<Vec2> snapped_;
  std::optional<std::size_t> hovered_, held_;
  QPointF pressed_;
  bool isDragging_ = false;
  int gesture_ = -1;
};

}  // namespace

std::unique_ptr<CanvasTool> makeSegmentTool(CanvasScene& scene) { return std::make_unique<SegmentTool>(scene); }

void paintSegmentPoints(QPainter& painter, const CanvasScene& scene) {
  const auto& recipe = scene.session.recipe();
  if (recipe.construct.method != ConstructMethod::Typical && scene.view.tool() != Tool::Segments) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const SegmentPoint& point : recipe.segmentPoints) {
    const QPointF at = scene.transform.toWidget(point.positionPx);
    painter.setPen(QPen(Qt::white, 1.6));
    painter.setBrush(colors::segment());
    painter.drawEllipse(at, 4.5, 4.5);
  }
  painter.restore();
}

}  // namespace batten
