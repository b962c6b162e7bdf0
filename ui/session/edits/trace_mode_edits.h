// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of how single lines of the scan are followed (EdgeParams::choices). All are undoable.

/// The line of the scan that a curve was made of; null for lines drawn by hand, and while there is none.
const Contour* tracedLineOf(const EditorSession& session, std::optional<int> curve);
/// Trace mode of a curve's ink; Automatic = as the page.
EdgeMode traceModeOf(const EditorSession& session, std::optional<int> curve);
/// Sets the trace mode of a curve's ink, overriding the page; Automatic removes the choice.
void chooseTraceMode(EditorSession& session, std::optional<int> curve, EdgeMode mode);
/// Paints the trace mode of ink; Automatic is the page's again. Choices made by a click on it before are forgotten.
/// @return false, and nothing happens, where the course is no valid one.
bool paintTraceMode(EditorSession& session, PaintedInk painted);
/// Nothing is painted any more.
void forgetPainted(EditorSession& session);

}  // namespace batten
