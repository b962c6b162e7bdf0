// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

class EditorSession;

/// Traces the whole page again, as an undoable step; nothing while there are no regions.
void clearRegions(EditorSession&);

}  // namespace batten
