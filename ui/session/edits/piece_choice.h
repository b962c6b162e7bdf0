// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// Edits of the choices that belong to single curves (Recipe::choices).

/// The own choice of a curve, or null when it follows the recipe.
const PieceChoice* choiceOf(const EditorSession& session, std::optional<int> curve);
/// The same as the curve has it: brought to its direction (see alongPiece); none when it follows the recipe.
std::optional<PieceChoice> choiceAlong(const EditorSession& session, std::optional<int> curve);
/// True when the curve has a fairing choice of its own.
bool hasOwnFairing(const EditorSession& session, std::optional<int> curve);
/// The recipe with the curve's own choice edited; one is added where there was none, or where the curve shares one with
/// other parts of its line. Without a curve it stays as it is.
Recipe withChoice(const EditorSession& session, std::optional<int> curve,
                  const std::function<void(PieceChoice&)>& edit);

/// Chooses a target: for the span that is pointed at, else for the selected curve alone when the drawing has several,
/// else for all.
void chooseTarget(EditorSession& session, FairingTarget target);
/// Whether chooseTarget would act on the selected curve alone.
bool choosesForOneCurve(const EditorSession& session);
/// Leaves a curve out of fairing and export, or takes it in again.
void setIncluded(EditorSession& session, int curve, bool included);

/// Takes the choices that find no line now out of the recipe.
void forgetWaitingChoices(EditorSession& session);

}  // namespace batten
