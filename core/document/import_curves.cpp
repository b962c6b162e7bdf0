// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/import_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/conventions.h"

namespace batten {
namespace {

struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());
  void take(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Vec2 size() const { return high - low; }
};

/// Of the curves themselves: control points may lie far outside.
Box boxOf(const ImportedFile& file) {
  constexpr int kPlaces = 32;  // of a span
  Box box;
  for (const ImportedLine& line : file.lines) {
    for (const Vec2& p : line.points) box.take(p);
    for (const NurbsCurve& curve : line.curves) {
      const std::vector<double> breaks = curve.breaks();
      for (std::size_t i = 1; i < breaks.size(); ++i) {
        for (int k = 0; k <= kPlaces; ++k)
          box.take(curve.point(breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / kPlaces));
      }
    }
  }
  return box;
}

void move(ImportedFile& file, const Vec2& by) {
  for (ImportedLine& line : file.lines) {
    for (Vec2& p : line.points) p += by;
    for (NurbsCurve& curve : line.curves) curve = curve.mapped(Eigen::Matrix2d::Identity(), by);
  }
}

}  // namespace

Recipe drawingOf(ImportedFile file) {
  constexpr double kLongerSidePx = 2000.0, kMargin = 0.05;  // of the longer side, around it
  constexpr double kLeastDpi = 1.0, kMostDpi = 100000.0;    // of a recipe
  constexpr int kLeastSide = 16;
  const Box box = boxOf(file);
  const double longer = box.size().maxCoeff(), margin = kMargin * longer;
  const double dpi = std::clamp(kMillimetresPerInch * kLongerSidePx / (longer + 2.0 * margin), kLeastDpi, kMostDpi);
  const double mmPerPx = kMillimetresPerInch / dpi;
  const auto side = [&](double mm) {
    return std::max(kLeastSide, static_cast<int>(std::ceil((mm + 2.0 * margin) / mmPerPx)));
  };
  Recipe recipe;
  recipe.dpi = dpi;
  BlankPage page{side(box.size().x()), side(box.size().y())};
  const Vec2 middle = 0.5 * (box.low + box.high);
  page.leftMm = middle.x() - 0.5 * page.widthPx * mmPerPx;
  page.bottomMm = middle.y() - 0.5 * page.heightPx * mmPerPx;
  recipe.page = page;
  recipe.imports.push_back(std::move(file));
  return recipe;
}

AddedImport withImport(Recipe recipe, ImportedFile file, const PageFrame& frame) {
  const Box box = boxOf(file);
  const Vec2 low = frame.pointToModel({0.0, static_cast<double>(frame.heightPx)});
  const Vec2 high = frame.pointToModel({static_cast<double>(frame.widthPx), 0.0});
  const bool isOutside = (box.low.array() > high.array()).any() || (box.high.array() < low.array()).any();
  if (isOutside) move(file, 0.5 * (low + high) - 0.5 * (box.low + box.high));
  recipe.imports.push_back(std::move(file));
  return {std::move(recipe), isOutside};
}

}  // namespace batten
