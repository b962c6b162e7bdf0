// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/imported_line.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/curve/import_limits.h"

namespace batten {
namespace {

constexpr double kFarthestMm = 1e5;          // 100 m: no drawing is larger
constexpr std::size_t kMostLines = 20000;    // of a file: bounds what a foreign one may take of time and memory
constexpr std::size_t kMostPoints = 500000;  // of all lines, as well
/// Of the size of a line: curves that are farther apart do not follow each other.
constexpr double kSamePlace = 1e-6;

std::optional<Error> bad(const std::string& message) { return Error{ErrorCode::BadParameter, message, {}}; }

bool isNear(const Vec2& p) { return std::abs(p.x()) <= kFarthestMm && std::abs(p.y()) <= kFarthestMm; }

double sizeOf(const ImportedLine& line) {
  Vec2 low = Vec2::Constant(kFarthestMm), high = Vec2::Constant(-kFarthestMm);
  const auto take = [&](const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); };
  for (const auto& [curve, name] : line.curves)
    std::for_each(curve.controlPoints().begin(), curve.controlPoints().end(), take);
  std::for_each(line.points.begin(), line.points.end(), take);
  return (high - low).maxCoeff();
}

bool followEachOther(const ImportedLine& line, double size) {
  const auto meet = [&](const NurbsCurve& before, const NurbsCurve& behind) {
    return (before.point(before.end()) - behind.point(behind.start())).norm() <= kSamePlace * size;
  };
  for (std::size_t i = 1; i < line.curves.size(); ++i) {
    if (!meet(line.curves[i - 1].curve, line.curves[i].curve)) return false;
  }
  return !line.closed || meet(line.curves.back().curve, line.curves.front().curve);
}

std::optional<Error> validateLine(const ImportedLine& line) {
  for (const auto& [curve, name] : line.curves) {
    if (curve.isEmpty()) return bad("An imported curve is empty.");
    if (!std::all_of(curve.controlPoints().begin(), curve.controlPoints().end(), isNear))
      return bad("An imported curve lies farther than 100 m from the origin. Is its unit right?");
  }
  if (!std::all_of(line.points.begin(), line.points.end(), isNear))
    return bad("An imported point lies farther than 100 m from the origin. Is its unit right?");
  const double size = line.curves.empty() && line.points.empty() ? 0.0 : sizeOf(line);
  if (!(size > 0.0)) return bad("An imported line has no length.");
  if (!line.curves.empty()) {
    if (!line.points.empty()) return bad("An imported line has both curves and points.");
    if (!followEachOther(line, size)) return bad("The curves of an imported line do not join end to end.");
    return std::nullopt;
  }
  if (std::ssize(line.points) < (line.closed ? 3 : 2)) return bad("An imported line needs at least two points.");
  int least = 0;  // of the next corner: they ascend
  for (const int corner : line.corners) {
    if (corner < least || corner >= std::ssize(line.points))
      return bad("A corner of an imported line is not one of its points.");
    least = corner + 1;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> validate(const ImportedFile& file) {
  if (file.lines.size() > kMostLines) return bad("At most 20000 lines can be imported from a file.");
  std::size_t points = 0, corners = 0;
  for (const ImportedLine& line : file.lines) {
    points += line.points.size();
    corners += line.corners.size();
    for (const auto& [curve, name] : line.curves) points += curve.isEmpty() ? 0 : curve.controlPointCount();
  }
  if (points > kMostPoints) return bad("At most 500000 points can be imported from a file.");
  if (auto wrong = tooManySharpTurns(corners)) return wrong;
  for (const ImportedLine& line : file.lines) {
    if (auto wrong = validateLine(line)) return wrong;
  }
  return std::nullopt;
}

}  // namespace batten
