// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/region_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QPen>
#include <algorithm>
#include <cmath>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/region_edits.h"

namespace batten {
namespace {

constexpr double kSmallestPx = 6.0;        // [widget px] a smaller drag was a click
constexpr double kLassoStepPx = 4.0;       // [widget px] between corners of a lasso
constexpr std::size_t kMostCorners = 200;  // of a lasso, about: it is thinned to them

QString tr(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class RegionTool final : public CanvasTool {
 public:
  RegionTool(CanvasScene& scene, bool isLasso) : CanvasTool(scene), isLasso_(isLasso) {}

  void press(const ToolEvent& event) override {
    drawn_ = {event.px};
    isDrawing_ = true;
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (!isPressed || !isDrawing_) {
      scene_.hint(
          scene_.session.recipe().regions.empty()
              ? (isLasso_ ? tr("Draw around the area to trace.") : tr("Drag a rectangle around the area to trace."))
              : tr("Draw another region to add to it; Delete traces the whole page again."));
      return;
    }
    if (!isLasso_) {
      drawn_.resize(1);
      drawn_.push_back(event.px);
    } else if ((event.px - drawn_.back()).norm() >= kLassoStepPx * scene_.transform.imagePerWidget()) {
      drawn_.push_back(event.px);
    }
    scene_.repaint();
  }

  void release(const ToolEvent& event) override {
    if (!isDrawing_) return;
    move(event, true);
    isDrawing_ = false;
    const RegionOfInterest region = regionDrawn();
    drawn_.clear();
    scene_.repaint();
    if (region.cornersPx.empty() || validate(region)) {
      scene_.flash(event.px);
      return;
    }
    Recipe recipe = scene_.session.recipe();
    recipe.regions.push_back(region);
    scene_.session.change(tr("Draw region"), std::move(recipe));
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    if (scene_.session.recipe().regions.empty()) return false;
    clearRegions(scene_.session);
    return true;
  }

  void abort() override {
    reset();
    scene_.repaint();
  }
  void reset() override {
    drawn_.clear();
    isDrawing_ = false;
  }
  Qt::CursorShape cursorShape() const override { return Qt::CrossCursor; }

  void paint(QPainter& painter) override {
    if (drawn_.size() < 2) return;
    QPolygonF polygon;
    if (isLasso_) {
      for (const Vec2& p : drawn_) polygon.append(scene_.transform.toWidget(p));
    } else {
      for (const Vec2& p : rectangleRegion(drawn_.front(), drawn_.back()).cornersPx)
        polygon.append(scene_.transform.toWidget(p));
    }
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing, isLasso_);
    painter.setPen(QPen(colors::accent(), 1.4));
    painter.setBrush(colors::halo());
    painter.drawPolygon(polygon);
    painter.restore();
  }

 private:
  /// What was drawn, empty when it was hardly a drag.
  RegionOfInterest regionDrawn() const {
    const double least = kSmallestPx * scene_.transform.imagePerWidget();
    Vec2 low = drawn_.front(), high = low;
    for (const Vec2& p : drawn_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if ((high - low).minCoeff() < least) return {};
    if (!isLasso_) return rectangleRegion(drawn_.front(), drawn_.back());
    RegionOfInterest region;
    const std::size_t step = drawn_.size() / kMostCorners + 1;
    for (std::size_t i = 0; i < drawn_.size(); i += step) region.cornersPx.push_back(drawn_[i]);
    return region;
  }

  bool isLasso_;
  bool isDrawing_ = false;
  std::vector<Vec2> drawn_;  ///< [px] the corners so far; rectangle: two opposite ones.
};

}  // namespace

std::unique_ptr<CanvasTool> makeRegionTool(CanvasScene& scene, bool isLasso) {
  return std::make_unique<RegionTool>(scene, isLasso);
}

}  // namespace batten
