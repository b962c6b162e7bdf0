// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <optional>

#include "core/base/vec2.h"
#include "core/contour/edge_choices.h"
#include "core/curve/closest_point.h"
#include "core/image/rectification.h"

namespace batten {

/// What the canvas can show, in painting order.
enum class Layer {
  Scan,
  LogImage,
  Paper,
  Mask,
  Edges,
  Segments,
  Curve,
  Faired,
  Comb,
  Corners,
  Regions,
  Deviation,
  Extrema,
  Band,
  Strokes,
  Fallback,
  Junctions,
  Explained
};
// all, in the order of the enumeration
inline constexpr std::array kLayers = {Layer::Scan,     Layer::LogImage,  Layer::Paper,    Layer::Mask, Layer::Edges,
                                       Layer::Segments, Layer::Curve,     Layer::Faired,   Layer::Comb, Layer::Corners,
                                       Layer::Regions,  Layer::Deviation, Layer::Extrema,  Layer::Band, Layer::Strokes,
                                       Layer::Fallback, Layer::Junctions, Layer::Explained};
/// Its place in arrays with one entry a layer.
constexpr std::size_t indexOf(Layer layer) { return static_cast<std::size_t>(layer); }
QString label(Layer);  ///< "Scan", "Log picture", …

/// What a press on the canvas does. Pan and zoom work in every tool.
enum class Tool {
  Select,      ///< Click selects a curve.
  Thresholds,  ///< Click selects a region; wheel or vertical drag changes its threshold.
  Corners,     ///< Click on a line marks a corner, click on a corner removes it.
  Pen,         ///< Drag draws a line; click selects a drawn one, Del removes it.
  Segments,    ///< Click on a line sets a place where typical curves meet, click on it removes it.
  Lines,       ///< Click leaves a line out or takes it in again.
  Rectangle,   ///< Drag draws a rectangle: only what lies inside the regions is traced.
  Lasso,       ///< The same drawn freely.
  Scale,       ///< Drag measures a known length; the Scan panel asks how long it is.
  Direction,   ///< Click turns the direction in which a curve is exported; drag of its ring moves the start.
  Junctions,   ///< Click on a junction takes the next pairing of its strokes; click on two branches pairs these.
  Sheet,       ///< Drag moves the corners of the sheet by which the page is to be rectified.
  Ink,         ///< Click on an ink leaves it out or traces it again.
  Paint,       ///< Drag paints the trace mode of ink.
};
// all
inline constexpr std::array kTools = {Tool::Select,    Tool::Thresholds, Tool::Corners, Tool::Pen,   Tool::Segments,
                                      Tool::Lines,     Tool::Rectangle,  Tool::Lasso,   Tool::Scale, Tool::Direction,
                                      Tool::Junctions, Tool::Sheet,      Tool::Ink,     Tool::Paint};

/// Its place in arrays with one entry a tool.
constexpr std::size_t indexOf(Tool tool) { return static_cast<std::size_t>(tool); }

/// How the drawing is shown: never part of the recipe, never undone, kept between sessions.
class ViewSettings : public QObject {
  Q_OBJECT
 public:
  explicit ViewSettings(QObject* parent = nullptr);
  bool isVisible(Layer layer) const { return visible_[indexOf(layer)]; }
  void setVisible(Layer, bool);
  /// The same by the user's hand: from then on no stage switches the layer.
  void choose(Layer layer, bool visible) {
    emit chosen(layer);
    setVisible(layer, visible);
  }
  Tool tool() const { return tool_; }
  void setTool(Tool);
  double combScale() const { return combScale_; }  ///< [-] 0.05..20, factor on the automatic comb height.
  void setCombScale(double);
  bool combShowsRadius() const { return combShowsRadius_; }  ///< Quills as long as the radius, as in the papers.
  void setCombShowsRadius(bool);
  bool radiusIsLinear() const { return radiusIsLinear_; }  ///< Axis of the radius plot; else logarithmic.
  void setRadiusIsLinear(bool);
  int combDensity() const { return combDensity_; }  ///< 20..1000 quills a curve.
  void setCombDensity(int);
  std::optional<int> selectedRegion() const { return selectedRegion_; }  ///< 0..63
  void setSelectedRegion(std::optional<int> region);
  double suggestionAngleDeg() const {
    return suggestionAngleDeg_;
  }  ///< [deg] 10..150, least turn of a suggested corner.
  void setSuggestionAngleDeg(double);
  double suggestionScalePx() const {
    return suggestionScalePx_;
  }  ///< [px] 6..60, length over which a turn is looked at.
  void setSuggestionScalePx(double);
  bool showsUniformKnots() const { return showsUniform_; }  ///< Control polygon: the curve without repeated knots too.
  void setShowsUniformKnots(bool);
  bool showsMaskUncleaned() const { return maskUncleaned_; }  ///< While thresholds are set: the ink as they find it.
  void setShowsMaskUncleaned(bool);
  bool comparesPinned() const { return comparesPinned_; }  ///< Where curves are judged: the pinned ones lie over them.
  void setComparesPinned(bool);
  /// Two places of the page between which the user has measured, whose distance is not told yet [px].
  struct Measure {
    Vec2 fromPx = Vec2::Zero(), toPx = Vec2::Zero();
  };
  const std::optional<Measure>& measure() const { return measure_; }
  void setMeasure(std::optional<Measure>);
  /// Corners of the sheet that the user has moved, px of the page that is shown, until it is rectified by them.
  const std::optional<SheetCorners>& sheetCorners() const { return sheetCorners_; }
  void setSheetCorners(const std::optional<SheetCorners>&);
  void requestRectify() { emit rectifyRequested(); }
  /// What the brush of Tool::Paint makes of ink.
  EdgeMode paintedMode() const { return paintedMode_; }
  void setPaintedMode(EdgeMode);
  double brushPx() const { return brushPx_; }  ///< [widget px] 2..100, its radius.
  void setBrushPx(double);
  bool isScanOnly() const { return scanOnly_; }  ///< While the compare key is held.
  void setScanOnly(bool);

 signals:
  void changed();
  void chosen(batten::Layer layer);
  void toolChanged(batten::Tool tool);
  void selectedRegionChanged();
  void measureChanged();
  void rectifyRequested();

 private:
  std::array<bool, kLayers.size()> visible_{};
  Tool tool_ = Tool::Select;
  double combScale_ = 1.0;
  int combDensity_ = 120;
  std::optional<int> selectedRegion_;
  double suggestionAngleDeg_ = 35.0;
  double suggestionScalePx_ = 14.0;
  std::optional<Measure> measure_;
  std::optional<SheetCorners> sheetCorners_;
  EdgeMode paintedMode_ = EdgeMode::Outline;
  double brushPx_ = 12.0;
  bool scanOnly_ = false, showsUniform_ = false, maskUncleaned_ = false, comparesPinned_ = false;
  bool combShowsRadius_ = false, radiusIsLinear_ = false;
};

}  // namespace batten
