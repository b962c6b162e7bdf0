// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// How a curve of the session is exported.
struct CurveCourse {
  bool isReversed = false;      ///< Reversed relative to the traced direction.
  bool isOfClosedLine = false;  ///< It has a start that can be moved.
  std::optional<Vec2> startPx;  ///< Where its closed line was asked to begin.
};
/// The courses of all curves, in their order. Empty while there are no outputs.
std::vector<CurveCourse> curveCourses(const EditorSession&);

/// Exports a curve the other way round, as an undoable step; none: nothing happens.
void reverseCurve(EditorSession&, std::optional<int> curve);
/// Begins the closed line of a curve at a place. Changes with one gesture are one step.
void startCurveAt(EditorSession&, int curve, const Vec2& px, GestureId gesture);

}  // namespace batten
