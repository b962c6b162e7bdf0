// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/pen_edits.h"

#include <algorithm>
#include <utility>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

QString penText(const char* text) { return QObject::tr(text); }

/// Index of the first pen stroke in the contours, when these belong to the present recipe.
std::optional<int> firstPenContour(const EditorSession& session) {
  const auto& contours = session.output().contours;
  if (!contours || session.isStale(StageId::Contours)) return std::nullopt;
  const auto first = static_cast<int>(std::ssize(contours->contours) - std::ssize(session.recipe().penStrokes));
  return first >= 0 ? std::optional(first) : std::nullopt;
}

}  // namespace

bool addStroke(EditorSession& session, PenStroke stroke) {
  if (validate(stroke)) return false;
  session.selectNear(stroke.points[stroke.points.size() / 2]);
  Recipe after = session.recipe();
  after.penStrokes.push_back(std::move(stroke));
  session.change(penText("Draw stroke"), std::move(after));
  return true;
}

void removeStroke(EditorSession& session, std::size_t stroke) {
  Recipe after = session.recipe();
  if (stroke >= after.penStrokes.size()) return;
  after.penStrokes.erase(after.penStrokes.begin() + static_cast<std::ptrdiff_t>(stroke));
  session.change(penText("Remove stroke"), std::move(after));
}

void removeAllStrokes(EditorSession& session) {
  Recipe after = session.recipe();
  after.penStrokes.clear();
  session.change(penText("Remove all strokes"), std::move(after));
}

std::optional<std::size_t> strokeOf(const EditorSession& session, std::optional<int> curve) {
  const auto first = firstPenContour(session);
  const TracedCurve* of = session.curveAt(curve);
  if (!first || session.isStale(StageId::Curves) || !of) return std::nullopt;
  if (of->contour < *first) return std::nullopt;
  return of->contour - *first;
}

std::optional<int> curveOfStroke(const EditorSession& session, std::size_t stroke) {
  const auto first = firstPenContour(session);
  if (!first) return std::nullopt;
  const auto curves = session.curves();
  for (int i = 0; i < std::ssize(curves); ++i)
    if (curves[i].contour == *first + static_cast<int>(stroke)) return i;
  return std::nullopt;
}

std::optional<std::size_t> strokeNear(const Recipe& recipe, const Vec2& px, double reachPx) {
  std::optional<std::size_t> found;
  double best = reachPx * reachPx;
  for (std::size_t s = 0; s < recipe.penStrokes.size(); ++s) {
    const auto& points = recipe.penStrokes[s].points;
    const std::size_t segments = recipe.penStrokes[s].closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      const double d = awayFromSegment(px, points[i], points[(i + 1) % points.size()]).squaredNorm();
      if (d <= best) best = d, found = s;
    }
  }
  return found;
}

}  // namespace batten
