// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "ui/session/editor_session.h"
#include "ui/session/view/judged_curve.h"

namespace batten {

/// A curvature extremum as canvas and plot show it.
struct ExtremumMark {
  /// Index into the curve's ConstructReport::extrema; none: not judged, a click changes nothing.
  std::optional<int> note;
  Vec2 px = Vec2::Zero();
  double s = 0.0;      ///< [mm] along the judged curve.
  double kappa = 0.0;  ///< [1/mm]
  bool isKept = true;
  bool isCertain = true;             ///< Far beyond what noise can make.
  std::optional<bool> wantedToKeep;  ///< The user's own choice.
  QString text;                      ///< What it is, how certain, and what a click does.
};

/// The extrema of one of session.curves(). Of the sketched curve: those that the fair fit found, with its judgement;
/// of other methods, and of the result where fairing changed it: the curve's own, as many as its figures count.
std::vector<ExtremumMark> extremumMarks(const EditorSession& session, std::optional<int> curve,
                                        Judged judged = Judged::Sketched);

/// A click on a mark: keeps a dropped extremum, takes a kept one out; where the user has chosen already, the program
/// decides again. Undoable.
void toggleExtremum(EditorSession& session, std::optional<int> curve, int note);

}  // namespace batten
