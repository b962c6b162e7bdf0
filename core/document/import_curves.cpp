// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/import_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"

namespace batten {
namespace {

/// Of the curves themselves: control points may lie far outside.
Eigen::AlignedBox2d boxOf(const ImportedFile& file) {
  constexpr int kPlaces = 32;  // of a span
  Eigen::AlignedBox2d box;
  for (const ImportedLine& line : file.lines) {
    for (const Vec2& p : line.points) box.extend(p);
    for (const NurbsCurve& curve : line.curves) {
      const std::vector<double> breaks = curve.breaks();
      for (std::size_t i = 1; i < breaks.size(); ++i) {
        for (int k = 0; k <= kPlaces; ++k)
          box.extend(curve.point(breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / kPlaces));
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
  Eigen::AlignedBox2d box = boxOf(file);
  if (box.isEmpty()) box.extend(Vec2(0.0, 0.0));
  const double longer = box.sizes().maxCoeff(), margin = kMargin * longer;
  const double dpi = std::clamp(kMillimetresPerInch * kLongerSidePx / (longer + 2.0 * margin), kLeastDpi, kMostDpi);
  const double mmPerPx = kMillimetresPerInch / dpi;
  const auto side = [&](double mm) {
    return std::max(kLeastSide, static_cast<int>(std::ceil((mm + 2.0 * margin) / mmPerPx)));
  };
  Recipe recipe;
  recipe.dpi = dpi;
  BlankPage page{side(box.sizes().x()), side(box.sizes().y())};
  const Vec2 middle = box.center();
  page.leftMm = middle.x() - 0.5 * page.widthPx * mmPerPx;
  page.bottomMm = middle.y() - 0.5 * page.heightPx * mmPerPx;
  recipe.page = page;
  recipe.imports.push_back(std::move(file));
  return recipe;
}

AddedImport withImport(Recipe recipe, ImportedFile file, const PageFrame& frame) {
  const Eigen::AlignedBox2d box = boxOf(file);
  const Vec2 low = frame.pointToModel({0.0, static_cast<double>(frame.heightPx)});
  const Vec2 high = frame.pointToModel({static_cast<double>(frame.widthPx), 0.0});
  const bool isOutside =
      !box.isEmpty() && ((box.min().array() > high.array()).any() || (box.max().array() < low.array()).any());
  if (isOutside) move(file, 0.5 * (low + high) - box.center());
  recipe.imports.push_back(std::move(file));
  return {std::move(recipe), isOutside};
}

}  // namespace batten
