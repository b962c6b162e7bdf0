// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/editor_session.h"

namespace batten {

/// A curve before and after fairing, in figures; of the target that it follows too, once that is computed.
std::vector<FigureTable::Row> fairingRows(const EditorSession& session, const TracedCurve& curve);
/// The same while no curve is selected.
std::vector<FigureTable::Row> noFairingRows(const EditorSession& session);

/// What is to be said of a curve's fairing.
struct FairingNote {
  QString text;                    ///< Empty: nothing.
  std::optional<double> neededMm;  ///< A tolerance that should reach the target, where it is worth trying.
};
FairingNote fairingNote(const TracedCurve& curve);

}  // namespace batten
