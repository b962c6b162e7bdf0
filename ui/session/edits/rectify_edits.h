// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/image/rectification.h"

namespace batten {

class EditorSession;

/// The corners of the sheet as places of the page that is shown: of a rectified page its own corners, of a picture
/// those that were found on it. Absent: none were.
std::optional<SheetCorners> knownSheetCorners(const EditorSession&);
/// The same or, where none are known, a rectangle to begin with.
SheetCorners shownSheetCorners(const EditorSession&);
/// Rectifies the page by the sheet with these corners, places of the page that is shown, as an undoable step. All marks
/// and choices stay on their ink. A rectangle without an edge of paper is no sheet: nothing of it is cut off.
/// @return BadParameter for corners that are none of a sheet.
Result<void> rectifyBy(EditorSession&, const SheetCorners& cornersPx);
/// The rectified page is a sheet of this format, as an undoable step; nothing while the page is not rectified.
Result<void> setSheetFormat(EditorSession&, PaperFormat);
/// Back to the picture as it was taken, as an undoable step; nothing while the sheet is still being looked for.
void stopRectifying(EditorSession&);

}  // namespace batten
