// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of how the selected curve is faired that are made on its plots: all undoable, all kept by place on the drawing
/// or share of the length, never by number.

/// The fairing that the recipe asks for the selected curve, known before the run that follows it.
FairingParams fairingAsked(const EditorSession& session);

/// Shares of the length at which the selected curve's targets are split, in the order of the choice's list.
std::vector<double> splitsOf(const EditorSession& session);
void addSplit(EditorSession& session, double fraction);
/// Moves or removes the split that lies nearest to a share of the length.
void moveSplit(EditorSession& session, int index, double fraction, int gesture);
void removeSplit(EditorSession& session, int index);
void removeSplits(EditorSession& session);
/// Inflections of the selected sketched curve as shares of its length.
std::vector<double> inflectionsOf(const EditorSession& session);
void splitAtInflections(EditorSession& session);
/// True where splitting would help: a target that needs more than the tolerance on a curve with inflections and no
/// splits.
bool isSplitOffered(const EditorSession& session);

/// Monotone: places of the extrema that the user chose to keep, as shares of the length. Empty: by number.
std::vector<double> keptOf(const EditorSession& session);
/// Keeps the extremum nearest to a share of the length, beside those chosen already.
void keepExtremum(EditorSession& session, double fraction);
void keepByNumber(EditorSession& session);

/// True when the selected curve follows a drawn target.
bool isTargetDrawn(const EditorSession& session);
/// A drawn profile to begin with: points on the target that the curve follows now, or on the sketch's smoothed
/// curvature.
std::vector<ProfilePoint> profileToBeginWith(const EditorSession& session);
/// The selected curve follows this profile from now on.
void drawTarget(EditorSession& session, std::vector<ProfilePoint> profile, int gesture);
/// Back to the recommended target; the drawn one is forgotten.
void forgetDrawnTarget(EditorSession& session);

}  // namespace batten
