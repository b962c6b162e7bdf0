// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/scale_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QPen>
#include <algorithm>
#include <cmath>

#include "core/base/angle.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

constexpr double kShortestPx = 6.0;  ///< [widget px] a shorter drag was a click: the line follows the mouse to the next
constexpr double kEndMarkPx = 7.0;   ///< [widget px] half the mark across an end
constexpr double kSteepDeg = 45.0;   ///< Shift: the line keeps to multiples of this angle

QString scaleText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class ScaleTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    before_ = shown();
    if (isFollowing_) return;
    if (const auto end = endAt(event.px)) {
      held_ = end;
      line_ = *shown();
    } else {
      held_ = End::To;
      line_ = {event.px, event.px};
    }
    isPressed_ = true;
    pressedAt_ = event.widget;
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed || isFollowing_) {
      if (isFollowing_ || isPressed_) drag(event);
      scene_.hint(scaleText("Shift keeps the line upright, level or at 45 degrees."));
      return scene_.repaint();
    }
    over_ = endAt(event.px);
    scene_.hint(over_ ? scaleText("Drag this end to the end of the known length.")
                      : scaleText("Drag along something of known length, such as a ruler or the edge of the paper."));
  }

  void release(const ToolEvent& event) override {
    if (!isPressed_ && !isFollowing_) return;
    drag(event);
    const bool isClick = QLineF(pressedAt_, event.widget).length() < kShortestPx;
    if (isPressed_ && isClick && (line_.toPx - line_.fromPx).norm() < kShortestPx * scene_.transform.imagePerWidget()) {
      isPressed_ = false;
      isFollowing_ = true;
      return;
    }
    isPressed_ = isFollowing_ = false;
    finish();
  }

  bool key(QKeyEvent* event) override {
    const bool isEscape = event->key() == Qt::Key_Escape && isFollowing_;
    const bool isDelete = event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace;
    if (isEscape) {
      abort();
      return true;
    }
    if (!isDelete || !shown()) return false;
    scene_.view.setMeasure(std::nullopt);
    if (scene_.session.recipe().scaleLine) {
      Recipe after = scene_.session.recipe();
      setResolution(after, std::nullopt);
      scene_.session.change(scaleText("Forget scale"), std::move(after));
    }
    return true;
  }

  void abort() override {
    isPressed_ = isFollowing_ = false;
    scene_.repaint();
  }
  bool isUnderWay() const override { return isFollowing_; }
  void leave() override { over_.reset(); }
  void reset() override {
    isPressed_ = isFollowing_ = false;
    over_.reset();
  }
  Qt::CursorShape cursorShape() const override { return over_ ? Qt::SizeAllCursor : Qt::CrossCursor; }

  void paint(QPainter& painter) override {
    const auto line = isPressed_ || isFollowing_ ? std::optional(line_) : shown();
    if (!line || line->fromPx == line->toPx) return;
    const QPointF from = scene_.transform.toWidget(line->fromPx), to = scene_.transform.toWidget(line->toPx);
    const QLineF bar(from, to);
    const QPointF across = QPointF(-bar.dy(), bar.dx()) / std::max(bar.length(), 1e-9) * kEndMarkPx;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (const auto& [color, width] : {std::pair{QColor(255, 255, 255, 220), 4.5}, {colors::target(), 1.8}}) {
      painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(bar);
      painter.drawLine(QLineF(from - across, from + across));
      painter.drawLine(QLineF(to - across, to + across));
    }
    painter.restore();
    paintLabel(painter, scene_, textOf(*line), 0.5 * (from + to));
  }

 private:
  using Line = ViewSettings::Measure;
  enum class End { From, To };

  /// What was measured last, or what the recipe holds.
  std::optional<Line> shown() const {
    if (scene_.view.measure()) return scene_.view.measure();
    const auto& line = scene_.session.recipe().scaleLine;
    return line ? std::optional(Line{line->fromPx, line->toPx}) : std::nullopt;
  }

  std::optional<End> endAt(const Vec2& px) const {
    const auto line = shown();
    if (!line) return std::nullopt;
    const double reach = scene_.reachImagePx();
    if ((line->toPx - px).norm() <= reach) return End::To;
    if ((line->fromPx - px).norm() <= reach) return End::From;
    return std::nullopt;
  }

  void drag(const ToolEvent& event) {
    Vec2& end = held_ == End::From ? line_.fromPx : line_.toPx;
    const Vec2& other = held_ == End::From ? line_.toPx : line_.fromPx;
    end = event.px;
    const Vec2 offset = end - other;
    if (!event.modifiers.testFlag(Qt::ShiftModifier) || offset.norm() == 0.0) return;
    const double step = kSteepDeg * kRadPerDeg, angle = step * std::round(std::atan2(offset.y(), offset.x()) / step);
    const Vec2 along(std::cos(angle), std::sin(angle));
    end = other + offset.dot(along) * along;
  }

  void finish() {
    if ((line_.toPx - line_.fromPx).norm() < 1.0) return scene_.repaint();
    const auto& known = scene_.session.recipe().scaleLine;
    // An end was moved: the length is known already.
    if (known && !scene_.view.measure() && before_ &&
        (before_->fromPx == line_.fromPx || before_->toPx == line_.toPx)) {
      Recipe after = scene_.session.recipe();
      setScaleLine(after, {line_.fromPx, line_.toPx, known->lengthMm});
      return scene_.session.change(scaleText("Move scale"), std::move(after));
    }
    scene_.view.setMeasure(line_);
  }

  QString textOf(const Line& line) const {
    const double px = (line.toPx - line.fromPx).norm();
    const auto& known = scene_.session.recipe().scaleLine;
    const bool isKnown = known && known->fromPx == line.fromPx && known->toPx == line.toPx;
    const QString pixels = scaleText("%1 px").arg(px, 0, 'f', 1);
    if (!isKnown) return pixels;
    return scaleText("%1 mm = %2").arg(known->lengthMm, 0, 'g', 6).arg(pixels);
  }

  Line line_;
  std::optional<Line> before_;
  std::optional<End> over_, held_;
  QPointF pressedAt_;
  bool isPressed_ = false, isFollowing_ = false;
};

}  // namespace

std::unique_ptr<CanvasTool> makeScaleTool(CanvasScene& scene) { return std::make_unique<ScaleTool>(scene); }

}  // namespace batten
