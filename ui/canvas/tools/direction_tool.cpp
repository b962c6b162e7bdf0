// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/direction_tool.h"

#include <QCoreApplication>
#include <QPen>
#include <QPolygonF>
#include <cmath>
#include <limits>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/direction_edits.h"

namespace batten {
namespace {

constexpr double kArrowPx = 11.0, kRingPx = 6.0;  ///< [widget px]
constexpr double kHeadAngleRad = 0.45;            // of an arrow, half of it

QString directionToolText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class DirectionTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    update();
    if (const auto start = startAt(event.px)) {
      held_ = start;
      gesture_ = scene_.session.newGesture();
      before_ = scene_.session.recipe();
      return;
    }
    const auto curve = scene_.curveNear(event.px);
    if (!curve) return scene_.flash(event.px);
    scene_.session.selectCurve(*curve);
    reverseCurve(scene_.session, *curve);
    scene_.repaint();
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed && held_) {
      if (const auto at = placeOn(*held_, event.px)) startCurveAt(scene_.session, *held_, *at, gesture_);
      return scene_.repaint();
    }
    update();
    overStart_ = startAt(event.px);
    over_ = scene_.curveNear(event.px);
    scene_.hint(overStart_ ? directionToolText("Drag the ring to the start point of the closed line.")
                : over_
                    ? directionToolText("Click to reverse the direction of %1.").arg(curveName(scene_.session, *over_))
                    : directionToolText("Arrows show the export direction. Click a curve to reverse it."));
  }

  void release(const ToolEvent&) override { held_.reset(); }
  void abort() override {
    if (held_) scene_.session.change(directionToolText("Move start"), before_, gesture_);
    held_.reset();
  }
  void leave() override { over_.reset(); }
  void reset() override {
    over_.reset();
    overStart_.reset();
    held_.reset();
    shown_.clear();
    of_ = nullptr;
  }
  void recipeChanged() override { of_ = nullptr; }
  Qt::CursorShape cursorShape() const override {
    return held_ || overStart_ ? Qt::SizeAllCursor : over_ ? Qt::PointingHandCursor : Qt::ArrowCursor;
  }

  void paint(QPainter& painter) override {
    update();
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (int i = 0; i < std::ssize(shown_); ++i) {
      paintArrow(painter, shown_[i], over_ == i ? colors::target() : colors::accent());
      paintStart(painter, shown_[i]);
    }
    painter.restore();
  }

 private:
  /// Where the marks of a curve are drawn [px].
  struct Shown {
    Vec2 middle = Vec2::Zero(), direction = Vec2::UnitX(), start = Vec2::Zero();
    bool isClosed = false, isFirst = false;
  };

  /// What there is to paint, made anew when curves or recipe have changed.
  void update() {
    const auto curves = scene_.session.curves();
    const void* of = curves.data();
    if (of == of_ && shown_.size() == curves.size()) return;
    of_ = of;
    shown_.clear();
    const auto courses = curveCourses(scene_.session);
    if (courses.size() != curves.size()) return;
    const PageFrame& frame = scene_.session.output().frame;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      Shown& shown = shown_.emplace_back();
      const NurbsCurve& shape = curves[i].faired.isEmpty() ? curves[i].sketched : curves[i].faired;
      if (shape.isEmpty()) continue;
      const CurveSample middle = sampleByArcLength(shape, 3)[1];
      const double sign = courses[i].isReversed ? -1.0 : 1.0;
      shown.middle = frame.pointToImage(middle.point);
      shown.direction = sign * frame.vectorToImage(middle.tangent).normalized();
      shown.isClosed = courses[i].isOfClosedLine;
      const Vec2 begin = frame.pointToImage(shape.point(courses[i].isReversed ? shape.end() : shape.start()));
      shown.start = begin;
      shown.isFirst = !shown.isClosed || isFirstOfLine(i);
      if (shown.isClosed && courses[i].startPx)
        shown.start = curves[i].closed
                          ? frame.pointToImage(closestPoint(shape, frame.pointToModel(*courses[i].startPx)).point)
                          : *courses[i].startPx;
    }
  }

  /// One curve of a closed line bears its ring.
  bool isFirstOfLine(std::size_t curve) const {
    const auto curves = scene_.session.curves();
    for (std::size_t i = 0; i < curve; ++i)
      if (curves[i].contour == curves[curve].contour) return false;
    return true;
  }

  std::optional<int> startAt(const Vec2& px) const {
    std::optional<int> found;
    double nearest = scene_.reachImagePx();
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const double distance = (shown_[i].start - px).norm();
      if (!shown_[i].isClosed || !shown_[i].isFirst || distance > nearest) continue;
      nearest = distance;
      found = static_cast<int>(i);
    }
    return found;
  }

  /// The place of a curve's line nearest to the mouse.
  std::optional<Vec2> placeOn(int curve, const Vec2& px) const {
    const auto curves = scene_.session.curves();
    const PageFrame& frame = scene_.session.output().frame;
    if (curve >= std::ssize(curves)) return std::nullopt;
    const int contour = curves[curve].contour;
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<Vec2> found;
    for (const TracedCurve& one : curves) {
      if (one.contour != contour || one.sketched.isEmpty()) continue;
      if (one.closed) return frame.pointToImage(closestPoint(one.sketched, frame.pointToModel(px)).point);
      const Vec2 corner = frame.pointToImage(one.sketched.point(one.sketched.start()));
      if ((corner - px).norm() >= nearest) continue;
      nearest = (corner - px).norm();
      found = corner;
    }
    return found;
  }

  void paintArrow(QPainter& painter, const Shown& shown, const QColor& color) const {
    const QPointF tip =
        scene_.transform.toWidget(shown.middle) + 0.5 * kArrowPx * QPointF(shown.direction.x(), shown.direction.y());
    const double angle = std::atan2(shown.direction.y(), shown.direction.x());
    QPolygonF head{tip};
    for (const double side : {kHeadAngleRad, -kHeadAngleRad})
      head << tip - kArrowPx * QPointF(std::cos(angle + side), std::sin(angle + side));
    painter.setPen(QPen(QColor(255, 255, 255, 230), 2.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(color);
    painter.drawPolygon(head);
    painter.setPen(Qt::NoPen);
    painter.drawPolygon(head);
  }

  void paintStart(QPainter& painter, const Shown& shown) const {
    if (!shown.isFirst) return;
    const QPointF at = scene_.transform.toWidget(shown.start);
    const double radius = shown.isClosed ? kRingPx : 0.5 * kRingPx;
    painter.setBrush(shown.isClosed ? QBrush(QColor(255, 255, 255, 200)) : QBrush(colors::accent()));
    painter.setPen(QPen(QColor(255, 255, 255, 230), 4.0));
    painter.drawEllipse(at, radius, radius);
    painter.setPen(QPen(colors::accent(), 1.8));
    painter.drawEllipse(at, radius, radius);
  }

  std::vector<Shown> shown_;
  const void* of_ = nullptr;
  std::optional<int> over_, overStart_, held_;
  Recipe before_;
  GestureId gesture_;
};

}  // namespace

std::unique_ptr<CanvasTool> makeDirectionTool(CanvasScene& scene) { return std::make_unique<DirectionTool>(scene); }

}  // namespace batten
