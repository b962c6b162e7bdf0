// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/threshold_tool.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QPainterPath>
#include <QPen>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/image/threshold/region_values.h"
#include "ui/canvas/layers/region_grid_layer.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/view/grey_scale.h"

namespace batten {
namespace {

constexpr double kLevelsPerPx = 0.5;       ///< Of a vertical drag.
constexpr double kLevelsPerNotch = 2.0;    // Of the wheel.
constexpr qint64 kWheelPauseMs = 800;      ///< Wheel notches closer than this are one undo step.
constexpr double kLevelDragStartPx = 3.0;  // [widget px] A smaller move is a click.
constexpr double kNumbersFromPx = 54.0;    ///< Width of a region from which its number is shown.

QString tr(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class ThresholdTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    const auto region = regionAt(event.px);
    if (!region) {
      scene_.flash(event.px);
      return;
    }
    select(*region, event.modifiers.testFlag(Qt::ShiftModifier));
    pressed_ = event.widget;
    isDragging_ = false;
    gesture_ = scene_.session.newGesture();
    base_ = levels();
    before_ = scene_.session.recipe();
    wheelGesture_.reset();
  }

  void move(const ToolEvent& event, bool isPressed) override {
    const auto region = regionAt(event.px);
    if (region != hovered_) {
      hovered_ = region;
      scene_.repaint();
    }
    scene_.hint(!region
                    ? QString()
                    : tr("Drag up or down, or turn the wheel, to change this threshold; double-click for automatic."));
    if (!isPressed || base_.empty()) return;
    const double drag = pressed_.y() - event.widget.y();
    if (!isDragging_ && std::abs(drag) < kLevelDragStartPx) return;
    isDragging_ = true;
    apply(base_, drag * kLevelsPerPx, gesture_);
  }

  void release(const ToolEvent&) override {
    base_.clear();
    before_.reset();
    isDragging_ = false;
  }

  void abort() override {
    if (before_ && isDragging_) change(*before_, gesture_);
    base_.clear();
    before_.reset();
    isDragging_ = false;
  }

  void recipeChanged() override {
    // After undo the wheel begins from what it finds.
    if (!isChanging_) wheelGesture_.reset();
  }

  void doubleClick(const ToolEvent& event) override {
    if (!regionAt(event.px)) return;
    Recipe recipe = scene_.session.recipe();
    for (const int r : chosen()) recipe.threshold.grid[r].reset();
    scene_.session.change(tr("Automatic threshold"), recipe);
    base_.clear();
  }

  bool wheel(const ToolEvent& event, double steps) override {
    const auto region = regionAt(event.px);
    if (!region || event.modifiers.testFlag(Qt::ControlModifier)) return false;
    const auto set = chosen();
    const bool inSet = std::find(set.begin(), set.end(), *region) != set.end();
    const bool continues = inSet && wheelGesture_ && sinceWheel_.isValid() && sinceWheel_.elapsed() < kWheelPauseMs;
    if (!inSet) select(*region, false);
    if (!continues) {
      wheelGesture_ = scene_.session.newGesture();
      wheelBase_ = levels();
      wheelSteps_ = 0.0;
    }
    sinceWheel_.start();
    // Fine wheels and touchpads send small fractions of a notch: they add up, each alone would be rounded away.
    wheelSteps_ += steps;
    apply(wheelBase_, wheelSteps_ * kLevelsPerNotch, wheelGesture_);
    return true;
  }

  bool key(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace) return false;
    Recipe recipe = scene_.session.recipe();
    for (const int r : chosen()) recipe.threshold.grid[r].reset();
    scene_.session.change(tr("Automatic threshold"), recipe);
    return true;
  }

  void leave() override {
    hovered_.reset();
    scene_.repaint();
  }
  void reset() override {
    hovered_.reset();
    lastCorner_.reset();
    base_.clear();
  }
  Qt::CursorShape cursorShape() const override { return hovered_ ? Qt::SizeVerCursor : Qt::ArrowCursor; }

  void paint(QPainter& painter) override {
    const QSize size = scene_.transform.imageSize();
    if (size.isEmpty()) return;
    paintRegionGrid(painter, scene_);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    if (hovered_) painter.fillRect(rectOf(*hovered_), QColor(11, 107, 203, 22));
    for (const int r : chosen()) {
      painter.setPen(QPen(colors::accent(), 1.6));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(rectOf(r).adjusted(0.5, 0.5, -0.5, -0.5));
    }
    paintNumbers(painter);
    painter.restore();
  }

 private:
  using Levels = std::vector<std::pair<int, double>>;

  std::optional<int> regionAt(const Vec2& px) const {
    const QSize size = scene_.transform.imageSize();
    if (size.isEmpty() || px.x() < 0 || px.y() < 0 || px.x() >= size.width() || px.y() >= size.height())
      return std::nullopt;
    // Bounds are floor(i * size / 8): the inverse is exact up to one, which the loop settles.
    const auto index = [](double at, int extent) {
      int i = std::clamp(static_cast<int>(at * kRegionsPerSide / extent), 0, kRegionsPerSide - 1);
      while (i + 1 < kRegionsPerSide && at >= (i + 1) * extent / kRegionsPerSide) ++i;
      return i;
    };
    return index(px.y(), size.height()) * kRegionsPerSide + index(px.x(), size.width());
  }

