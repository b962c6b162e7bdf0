// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/pen_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QPainterPath>
#include <QPen>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/curves/pen_fairness.h"
#include "ui/session/edits/pen_edits.h"
#include "ui/session/text/fairness_text.h"

namespace batten {
namespace {

/// [widget px] Points nearer than this to the last one say nothing new.
constexpr double kStepPx = 1.0;
/// A line that comes back to its start is closed when it is at least this many reaches long.
constexpr double kLeastRound = 4.0;

QString penToolText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

QPainterPath pathOf(const std::vector<Vec2>& points, bool closed, const ViewTransform& transform) {
  QPainterPath path;
  for (const Vec2& p : points) {
    if (path.elementCount() == 0)
      path.moveTo(transform.toWidget(p));
    else
      path.lineTo(transform.toWidget(p));
  }
  if (closed) path.closeSubpath();
  return path;
}

class PenTool final : public CanvasTool {
 public:
  explicit PenTool(CanvasScene& scene) : CanvasTool(scene), fairness_(scene.session) {
    QObject::connect(&fairness_, &PenFairness::changed, &fairness_, [this] {
      if (isDrawing_) tell();
    });
  }

  void press(const ToolEvent& event) override {
    points_ = {event.px};
    pressed_ = last_ = event.widget;
    isDrawing_ = false;
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (!isPressed || points_.empty()) return hover(event);
    if (!isDrawing_ && distance(event.widget, pressed_) < kDragStartPx) return;
    isDrawing_ = true;
    if (distance(event.widget, last_) < kStepPx) return;
    points_.push_back(event.px);
    last_ = event.widget;
    isClosing_ = closes(event);
    fairness_.follow({points_, isClosing_});
    tell();
    scene_.repaint();
  }

  void release(const ToolEvent& event) override {
    const std::vector<Vec2> points = std::exchange(points_, {});
    fairness_.stop();
    if (!isDrawing_) return select(event);
    isDrawing_ = false;
    PenStroke stroke{points, false};
    if (distance(event.widget, last_) >= kStepPx) stroke.points.push_back(event.px);
    stroke.closed = closes(event, stroke.points);
    // Closed lines begin and end at the same place: the way from the last point to the first is the line's own.
    if (!addStroke(scene_.session, std::move(stroke))) scene_.flash(event.px);
    hover(event);
    scene_.repaint();
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    const auto stroke = strokeOf(scene_.session, scene_.session.selectedCurve());
    if (stroke) removeStroke(scene_.session, *stroke);
    return stroke.has_value();
  }

  void abort() override {
    reset();
    scene_.repaint();
  }
  void reset() override {
    fairness_.stop();
    points_.clear();
    isDrawing_ = false;
  }
  Qt::CursorShape cursorShape() const override { return Qt::CrossCursor; }

  void paint(QPainter& painter) override {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    paintDrawn(painter);
    if (isDrawing_) {
      painter.setPen(QPen(colors::accent(), 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPath(pathOf(points_, false, scene_.transform));
    }
    painter.restore();
  }

 private:
  /// What letting go would do, and how fair the line is so far.
  void tell() {
    const QString closing = isClosing_ ? penToolText("Release to close the line.") : QString();
    const QString fairness = fairness_.latest() ? fairnessLine(*fairness_.latest()) : QString();
    scene_.hint(closing.isEmpty() || fairness.isEmpty() ? closing + fairness
                                                        : fairness + QStringLiteral(" · ") + closing);
  }

  static double distance(QPointF a, QPointF b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

  bool closes(const ToolEvent& event) const { return closes(event, points_); }
  bool closes(const ToolEvent& event, const std::vector<Vec2>& points) const {
    if (points.size() < 3 || event.modifiers.testFlag(Qt::AltModifier)) return false;
    const double reach = scene_.reachImagePx();
    if ((event.px - points.front()).norm() > reach) return false;
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length > kLeastRound * reach;
  }

  void hover(const ToolEvent& event) {
    const bool over = strokeNear(scene_.session.recipe(), event.px, scene_.reachImagePx()).has_value();
    scene_.hint(over ? penToolText("Click to select this line; Del removes it.")
                     : penToolText("Drag to draw a line; end at its start to close it."));
  }

  void select(const ToolEvent& event) {
    const auto stroke = strokeNear(scene_.session.recipe(), event.px, scene_.reachImagePx());
    const auto curve = stroke ? curveOfStroke(scene_.session, *stroke) : std::nullopt;
    if (curve)
      scene_.session.selectCurve(*curve);
    else
      scene_.flash(event.px);
  }

  /// The strokes as they were drawn, with their points where these stand apart on the screen.
  void paintDrawn(QPainter& painter) const {
    const Recipe& recipe = scene_.session.recipe();
    const auto selected = strokeOf(scene_.session, scene_.session.selectedCurve());
    for (std::size_t s = 0; s < recipe.penStrokes.size(); ++s) {
      const PenStroke& stroke = recipe.penStrokes[s];
      const QPainterPath path = pathOf(stroke.points, stroke.closed, scene_.transform);
      const bool isSelected = selected && *selected == s;
      painter.setPen(QPen(isSelected ? colors::halo() : QColor(0, 0, 0, 0), 7.0));
      if (isSelected) painter.drawPath(path);
      painter.setPen(QPen(colors::pen(), 1.0));
      painter.drawPath(path);
      if (!isSelected) continue;
      painter.setPen(Qt::NoPen);
      painter.setBrush(colors::pen());
      QPointF before(-1e9, -1e9);
      for (const Vec2& p : stroke.points) {
        const QPointF at = scene_.transform.toWidget(p);
        if (distance(at, before) < 5.0) continue;
        painter.drawEllipse(at, 1.8, 1.8);
        before = at;
      }
      painter.setBrush(Qt::NoBrush);
    }
  }

  std::vector<Vec2> points_;
  QPointF pressed_, last_;
  bool isDrawing_ = false, isClosing_ = false;
  PenFairness fairness_;
};

}  // namespace

std::unique_ptr<CanvasTool> makePenTool(CanvasScene& scene) { return std::make_unique<PenTool>(scene); }

}  // namespace batten
