// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/select_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>

#include "ui/canvas/layers/junction_layer.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/junction_edits.h"
#include "ui/session/edits/pen_edits.h"
#include "ui/session/view/judged_view.h"

namespace batten {
namespace {

class SelectTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    if (const ExtremumMark* mark = scene_.extremumNear(event.px); mark && mark->note) {
      const int note = *mark->note;
      over_.reset();
      return toggleExtremum(scene_.session, scene_.session.selectedCurve(), note);
    }
    if (const auto junction = markedJunction(event.px))
      return pairNext(scene_.session, junctionsOf(scene_.session)[*junction]);
    const auto curve = scene_.curveNear(event.px);
    if (!curve) return;
    if (*curve == scene_.session.selectedCurve() && judgedIn(scene_.view) == Judged::Result)
      return pointAtSpanNear(scene_.session, event.px);
    scene_.session.selectCurve(*curve);
    move(event, false);  // the mouse stands still, but what a click does is another thing now
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed) return;
    const ExtremumMark* mark = scene_.extremumNear(event.px);
    const auto over = mark ? std::optional(*mark) : std::nullopt;
    if (over.has_value() != over_.has_value() || (over && over->px != over_->px)) scene_.repaint();
    over_ = over;
    const auto junction = over ? std::nullopt : markedJunction(event.px);
    if (junction != overJunction_) scene_.repaint();
    overJunction_ = junction;
    if (junction) return scene_.hint(junctionHint(scene_, junctionsOf(scene_.session)[*junction]));
    const auto curve = scene_.curveNear(event.px);
    const bool isOnSpan =
        curve && *curve == scene_.session.selectedCurve() && !over_ && judgedIn(scene_.view) == Judged::Result;
    isOver_ = curve.has_value() && *curve != scene_.session.selectedCurve();
    scene_.hint(over_ ? over_->text : isOver_ ? hintFor(*curve) : isOnSpan ? spanHint() : QString());
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    const auto stroke = strokeOf(scene_.session, scene_.session.selectedCurve());
    if (stroke) removeStroke(scene_.session, *stroke);
    return stroke.has_value();
  }

  void paint(QPainter& painter) override {
    if (over_) paintLabel(painter, scene_, over_->text, scene_.transform.toWidget(over_->px));
    const auto junctions = junctionsOf(scene_.session);
    if (!overJunction_ || *overJunction_ >= std::ssize(junctions)) return;
    const StrokeJunction& junction = junctions[*overJunction_];
    paintPairs(painter, scene_, junction);
    paintLabel(painter, scene_, junctionHint(scene_, junction), scene_.transform.toWidget(junction.positionPx));
  }

  void leave() override { reset(); }
  void reset() override {
    isOver_ = false;
    over_.reset();
    overJunction_.reset();
  }
  Qt::CursorShape cursorShape() const override {
    return isOver_ || overJunction_ || (over_ && over_->note) ? Qt::PointingHandCursor : Qt::ArrowCursor;
  }

 private:
  /// A junction that is marked because its strokes might be paired otherwise.
  std::optional<int> markedJunction(const Vec2& px) const {
    if (!scene_.view.isVisible(Layer::Junctions)) return std::nullopt;
    return junctionNear(scene_, px, kMarkReachPx, true);
  }
  static QString spanHint() {
    return QCoreApplication::translate("CurveCanvas", "Click a span of the curve to show the targets for that span.");
  }
  QString hintFor(int curve) const {
    const QString text =
        QCoreApplication::translate("CurveCanvas", "Click to select %1.").arg(curveName(scene_.session, curve));
    // A line that fairing has not moved is told from one that was forgotten.
    if (judgedIn(scene_.view) != Judged::Result) return text;
    return (text + QLatin1Char(' ') + whyLeftAsDrawn(scene_.session.curves()[curve])).trimmed();
  }

  bool isOver_ = false;
  std::optional<ExtremumMark> over_;  ///< The mark under the mouse.
  std::optional<int> overJunction_;   ///< Likewise.
};

}  // namespace

std::unique_ptr<CanvasTool> makeSelectTool(CanvasScene& scene) { return std::make_unique<SelectTool>(scene); }

}  // namespace batten
