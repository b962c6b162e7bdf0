// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of the lines drawn by hand (Recipe::penStrokes). All are undoable.

/// Adds a stroke and selects the curve it becomes. A stroke that is not valid (a single point) is left out: false.
bool addStroke(EditorSession& session, PenStroke stroke);
void removeStroke(EditorSession& session, std::size_t stroke);
void removeAllStrokes(EditorSession& session);
/// The stroke a curve was made of, or none when it was found on the scan or the strokes have changed since.
std::optional<std::size_t> strokeOf(const EditorSession& session, std::optional<int> curve);
/// The first curve of a stroke, or none.
std::optional<int> curveOfStroke(const EditorSession& session, std::size_t stroke);
/// The stroke within `reachPx` of a place, the nearest; none otherwise.
std::optional<std::size_t> strokeNear(const Recipe& recipe, const Vec2& px, double reachPx);

}  // namespace batten
