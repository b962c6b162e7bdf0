// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of which strokes go on through a junction (EdgeParams::junctions). All are undoable.

/// The junctions of the page; none while there are no lines.
std::span<const StrokeJunction> junctionsOf(const EditorSession& session);
/// The pairs that the recipe asks for: the user's or, without any, the rule's own. The lines shown may not follow yet.
EndPairs askedPairs(const EditorSession& session, const StrokeJunction& junction);
/// Whether the user has paired the strokes of the junction.
bool isPairedByHand(const EditorSession& session, const StrokeJunction& junction);
/// Takes the next pairing of the strokes; behind the last one it is the rule again.
void pairNext(EditorSession& session, const StrokeJunction& junction);
/// Makes one stroke of two branches, which leave those that they went on with; two that are one come apart.
void pairBranches(EditorSession& session, const StrokeJunction& junction, int first, int second);
/// Leaves all junctions to the rule.
void forgetPairings(EditorSession& session);

}  // namespace batten
