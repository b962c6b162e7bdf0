// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/paint_tool.h"

#include <QCoreApplication>
#include <QImage>
#include <QKeyEvent>
#include <QPen>
#include <cmath>
#include <memory>
#include <utility>

#include "ui/canvas/layers/kind_layer.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/trace_mode_edits.h"

namespace batten {
namespace {

constexpr double kStepShare = 0.25;    // of the brush: places nearer to the last one say nothing new
constexpr double kBrushGrowth = 1.25;  // of a key press

QString paintText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class PaintTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    if (!scene_.session.hasScan() || scene_.session.isBlankPage()) return;
    drawn_ =
        PaintedInk{{event.px}, scene_.view.brushPx() * scene_.transform.imagePerWidget(), scene_.view.paintedMode()};
    at_ = event.widget;
    scene_.repaint();
  }

  void move(const ToolEvent& event, bool isPressed) override {
    at_ = event.widget;
    if (isPressed && drawn_) {
      const double step = (event.px - drawn_->coursePx.back()).norm();
      if (step >= kStepShare * drawn_->radiusPx) drawn_->coursePx.push_back(event.px);
    } else {
      scene_.hint(hint());
    }
    scene_.repaint();
  }

  void release(const ToolEvent& event) override {
    auto drawn = std::exchange(drawn_, std::nullopt);
    if (!drawn) return;
    if (event.px != drawn->coursePx.back()) drawn->coursePx.push_back(event.px);
    if (!paintTraceMode(scene_.session, std::move(*drawn))) scene_.flash(event.px);
    scene_.repaint();
  }

  bool key(QKeyEvent* event) override {
    const bool isLarger = event->text() == QLatin1String("]");
    if (!isLarger && event->text() != QLatin1String("[")) return false;
    scene_.view.setBrushPx(scene_.view.brushPx() * (isLarger ? kBrushGrowth : 1.0 / kBrushGrowth));
    scene_.repaint();
    return true;
  }

  void abort() override {
    drawn_.reset();
    scene_.repaint();
  }
  void leave() override {
    at_.reset();
    scene_.repaint();
  }
  void reset() override {
    drawn_.reset();
    at_.reset();
    kinds_ = {};
  }
  Qt::CursorShape cursorShape() const override { return Qt::CrossCursor; }

  void paint(QPainter& painter) override {
    refreshKinds();
    if (!kinds_.isNull()) painter.drawImage(QPointF(0, 0), kinds_);
    paintPainted(painter, scene_);
    if (drawn_) paintCourse(painter, scene_, *drawn_);
    if (!at_) return;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const auto& [colour, width] : {std::pair{colors::casing(), 4.0}, {colourOf(scene_.view.paintedMode()), 1.8}}) {
      painter.setPen(QPen(colour, width));
      painter.drawEllipse(*at_, scene_.view.brushPx(), scene_.view.brushPx());
    }
    painter.restore();
  }

 private:
  struct KindsKey {
    const void* contours = nullptr;
    QPoint origin;
    QSize size;
    double zoom = 0.0, ratio = 0.0;
    bool operator==(const KindsKey&) const = default;
  };
  /// Kept while nothing of it changes: the mouse moves often, and a page has many lines.
  void refreshKinds() {
    const KindsKey key{scene_.session.output().contours.get(), scene_.transform.origin(), scene_.transform.viewSize(),
                       scene_.transform.zoom(), scene_.transform.ratio()};
    if (!kinds_.isNull() && key == key_) return;
    key_ = key;
    kinds_ = QImage(key.size, QImage::Format_ARGB32_Premultiplied);
    if (kinds_.isNull()) return;
    kinds_.setDevicePixelRatio(key.ratio);
    kinds_.fill(Qt::transparent);
    QPainter painter(&kinds_);
    paintKinds(painter, scene_);
  }

  QString hint() const {
    switch (scene_.view.paintedMode()) {
      case EdgeMode::Outline:
        return paintText("Drag over ink that is to be traced by its outline; [ and ] change the brush.");
      case EdgeMode::Centreline:
        return paintText("Drag over ink that is to be traced by its centre line; [ and ] change the brush.");
      case EdgeMode::Automatic:
        break;
    }
    return paintText("Drag over ink that is to be traced as the page; [ and ] change the brush.");
  }

  std::optional<PaintedInk> drawn_;
  std::optional<QPointF> at_;
  QImage kinds_;
  KindsKey key_;
};

}  // namespace

std::unique_ptr<CanvasTool> makePaintTool(CanvasScene& scene) { return std::make_unique<PaintTool>(scene); }

}  // namespace batten
