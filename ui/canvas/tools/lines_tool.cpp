// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/lines_tool.h"

#include <QCoreApplication>
#include <QPen>

#include "ui/canvas/layers/choice_layer.h"
#include "ui/canvas/layers/left_out_layer.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {
namespace {

QString linesText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class LinesTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    const auto curve = scene_.curveNear(event.px);
    if (!curve) {
      scene_.flash(event.px);
      return;
    }
    scene_.session.selectCurve(*curve);
    setIncluded(scene_.session, *curve, !isIncluded(*curve));
    over_.reset();
    scene_.hint(hintFor(curve));
    scene_.repaint();
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed) return;
    const auto over = scene_.curveNear(event.px);
    if (over != over_) scene_.repaint();
    over_ = over;
    scene_.hint(hintFor(over_));
  }

  void leave() override {
    over_.reset();
    scene_.repaint();
  }
  void reset() override { over_.reset(); }
  Qt::CursorShape cursorShape() const override { return over_ ? Qt::PointingHandCursor : Qt::ArrowCursor; }

  void paint(QPainter& painter) override {
    if (!scene_.shapes) return;
    paintLeftOut(painter, scene_);
    if (over_ && *over_ < std::ssize(scene_.shapes->curves))
      paintChoice(painter, scene_, scene_.shapes->curves[*over_]);
  }

 private:
  QString hintFor(std::optional<int> curve) const {
    if (!curve) return linesText("Click a line to exclude it; click it again to include it.");
    return isIncluded(*curve)
               ? linesText("Click to exclude %1 from fairing and export.").arg(curveName(scene_.session, *curve))
               : linesText("Click to include %1 again.").arg(curveName(scene_.session, *curve));
  }
  bool isIncluded(int curve) const {
    const PieceChoice* choice = choiceOf(scene_.session, curve);
    return !choice || choice->included;
  }

  std::optional<int> over_;
};

}  // namespace

std::unique_ptr<CanvasTool> makeLinesTool(CanvasScene& scene) { return std::make_unique<LinesTool>(scene); }

}  // namespace batten
