// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/pen_edits.h"

#include <algorithm>
#include <utility>

namespace batten {
namespace {

QString penText(const char* text) { return QObject::tr(text); }

/// Index of the first pen stroke in the contours, when these belong to the present recipe.
std::optional<std::size_t> firstPenContour(const EditorSession& session) {
  const auto& contours = session.output().contours;
  const std::size_t strokes = session.recipe().penStrokes.size();
  if (!contours || session.isStale(StageId::Contours) || contours->contours.size() < strokes) return std::nullopt;
  return contours->contours.size() - strokes;
}

double squaredToLeg(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 leg = b - a;
  const double square = leg.squaredNorm();
  const double f = square > 0.0 ? std::clamp((p - a).dot(leg) / square, 0.0, 1.0) : 0.0;
  return (p - a - f * leg).squaredNorm();
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
  const auto contour = static_cast<std::size_t>(of->contour);
  if (contour < *first) return std::nullopt;
  return contour - *first;
}

std::optional<int> curveOfStroke(const EditorSession& session, std::size_t stroke) {
  const auto first = firstPenContour(session);
  if (!first) return std::nullopt;
  const auto curves = session.curves();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].contour >= 0 && static_cast<std::size_t>(curves[i].contour) == *first + stroke) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> strokeNear(const Recipe& recipe, const Vec2& px, double reachPx) {
  std::optional<std::size_t> found;
  double best = reachPx * reachPx;
  for (std::size_t s = 0; s < recipe.penStrokes.size(); ++s) {
    const auto& points = recipe.penStrokes[s].points;
    const std::size_t legs = recipe.penStrokes[s].closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < legs; ++i) {
      const double d = squaredToLeg(px, points[i], points[(i + 1) % points.size()]);
      if (d <= best) best = d, found = s;
    }
  }
  return found;
}

}  // namespace batten
