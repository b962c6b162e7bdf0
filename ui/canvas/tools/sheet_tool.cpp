// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/sheet_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QPen>
#include <QPolygonF>
#include <algorithm>

#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/rectify_edits.h"

namespace batten {
namespace {

constexpr double kHandlePx = 6.0;  // [widget px] half a handle

QString sheetText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class SheetTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    if (!scene_.session.hasScan()) return;
    before_ = corners();
    held_ = cornerAt(event.px);
    if (held_) grip_ = corners()[*held_] - event.px;
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed && held_) {
      SheetCorners moved = corners();
      moved[*held_] = event.px + grip_;
      scene_.view.setSheetCorners(moved);
      return scene_.repaint();
    }
    over_ = scene_.session.hasScan() ? cornerAt(event.px) : std::nullopt;
    scene_.hint(sheetText("Drag the corners onto those of the sheet; Enter rectifies the page."));
  }

  void release(const ToolEvent&) override { held_.reset(); }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) return false;
    if (!scene_.session.hasScan()) return false;
    scene_.view.requestRectify();
    return true;
  }

  void abort() override {
    if (held_) scene_.view.setSheetCorners(before_);
    held_.reset();
    scene_.repaint();
  }
  void leave() override { over_.reset(); }
  void reset() override {
    held_.reset();
    over_.reset();
  }
  Qt::CursorShape cursorShape() const override { return over_ || held_ ? Qt::SizeAllCursor : Qt::ArrowCursor; }

  void paint(QPainter& painter) override {
    if (!scene_.session.hasScan()) return;
    QPolygonF polygon;
    for (const Vec2& corner : corners()) polygon.append(scene_.transform.toWidget(corner));
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (const auto& [color, width] : {std::pair{colors::casing(), 4.0}, {colors::accent(), 1.6}}) {
      painter.setPen(QPen(color, width));
      painter.setBrush(Qt::NoBrush);
      painter.drawPolygon(polygon);
    }
    for (int i = 0; i < polygon.size(); ++i) {
      const bool isHeld = (held_ ? held_ : over_) == i;
      painter.setPen(QPen(colors::accent(), 1.6));
      painter.setBrush(isHeld ? colors::accent() : QColor(Qt::white));
      painter.drawEllipse(polygon[i], kHandlePx, kHandlePx);
    }
    painter.restore();
    if (!polygon.isEmpty()) paintLabel(painter, scene_, sheetText("top left"), polygon.front());
  }

 private:
  SheetCorners corners() const { return scene_.view.sheetCorners().value_or(shownSheetCorners(scene_.session)); }
  std::optional<int> cornerAt(const Vec2& px) const {
    const SheetCorners all = corners();
    const auto nearest = std::ranges::min_element(all, {}, [&](const Vec2& c) { return (c - px).squaredNorm(); });
    if ((*nearest - px).norm() > 2.0 * kHandlePx * scene_.transform.imagePerWidget()) return std::nullopt;
    return static_cast<int>(nearest - all.begin());
  }

  std::optional<int> held_, over_;
  SheetCorners before_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  Vec2 grip_ = Vec2::Zero();
};

}  // namespace

std::unique_ptr<CanvasTool> makeSheetTool(CanvasScene& scene) { return std::make_unique<SheetTool>(scene); }

}  // namespace batten
