// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/view/view_settings.h"

#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "core/curve/closest_point.h"

namespace batten {

QString label(Layer layer) {
  switch (layer) {
    case Layer::Scan:
      return QObject::tr("Scan");
    case Layer::LogImage:
      return QObject::tr("Log picture");
    case Layer::Paper:
      return QObject::tr("Flattened paper");
    case Layer::Mask:
      return QObject::tr("Mask");
    case Layer::Edges:
      return QObject::tr("Edges");
    case Layer::Segments:
      return QObject::tr("Segments");
    case Layer::Curve:
      return QObject::tr("Curve");
    case Layer::Faired:
      return QObject::tr("Faired");
    case Layer::Comb:
      return QObject::tr("Comb");
    case Layer::Corners:
      return QObject::tr("Corners");
    case Layer::Regions:
      return QObject::tr("Regions");
    case Layer::Deviation:
      return QObject::tr("Deviation");
    case Layer::Extrema:
      return QObject::tr("Extrema");
    case Layer::Band:
      return QObject::tr("Noise band");
    case Layer::Strokes:
      return QObject::tr("Strokes");
    case Layer::Fallback:
      return QObject::tr("Points not located");
    case Layer::Junctions:
      return QObject::tr("Junctions");
    case Layer::Explained:
      return QObject::tr("Missed and invented");
  }
  return {};
}

ViewSettings::ViewSettings(QObject* parent) : QObject(parent) {
  for (const Layer layer :
       {Layer::Scan, Layer::Curve, Layer::Faired, Layer::Comb, Layer::Corners, Layer::Extrema, Layer::Band})
    visible_[indexOf(layer)] = true;
}

void ViewSettings::setVisible(Layer layer, bool visible) {
  bool& now = visible_[indexOf(layer)];
  if (now == visible) return;
  now = visible;
  emit changed();
}

void ViewSettings::setTool(Tool tool) {
  if (tool_ == tool) return;
  tool_ = tool;
  emit toolChanged(tool);
}

void ViewSettings::setCombScale(double scale) {
  if (!std::isfinite(scale)) return;
  const double bounded = std::clamp(scale, 0.05, 20.0);
  if (combScale_ == bounded) return;
  combScale_ = bounded;
  emit changed();
}

void ViewSettings::setCombShowsRadius(bool radius) {
  if (combShowsRadius_ == radius) return;
  combShowsRadius_ = radius;
  emit changed();
}

void ViewSettings::setRadiusIsLinear(bool linear) {
  if (radiusIsLinear_ == linear) return;
  radiusIsLinear_ = linear;
  emit changed();
}

void ViewSettings::setCombDensity(int density) {
  const int bounded = std::clamp(density, 20, 1000);
  if (combDensity_ == bounded) return;
  combDensity_ = bounded;
  emit changed();
}

void ViewSettings::setSelectedRegion(std::optional<int> region) {
  if (region && (*region < 0 || *region >= kRegions)) region.reset();
  if (selectedRegion_ == region) return;
  selectedRegion_ = region;
  emit selectedRegionChanged();
}

void ViewSettings::setSuggestionAngleDeg(double degrees) {
  if (!std::isfinite(degrees)) return;
  const double bounded = std::clamp(degrees, 10.0, 150.0);
  if (suggestionAngleDeg_ == bounded) return;
  suggestionAngleDeg_ = bounded;
  emit changed();
}

void ViewSettings::setSuggestionScalePx(double px) {
  if (!std::isfinite(px)) return;
  const double bounded = std::clamp(px, 6.0, 60.0);
  if (suggestionScalePx_ == bounded) return;
  suggestionScalePx_ = bounded;
  emit changed();
}

void ViewSettings::setShowsUniformKnots(bool shows) {
  if (showsUniform_ == shows) return;
  showsUniform_ = shows;
  emit changed();
}

void ViewSettings::setShowsMaskUncleaned(bool shows) {
  if (maskUncleaned_ == shows) return;
  maskUncleaned_ = shows;
  emit changed();
}

void ViewSettings::setComparesPinned(bool compares) {
  if (comparesPinned_ == compares) return;
  comparesPinned_ = compares;
  emit changed();
}

void ViewSettings::setMeasure(std::optional<Measure> measure) {
  if (!measure && !measure_) return;
  measure_ = measure;
  emit measureChanged();
}

void ViewSettings::setSheetCorners(const std::optional<SheetCorners>& corners) {
  if (sheetCorners_ == corners) return;
  sheetCorners_ = corners;
  emit changed();
}

void ViewSettings::setPaintedMode(EdgeMode mode) {
  if (paintedMode_ == mode) return;
  paintedMode_ = mode;
  emit changed();
}

void ViewSettings::setBrushPx(double px) {
  constexpr double kLeastPx = 2.0, kMostPx = 100.0;  // of the brush, on the page
  if (!std::isfinite(px)) return;
  const double bounded = std::clamp(px, kLeastPx, kMostPx);
  if (brushPx_ == bounded) return;
  brushPx_ = bounded;
  emit changed();
}

void ViewSettings::setScanOnly(bool scanOnly) {
  if (scanOnly_ == scanOnly) return;
  scanOnly_ = scanOnly;
  emit changed();
}

}  // namespace batten
