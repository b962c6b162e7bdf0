// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "ui/session/editor_session.h"

namespace batten {

/// A curvature extremum of the true and fair fit as canvas and plot show it.
struct ExtremumMark {
  int note = 0;  ///< Index into the curve's ConstructReport::extrema.
  Vec2 px = Vec2::Zero();
  double s = 0.0;      ///< [mm] along the sketched curve.
  double kappa = 0.0;  ///< [1/mm]
  bool isKept = true;
  bool isCertain = true;             ///< Far beyond what noise can make.
  std::optional<bool> wantedToKeep;  ///< The user's own choice.
  QString text;                      ///< What it is, how certain, and what a click does.
};

/// The extrema of one of session.curves(); empty for other methods than the fair fit.
std::vector<ExtremumMark> extremumMarks(const EditorSession& session, int curve);

/// A click on a mark: keeps a dropped extremum, takes a kept one out; where the user has chosen already, the program
/// decides again. Undoable.
void toggleExtremum(EditorSession& session, int curve, int note);

}  // namespace batten
