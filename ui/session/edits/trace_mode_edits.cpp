// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/trace_mode_edits.h"

#include <QCoreApplication>
#include <algorithm>
#include <utility>

#include "core/contour/ink/painted_ink.h"

namespace batten {

namespace {

/// Where the choice about a line's ink is attached, or would be.
Vec2 placeOf(const Contour& line) { return line.traceMode ? line.traceMode->positionPx : placeOnInk(line); }

}  // namespace

const Contour* tracedLineOf(const EditorSession& session, std::optional<int> curve) {
  const TracedCurve* of = session.curveAt(curve);
  const auto& set = session.output().contours;
  // New lines come before their curves.
  if (!set || session.isStale(StageId::Contours) != session.isStale(StageId::Faired)) return nullptr;
  if (!of) return nullptr;
  const int contour = of->contour;
  if (contour < 0 || contour >= std::ssize(set->contours)) return nullptr;
  const Contour& line = set->contours[contour];
  return isDrawn(line.kind) || line.points.empty() ? nullptr : &line;
}

EdgeMode traceModeOf(const EditorSession& session, std::optional<int> curve) {
  const Contour* line = tracedLineOf(session, curve);
  if (!line) return EdgeMode::Automatic;
  // The recipe's, which the shown line may not follow yet.
  const auto& choices = session.recipe().edges.choices;
  const auto last = std::find_if(choices.rbegin(), choices.rend(),
                                 [place = placeOf(*line)](const EdgeChoice& c) { return c.positionPx == place; });
  return last == choices.rend() ? EdgeMode::Automatic : last->mode;
}

void chooseTraceMode(EditorSession& session, std::optional<int> curve, EdgeMode mode) {
  const Contour* line = tracedLineOf(session, curve);
  if (!line || traceModeOf(session, curve) == mode) return;
  Recipe after = session.recipe();
  const Vec2 place = placeOf(*line);
  std::erase_if(after.edges.choices, [&](const EdgeChoice& c) { return c.positionPx == place; });
  if (mode != EdgeMode::Automatic) after.edges.choices.push_back({place, mode});
  session.selectNear(place);
  session.change(mode == EdgeMode::Automatic ? QCoreApplication::translate("TraceModeEdits", "Trace line as the page")
                 : mode == EdgeMode::Outline ? QCoreApplication::translate("TraceModeEdits", "Trace outline of line")
                                             : QCoreApplication::translate("TraceModeEdits", "Trace centre of line"),
                 std::move(after));
}

bool paintTraceMode(EditorSession& session, PaintedInk painted) {
  if (validate(painted)) return false;
  Recipe after = session.recipe();
  const auto forgotten =
      std::erase_if(after.edges.choices, [&](const EdgeChoice& c) { return isUnder(painted, c.positionPx); });
  const EdgeMode mode = painted.mode;
  if (mode != EdgeMode::Automatic || !after.edges.painted.empty())
    after.edges.painted.push_back(std::move(painted));
  else if (forgotten == 0)
    return false;
  session.change(mode == EdgeMode::Automatic ? QCoreApplication::translate("TraceModeEdits", "Paint as the page")
                 : mode == EdgeMode::Outline ? QCoreApplication::translate("TraceModeEdits", "Paint outline")
                                             : QCoreApplication::translate("TraceModeEdits", "Paint centre line"),
                 std::move(after));
  return true;
}

void forgetPainted(EditorSession& session) {
  Recipe after = session.recipe();
  after.edges.painted.clear();
  session.change(QCoreApplication::translate("TraceModeEdits", "Forget what was painted"), std::move(after));
}

}  // namespace batten
