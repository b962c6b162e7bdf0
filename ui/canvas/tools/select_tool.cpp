// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QKeyEvent>

#include "ui/canvas/tools/canvas_tool.h"
#include "ui/session/pen_edits.h"

namespace batten {
namespace {

class SelectTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    if (const auto curve = scene_.curveNear(event.px)) scene_.session.selectCurve(*curve);
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed) return;
    const auto curve = scene_.curveNear(event.px);
    isOver_ = curve.has_value() && *curve != scene_.session.selectedCurve();
    scene_.hint(isOver_ ? QCoreApplication::translate("CurveCanvas", "Click to select curve %1.").arg(*curve + 1)
                        : QString());
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    const auto stroke = strokeOf(scene_.session, scene_.session.selectedCurve());
    if (stroke) removeStroke(scene_.session, *stroke);
    return stroke.has_value();
  }

  void leave() override { isOver_ = false; }
  Qt::CursorShape cursorShape() const override { return isOver_ ? Qt::PointingHandCursor : Qt::ArrowCursor; }

 private:
  bool isOver_ = false;
};

}  // namespace

std::unique_ptr<CanvasTool> makeSelectTool(CanvasScene& scene) { return std::make_unique<SelectTool>(scene); }

}  // namespace batten
