// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of how the selected curve is faired that are made on its plots: all undoable, all kept by place on the drawing
/// or share of the length, never by number.

/// The fairing that the recipe asks for the selected curve, known before the run that follows it.
FairingParams fairingAsked(const EditorSession& session);

/// Shares of the length at which the selected curve's targets are split: those of the user, in the order of the
/// choice's list, or where its natural spans meet.
std::vector<double> splitsOf(const EditorSession& session);
/// Where natural spans are edited, they become splits of the user's first.
void addSplit(EditorSession& session, double fraction);
/// Moves a split of the list of splitsOf.
void moveSplit(EditorSession& session, int index, double fraction, GestureId gesture);
/// Joins the spans on both sides of a split of the list of splitsOf.
void joinAtSplit(EditorSession& session, int index);
/// One polynomial for the whole curve.
void joinAllSpans(EditorSession& session);
/// Back to the natural spans.
void splitNaturally(EditorSession& session);
/// True where the curve has its natural spans.
bool hasNaturalSpans(const EditorSession& session);

/// The span in which a place on the page lies becomes the one to which the targets belong; if it is, the whole curve.
void pointAtSpanNear(EditorSession& session, const Vec2& px);
/// The target of the span that is pointed at. The rest of the curve stays, but for spans with a target of their own.
void chooseSpanTarget(EditorSession& session, int degree);
/// The target that the span that is pointed at has now, none while it has none of its own.
std::optional<int> chosenSpanTarget(const EditorSession& session);

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
void drawTarget(EditorSession& session, std::vector<ProfilePoint> profile, GestureId gesture = {});
/// Back to the recommended target; the drawn one is forgotten.
void forgetDrawnTarget(EditorSession& session);

}  // namespace batten
