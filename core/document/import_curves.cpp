// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/import_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/exchange/point_file.h"
#include "core/pipeline/run/piece_numbers.h"

namespace batten {
namespace {

/// Of the curves themselves: control points may lie far outside.
Eigen::AlignedBox2d boxOf(const ImportedFile& file) {
  constexpr int kPlaces = 32;  // of a span
  Eigen::AlignedBox2d box;
  for (const ImportedLine& line : file.lines) {
    for (const Vec2& p : line.points) box.extend(p);
    for (const auto& [curve, name] : line.curves) {
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
    for (auto& [curve, name] : line.curves) curve = curve.mapped(Eigen::Matrix2d::Identity(), by);
  }
}

/// Points of a line, the last one not counted; behind the last point of a closed line comes its first.
struct PointRange {
  std::size_t first = 0, count = 0;
};

PointRange wholeOf(const ImportedLine& line) { return {0, line.points.size()}; }

/// The points between two corners of a line; absent if it has no such part.
std::optional<PointRange> rangeOf(const ImportedLine& line, std::size_t part) {
  if (line.points.empty()) return std::nullopt;
  if (line.corners.empty()) return part == 0 ? std::optional(wholeOf(line)) : std::nullopt;
  std::vector<int> begins;
  if (!line.closed) begins.push_back(0);
  for (const int corner : line.corners)
    if (begins.empty() || corner > begins.back()) begins.push_back(corner);
  if (part >= begins.size()) return std::nullopt;
  const std::size_t end =
      part + 1 < begins.size() ? begins[part + 1] : line.points.size() + (line.closed ? begins.front() : 0);
  const std::size_t first = begins[part];
  return PointRange{first, end - first};
}

Vec2 pointAlong(const ImportedLine& line, const PointRange& range, double along) {
  const std::size_t at = range.first + static_cast<int>(along * static_cast<double>(range.count));
  return line.points[at % line.points.size()];
}

/// The numbers in the names that Batten gave ("Curve 3"): such a curve is Curve 3 again. Of several of one name the
/// first is.
CurveNumbers numbersOf(const ImportedFile& file, std::span<const NamedPart> parts, const PageFrame& frame) {
  constexpr int kPlaces = 5;  // noted along a line
  CurveNumbers numbers;
  std::set<int> given;
  const auto add = [&](const std::string& name, const auto& placeAt) {
    const auto number = numberOfCurveName(name);
    if (!number || !given.insert(*number).second) return;
    NumberedCurve& one = numbers.curves.emplace_back(NumberedCurve{*number});
    for (int k = 0; k < kPlaces; ++k) one.placesPx.push_back(frame.pointToImage(placeAt((k + 0.5) / kPlaces)));
  };
  for (const ImportedLine& line : file.lines) {
    for (const auto& named : line.curves) {
      const NurbsCurve& curve = named.curve;
      add(named.name, [&](double part) { return curve.point(curve.start() + part * (curve.end() - curve.start())); });
    }
    if (!line.points.empty()) add(line.name, [&](double along) { return pointAlong(line, wholeOf(line), along); });
  }
  for (const NamedPart& part : parts) {
    if (part.line >= file.lines.size()) continue;
    const ImportedLine& line = file.lines[part.line];
    if (const auto range = rangeOf(line, part.part))
      add(part.name, [&](double along) { return pointAlong(line, *range, along); });
  }
  std::sort(numbers.curves.begin(), numbers.curves.end(),
            [](const NumberedCurve& a, const NumberedCurve& b) { return a.number < b.number; });
  if (!given.empty()) numbers.lastGiven = *given.rbegin();
  return numbers;
}

}  // namespace

Recipe drawingOf(ImportedFile file, std::span<const NamedPart> parts) {
  constexpr double kLongerSidePx = 2000.0, kMargin = 0.05;  // of the longer side, around it
  constexpr double kLeastDpi = 1.0, kMostDpi = 100000.0;    // of a recipe
  constexpr int kLeastSide = 16;                            // px
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
  recipe.curveNumbers = numbersOf(file, parts, {page.widthPx, page.heightPx, mmPerPx, page.leftMm, page.bottomMm});
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

std::optional<double> millimetresOfImport(const ImportedFile& file) {
  constexpr double kPxPerInchOfSvg = 96.0;          // of CSS
  constexpr std::string_view kMillimetres = " mm";  // end of a unit that is a number
  std::string_view unit = file.unit;
  if (unit.ends_with('?')) unit.remove_suffix(1);
  if (unit == "px") return kMillimetresPerInch / kPxPerInchOfSvg;
  if (unit == "ft") return 12.0 * kMillimetresPerInch;
  if (const auto known = millimetresOfUnit(unit)) return known;
  if (!unit.ends_with(kMillimetres)) return std::nullopt;
  unit.remove_suffix(kMillimetres.size());
  const auto count = numberFromText(unit);
  return count && *count > 0.0 ? std::optional(*count) : std::nullopt;
}

Result<Recipe> withImportUnit(Recipe recipe, std::size_t import, const std::string& unit, const PageFrame& frame) {
  ImportedFile file = recipe.imports.at(import);
  const auto before = millimetresOfImport(file), now = millimetresOfUnit(unit);
  if (!before || !now) return fail(ErrorCode::BadParameter, "Unknown unit: " + unit + ". Use mm, cm, m or in.");
  const double factor = *now / *before;
  file.unit = unit;
  const Eigen::Matrix2d linear = factor * Eigen::Matrix2d::Identity();
  for (ImportedLine& line : file.lines) {
    for (Vec2& p : line.points) p *= factor;
    for (auto& [curve, name] : line.curves) curve = curve.mapped(linear, Vec2::Zero());
  }
  if (auto wrong = validate(file)) return fail(std::move(*wrong));
  if (recipe.page && recipe.dpi && recipe.imports.size() == 1 && recipe.penStrokes.empty()) {
    recipe.imports.front() = std::move(file);
    recipe.scaleLine.reset();
    *recipe.dpi /= factor;
    recipe.page->leftMm *= factor;
    recipe.page->bottomMm *= factor;
  } else {
    const auto at = recipe.imports.begin() + static_cast<std::ptrdiff_t>(import);
    recipe.imports.erase(at);
    recipe = withImport(std::move(recipe), std::move(file), frame).recipe;
    std::rotate(recipe.imports.begin() + static_cast<std::ptrdiff_t>(import), recipe.imports.end() - 1,
                recipe.imports.end());
  }
  if (auto wrong = validate(recipe)) return fail(std::move(*wrong));
  return recipe;
}

}  // namespace batten
