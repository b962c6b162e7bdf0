// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/way_edits.h"

#include <QCoreApplication>
#include <algorithm>

namespace batten {

const Contour* tracedLineOf(const EditorSession& session, int curve) {
  const auto curves = session.curves();
  const auto& set = session.output().contours;
  if (!set || curve < 0 || static_cast<std::size_t>(curve) >= curves.size()) return nullptr;
  const int contour = curves[static_cast<std::size_t>(curve)].contour;
  if (contour < 0 || static_cast<std::size_t>(contour) >= set->contours.size()) return nullptr;
  const Contour& line = set->contours[static_cast<std::size_t>(contour)];
  return line.kind == ContourKind::Pen || line.chain.empty() ? nullptr : &line;
}

EdgeMode wayOf(const EditorSession& session, int curve) {
  const Contour* line = tracedLineOf(session, curve);
  if (!line || !line->way) return EdgeMode::Automatic;
  const auto& choices = session.recipe().edges.choices;
  const bool isThere = std::find(choices.begin(), choices.end(), *line->way) != choices.end();
  return isThere ? line->way->mode : EdgeMode::Automatic;
}

void chooseWay(EditorSession& session, int curve, EdgeMode mode) {
  const Contour* line = tracedLineOf(session, curve);
  if (!line || wayOf(session, curve) == mode) return;
  Recipe after = session.recipe();
  // The unrefined places lie on the ink or on its border, whatever the line's way.
  const Vec2 place = line->way ? line->way->positionPx : line->chain[line->chain.size() / 2];
  if (line->way) std::erase(after.edges.choices, *line->way);
  if (mode != EdgeMode::Automatic) after.edges.choices.push_back({place, mode});
  session.selectNear(place);
  session.change(mode == EdgeMode::Automatic ? QCoreApplication::translate("WayEdits", "Follow line as the page")
                 : mode == EdgeMode::Outline ? QCoreApplication::translate("WayEdits", "Follow outline of line")
                                             : QCoreApplication::translate("WayEdits", "Follow centre of line"),
                 std::move(after));
}

}  // namespace batten
