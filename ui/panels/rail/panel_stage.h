// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <array>

#include "core/pipeline/recipe/stage_id.h"

namespace batten {

class EditorSession;

/// The stages as the window shows them, one inspector panel each.
enum class PanelStage { Scan, Threshold, CleanUp, Edges, Corners, Curves, Fairing, Export };
// in the order of the rail
inline constexpr std::array kPanelStages = {PanelStage::Scan,    PanelStage::Threshold, PanelStage::CleanUp,
                                            PanelStage::Edges,   PanelStage::Corners,   PanelStage::Curves,
                                            PanelStage::Fairing, PanelStage::Export};
/// Its place in arrays with one entry a panel.
constexpr std::size_t indexOf(PanelStage stage) { return static_cast<std::size_t>(stage); }
QString label(PanelStage);
/// One line: what to do here, with a drawing open or without, with a curve selected or without.
QString hint(PanelStage, bool isOpen, bool isCurveSelected);
/// "scan", "threshold", …: object names, help pages, settings.
QString key(PanelStage);

enum class StageState { Open, Done, Stale, Failed };
StageState stateOf(PanelStage, const EditorSession&);
/// What stands at the right in the rail: a count, a tick, or nothing.
QString tally(PanelStage, const EditorSession&);

}  // namespace batten