  QRectF rectOf(int region) const {
    const RegionBounds b =
        regionBounds(scene_.transform.imageSize().width(), scene_.transform.imageSize().height(), region);
    return {scene_.transform.toWidget({static_cast<double>(b.x0), static_cast<double>(b.y0)}),
            scene_.transform.toWidget({static_cast<double>(b.x1), static_cast<double>(b.y1)})};
  }

  /// The threshold that acts in a region now.
  double level(int region) const {
    const ThresholdParams& params = scene_.session.recipe().threshold;
    if (params.grid[region]) return *params.grid[region];
    if (params.mode == ThresholdMode::Manual) return params.manualLevel;
    const auto& found = scene_.session.output().thresholds;
    return found ? found->automatic[region] : params.manualLevel;
  }

  /// The selected region, or the rectangle from it to where Shift was clicked.
  std::vector<int> chosen() const {
    const auto selected = scene_.view.selectedRegion();
    if (!selected) return {};
    const int anchor = *selected, other = anchor == rectangleAnchor_ ? lastCorner_.value_or(anchor) : anchor;
    const int c0 = anchor % kRegionsPerSide, c1 = other % kRegionsPerSide;
    const int r0 = anchor / kRegionsPerSide, r1 = other / kRegionsPerSide;
    std::vector<int> regions;
    for (int r = std::min(r0, r1); r <= std::max(r0, r1); ++r)
      for (int c = std::min(c0, c1); c <= std::max(c0, c1); ++c) regions.push_back(r * kRegionsPerSide + c);
    return regions;
  }

  void select(int region, bool extend) {
    if (extend && scene_.view.selectedRegion()) {
      rectangleAnchor_ = scene_.view.selectedRegion();
      lastCorner_ = region;
    } else {
      lastCorner_.reset();
      scene_.view.setSelectedRegion(region);
    }
    scene_.repaint();
  }

  Levels levels() const {
    Levels all;
    for (const int r : chosen()) all.emplace_back(r, level(r));
    return all;
  }

  void apply(const Levels& base, double levels, GestureId gesture) {
    Recipe recipe = scene_.session.recipe();
    for (const auto& [region, from] : base)
      recipe.threshold.grid[region] = std::clamp(std::round(2.0 * (from + levels)) / 2.0, 0.0, 255.0);
    change(std::move(recipe), gesture);
  }

  void change(Recipe after, GestureId gesture) {
    isChanging_ = true;
    scene_.session.change(tr("Region threshold"), std::move(after), gesture);
    isChanging_ = false;
    scene_.repaint();
  }

  void paintNumbers(QPainter& painter) const {
    const auto& found = scene_.session.output().thresholds;
    const auto& grid = scene_.session.recipe().threshold.grid;
    QFont font = scene_.font;
    font.setPixelSize(11);
    const GreyScale scale(scene_.session, scene_.view);
    const bool roomy = rectOf(0).width() >= kNumbersFromPx;
    for (int r = 0; r < kRegions; ++r) {
      const bool isOwn = grid[r].has_value();
      if (!roomy && !isOwn && r != hovered_) continue;
      if (!isOwn && !found) continue;
      font.setBold(isOwn);
      const bool isCertain = isOwn || (found && found->measured[r]);
      const QString number = QString::number(scale.shown(level(r)), 'f', 0);
      // In a light halo, as there may be ink below; a box would hide more of it.
      QPainterPath text;
      text.addText(rectOf(r).topLeft() + QPointF(5.0, 3.0 + QFontMetricsF(font).ascent()), font, number);
      painter.strokePath(text, QPen(QColor(255, 255, 255, 225), 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.fillPath(text, isOwn ? colors::accent() : isCertain ? QColor(30, 30, 30) : QColor(96, 96, 96));
    }
    if (!hovered_) return;
    const int h = *hovered_;
    const QString kind = grid[h]                        ? tr("set by hand")
                         : found && !found->measured[h] ? tr("automatic, from neighbouring regions")
                                                        : tr("automatic");
    paintLabel(painter, scene_, QString::number(scale.shown(level(*hovered_)), 'f', 1) + QStringLiteral(" · ") + kind,
               rectOf(*hovered_).center());
  }

  std::optional<int> hovered_, lastCorner_, rectangleAnchor_;
  QPointF pressed_;
  bool isDragging_ = false;
  GestureId gesture_, wheelGesture_;
  QElapsedTimer sinceWheel_;
  double wheelSteps_ = 0.0;
  Levels base_, wheelBase_;       ///< Regions and their thresholds when the gesture began.
  std::optional<Recipe> before_;  ///< Of the drag in progress.
  bool isChanging_ = false;
};

}  // namespace

std::unique_ptr<CanvasTool> makeThresholdTool(CanvasScene& scene) { return std::make_unique<ThresholdTool>(scene); }

}  // namespace batten
