// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>

#include "ui/canvas/tools/canvas_tool.h"

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

  void leave() override { isOver_ = false; }
  Qt::CursorShape cursorShape() const override { return isOver_ ? Qt::PointingHandCursor : Qt::ArrowCursor; }

 private:
  bool isOver_ = false;
};

}  // namespace

std::unique_ptr<CanvasTool> makeSelectTool(CanvasScene& scene) { return std::make_unique<SelectTool>(scene); }

}  // namespace batten
