// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/direction_edits.h"

#include <QCoreApplication>
#include <utility>

#include "core/pipeline/run/direction_owners.h"
#include "ui/session/curve_piece.h"

namespace batten {
namespace {

QString directionText(const char* text) { return QCoreApplication::translate("DirectionEdits", text); }

}  // namespace

std::vector<CurveCourse> curveCourses(const EditorSession& session) {
  std::vector<CurveCourse> courses;
  const PipelineOutput& output = session.output();
  if (!output.pieces || !output.contours) return courses;
  const DirectionOwners owners = assignDirections(*output.pieces, session.recipe());
  for (int i = 0; i < std::ssize(session.curves()); ++i) {
    CurveCourse& course = courses.emplace_back();
    const auto piece = pieceOf(session, i);
    if (!piece) continue;
    const auto& wanted = owners.ofPiece[*piece];
    course.isReversed = wanted && wanted->isReversed;
    const int contour = output.pieces->pieces[*piece].contour;
    if (contour < 0 || contour >= std::ssize(output.contours->contours)) continue;
    course.isOfClosedLine = output.contours->contours[contour].closed;
    const auto start = owners.startOfContour.find(contour);
    if (start != owners.startOfContour.end()) course.startPx = session.recipe().starts[start->second].positionPx;
  }
  return courses;
}

void reverseCurve(EditorSession& session, std::optional<int> curve) {
  const auto piece = pieceOf(session, curve);
  if (!piece) return;
  Recipe after = session.recipe();
  reverseDirection(after, *session.output().pieces, *piece);
  session.change(directionText("Reverse direction"), std::move(after));
}

void startCurveAt(EditorSession& session, int curve, const Vec2& px, GestureId gesture) {
  const auto piece = pieceOf(session, curve);
  if (!piece) return;
  Recipe after = session.recipe();
  setStart(after, *session.output().pieces, *piece, px);
  session.change(directionText("Move start"), std::move(after), gesture);
}

}  // namespace batten
