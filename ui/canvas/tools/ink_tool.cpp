// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/ink_tool.h"

#include <QCoreApplication>
#include <memory>
#include <utility>

#include "core/image/colour/ink_picker.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/guarded.h"
#include "ui/session/background/inbox.h"
#include "ui/session/edits/ink_edits.h"

namespace batten {
namespace {

constexpr double kInkReachWidgetPx = 6.0;  // an ink is meant where it is pointed at, not beside

QString inkToolText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class InkTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    lookAtPaper();
    if (!isReady()) {
      pending_ = event;  // the paper's colour is measured once, in a moment
      return;
    }
    const auto ink = inkAt(event.px);
    if (!ink) return scene_.flash(event.px);
    if (event.modifiers.testFlag(Qt::ShiftModifier))
      keepOnlyInk(scene_.session, ink->colour);
    else
      setInkDropped(scene_.session, ink->colour, isTraced(ink->colour, scene_.session.recipe().preparation.inks));
    show(event);
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed) return;
    lookAtPaper();
    show(event);
  }

  void recipeChanged() override {
    if (at_) show(*at_);
  }
  void leave() override {
    at_.reset();
    over_.reset();
    scene_.repaint();
  }
  void reset() override {
    worker_.cancelAll();
    paper_.reset();
    of_.reset();
    pending_.reset();
    at_.reset();
    over_.reset();
  }
  Qt::CursorShape cursorShape() const override { return Qt::CrossCursor; }

  void paint(QPainter& painter) override {
    if (!over_ || !at_) return;
    constexpr double kSwatchPx = 9.0, kAbovePx = 22.0;  // [widget px] size, and distance from the mouse
    const QPointF centre = at_->widget + QPointF(0.0, -kAbovePx);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(colors::casing(), 5.0));
    painter.drawEllipse(centre, kSwatchPx, kSwatchPx);
    painter.setPen(QPen(colors::pen(), 1.4));
    painter.setBrush(QColor(over_->shown.red, over_->shown.green, over_->shown.blue));
    painter.drawEllipse(centre, kSwatchPx, kSwatchPx);
    painter.restore();
    paintLabel(painter, scene_, hintFor(*over_), centre);
  }

 private:
  /// The paper as it was measured, and the scan whose pixels it reads.
  struct Paper {
    std::shared_ptr<const Scan> scan;
    InkPicker picker;
  };
  bool isReady() const { return paper_ && paper_->scan == scene_.session.scan(); }

  void lookAtPaper() {
    const auto scan = scene_.session.scan();
    if (!scan || of_ == scan) return;
    of_ = scan;
    worker_.start([this, scan](const CancelToken& token) {
      auto paper = guarded<std::shared_ptr<const Paper>>([&]() -> Result<std::shared_ptr<const Paper>> {
        RunContext context;
        context.cancel = token;
        return std::make_shared<const Paper>(Paper{scan, InkPicker(scan->grey, scan->colour, context)});
      });
      if (token.isCancelled()) return;
      if (paper)
        inbox_.post([this, paper = *paper] { take(paper); });
      else
        inbox_.post([this, scan] { giveUp(scan); });
    });
  }

  void take(std::shared_ptr<const Paper> paper) {
    if (paper->scan != scene_.session.scan()) return;
    paper_ = std::move(paper);
    if (const auto event = std::exchange(pending_, std::nullopt)) press(*event);
    if (at_) show(*at_);
  }

  // For want of memory: the next movement of the mouse tries again.
  void giveUp(const std::shared_ptr<const Scan>& scan) {
    if (of_ == scan) of_.reset();
    if (const auto event = std::exchange(pending_, std::nullopt)) scene_.flash(event->px);
  }

  /// As the inks of the page are listed, where one of them is meant: the one nearest by hue.
  std::optional<FoundInk> inkAt(const Vec2& px) const {
    if (!isReady()) return std::nullopt;
    auto ink = paper_->picker.inkAt(px, kInkReachWidgetPx * scene_.transform.imagePerWidget());
    const auto& page = scene_.session.output().page;
    if (!ink || !page) return ink;
    const double range = scene_.session.recipe().preparation.inks.rangeDeg;
    const FoundInk* nearest = nullptr;
    for (const FoundInk& listed : page->inks) {
      if (!isSameInk(listed.colour, ink->colour, range)) continue;
      if (!nearest || hueApartDeg(listed.colour, ink->colour) < hueApartDeg(nearest->colour, ink->colour))
        nearest = &listed;
    }
    return nearest ? std::optional(*nearest) : ink;
  }

  void show(const ToolEvent& event) {
    at_ = event;
    over_ = inkAt(event.px);
    scene_.hint(over_ ? hintFor(*over_) : idleHint());
    scene_.repaint();
  }

  QString idleHint() const {
    const auto scan = scene_.session.scan();
    if (scan && scan->colour.isEmpty()) return inkToolText("The scan has no colours.");
    return inkToolText("Click an ink to exclude it; Shift+click traces it alone.");
  }
  QString hintFor(const FoundInk& ink) const {
    const QString name = inkName(ink.colour);
    if (!isTraced(ink.colour, scene_.session.recipe().preparation.inks))
      return inkToolText("%1, excluded: click to trace it again").arg(name);
    if (isOnlyInk(scene_.session, ink.colour))
      return inkToolText("%1, traced alone: Shift+click to trace the others, too").arg(name);
    return inkToolText("%1: click to exclude it, Shift+click to trace it alone").arg(name);
  }

  std::shared_ptr<const Scan> of_;  ///< Whose paper is measured, or was.
  std::shared_ptr<const Paper> paper_;
  std::optional<ToolEvent> pending_;  ///< A click that came before.
  std::optional<ToolEvent> at_;       ///< Where the mouse is.
  std::optional<FoundInk> over_;
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last: joined before what its jobs use goes away.
};

}  // namespace

std::unique_ptr<CanvasTool> makeInkTool(CanvasScene& scene) { return std::make_unique<InkTool>(scene); }

}  // namespace batten
