// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/image/colour/inks.h"

namespace batten {

class EditorSession;

/// "Red", "Black and grey".
QString inkName(const InkColour&);

/// Edits of which inks are traced (InkChoice). All are undoable.

/// Leaves an ink out, or traces it again.
void setInkDropped(EditorSession&, const InkColour&, bool isDropped);
/// Traces this ink alone or, where it is so already, all of them.
void keepOnlyInk(EditorSession&, const InkColour&);
/// Whether this is the only ink that is traced.
bool isOnlyInk(const EditorSession&, const InkColour&);

}  // namespace batten
