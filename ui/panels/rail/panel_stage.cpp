// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/rail/panel_stage.h"

#include <QCoreApplication>
#include <optional>

#include "ui/session/editor_session.h"

namespace batten {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("PanelStage", text); }

/// The last pipeline stage that a panel's result needs.
std::optional<StageId> pipelineStage(PanelStage stage) {
  switch (stage) {
    case PanelStage::Scan:
      return std::nullopt;
    case PanelStage::Threshold:
      return StageId::Binary;
    case PanelStage::CleanUp:
      return StageId::Filtered;
    case PanelStage::Edges:
      return StageId::Contours;
    case PanelStage::Corners:
      return StageId::Pieces;
    case PanelStage::Curves:
      return StageId::Curves;
    case PanelStage::Fairing:
    case PanelStage::Export:
      return StageId::Faired;
  }
  return std::nullopt;
}

bool hasOutput(StageId stage, const PipelineOutput& out) {
  switch (stage) {
    case StageId::Binary:
      return out.binary != nullptr;
    case StageId::Filtered:
      return out.filtered != nullptr;
    case StageId::Contours:
      return out.contours != nullptr;
    case StageId::Pieces:
      return out.pieces != nullptr;
    case StageId::Curves:
      return out.constructed != nullptr;
    case StageId::Faired:
      return out.faired != nullptr;
    default:
      return false;
  }
}

/// The first panel whose part of the pipeline contains a stage.
PanelStage panelOf(StageId stage) {
  for (const PanelStage panel : kPanelStages)
    if (const auto last = pipelineStage(panel); last && static_cast<int>(stage) <= static_cast<int>(*last))
      return panel;
  return PanelStage::Fairing;
}

}  // namespace

QString label(PanelStage stage) {
  switch (stage) {
    case PanelStage::Scan:
      return tr("Scan");
    case PanelStage::Threshold:
      return tr("Threshold");
    case PanelStage::CleanUp:
      return tr("Clean-up");
    case PanelStage::Edges:
      return tr("Edges");
    case PanelStage::Corners:
      return tr("Corners");
    case PanelStage::Curves:
      return tr("Curves");
    case PanelStage::Fairing:
      return tr("Fairing");
    case PanelStage::Export:
      return tr("Export");
  }
  return {};
}

QString hint(PanelStage stage, bool isOpen, bool isCurveSelected) {
  switch (stage) {
    case PanelStage::Scan:
      return isOpen ? tr("Check the resolution: all lengths in mm depend on it. Then continue with the threshold.")
                    : tr("Drop a drawing on the window to open it.");
    case PanelStage::Threshold:
      return tr("Click a region, then turn the wheel or drag to change its threshold.");
    case PanelStage::CleanUp:
      return tr("Watch the ink while you move the coefficient.");
    case PanelStage::Edges:
      return tr("Lines follow the middle of strokes and the border of shapes.");
    case PanelStage::Corners:
      return tr("Click a line to mark a corner; click a corner to select it, again to remove it.");
    case PanelStage::Curves:
      return isCurveSelected
                 ? tr("Hover over the comb or the plot to read the curvature; choose a method at the right.")
                 : tr("Click a curve to show its measurements.");
    case PanelStage::Fairing:
      return tr("Choose a mode, or hover a target below the drawing to see its curve.");
    case PanelStage::Export:
      return tr(
          "Choose the receiving program, then export. F shows and reverses directions; L excludes "
          "lines.");
  }
  return {};
}

QString key(PanelStage stage) {
  // names of help pages and widgets, in the order of the stages
  static constexpr std::array kKeys = {"scan",    "threshold", "clean-up", "edges",
                                       "corners", "curves",    "fairing",  "export"};
  return QString::fromLatin1(kKeys[indexOf(stage)]);
}

StageState stateOf(PanelStage panel, const EditorSession& session) {
  if (!session.hasScan()) return StageState::Open;
  if (panel == PanelStage::Scan) return StageState::Done;
  const PipelineOutput& out = session.output();
  // An empty page has not failed, it has not begun.
  if (session.isBlankPage() && session.recipe().penStrokes.empty() && session.recipe().imports.empty())
    return StageState::Open;
  if (out.failedStage && panelOf(*out.failedStage) == panel) return StageState::Failed;
  const StageId stage = *pipelineStage(panel);
  if (panel == PanelStage::Export || !hasOutput(stage, out)) return StageState::Open;
  return session.isStale(stage) ? StageState::Stale : StageState::Done;
}

QString tally(PanelStage panel, const EditorSession& session) {
  const StageState state = stateOf(panel, session);
  if (state == StageState::Open || state == StageState::Failed) return {};
  if (panel == PanelStage::Corners) {
    const auto count = session.output().pieces ? session.output().pieces->corners.size() : 0;
    return count > 0 ? QString::number(count) : QStringLiteral("–");
  }
  if (panel == PanelStage::Curves) {
    return QString::number(session.curves().size());
  }
  return panel == PanelStage::Fairing ? QString() : QStringLiteral("✓");
}

}  // namespace batten
