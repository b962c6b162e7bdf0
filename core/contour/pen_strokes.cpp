// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/pen_strokes.h"

#include <algorithm>
#include <cmath>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr std::size_t kMostPoints = 100000;
/// [px] Distance of the points in between; longer strokes take wider steps, so that a page never becomes too much.
constexpr double kStepPx = 1.0;
constexpr double kMostSteps = 200000.0;

std::vector<Vec2> distinct(const PenStroke& stroke) {
  std::vector<Vec2> points;
  for (const Vec2& p : stroke.points) {
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  while (stroke.closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

}  // namespace

std::optional<Error> validate(const PenStroke& stroke) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (stroke.points.size() > kMostPoints) return bad("A pen stroke may hold at most 100000 points.");
  for (const Vec2& p : stroke.points) {
    if (!p.allFinite()) return bad("A point of a pen stroke has no valid position.");
  }
  const std::size_t places = distinct(stroke).size();
  if (places < 2) return bad("A pen stroke needs at least two points at different places.");
  if (stroke.closed && places < 3) return bad("A closed pen stroke needs at least three points at different places.");
  return std::nullopt;
}

Contour penContour(const PenStroke& stroke) {
  const std::vector<Vec2> drawn = distinct(stroke);
  Contour contour;
  contour.kind = ContourKind::Pen;
  contour.closed = stroke.closed;
  contour.lengthPx = polylineLength(drawn, stroke.closed);
  if (stroke.closed) contour.areaPx = polygonArea(drawn);
  const double step = std::max(kStepPx, contour.lengthPx / kMostSteps);
  const std::size_t legs = stroke.closed ? drawn.size() : drawn.size() - 1;
  const auto add = [&](const Vec2& at, bool isDrawn) {
    contour.points.push_back({.at = at, .unrefined = at, .refined = isDrawn});
  };
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    add(drawn[i], true);
    if (i >= legs) break;
    const Vec2& next = drawn[(i + 1) % drawn.size()];
    const int parts = static_cast<int>(std::ceil((next - drawn[i]).norm() / step));
    for (int k = 1; k < parts; ++k) {
      add(drawn[i] + (next - drawn[i]) * (static_cast<double>(k) / parts), false);
    }
  }
  return contour;
}

ContourSet withPenStrokes(const ContourSet& set, std::span<const PenStroke> strokes) {
  ContourSet result = set;
  for (const PenStroke& stroke : strokes) result.contours.push_back(penContour(stroke));
  return result;
}

}  // namespace batten
