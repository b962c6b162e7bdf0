// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commands/action_catalog.h"

#include <QAction>
#include <QCoreApplication>
#include <algorithm>
#include <cassert>
#include <vector>

#include "core/fairing/profile/target_degrees.h"

namespace batten {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("ActionCatalog", text); }

QList<QKeySequence> keys(std::initializer_list<const char*> list) {
  QList<QKeySequence> sequences;
  for (const char* text : list) sequences.append(QKeySequence(QString::fromLatin1(text), QKeySequence::PortableText));
  return sequences;
}

std::vector<ActionInfo> fileActions() {
  using enum ActionId;
  const auto menu = ActionMenu::File;
  return {
      {NewDrawing, "new-drawing", menu, tr("New drawing…"), keys({"Ctrl+N"}),
       tr("Start an empty page and draw with the pen.")},
      {OpenScan, "open-scan", menu, tr("Open scan…"), keys({"Ctrl+O"}), tr("Open a scanned or photographed drawing.")},
      {ImportCurves, "import-curves", menu, tr("Import curves…"), keys({"Ctrl+Shift+I"}),
       tr("Import curves or points from another program: DXF, IGES, STEP, SVG, CSV, JSON.")},
      {PasteScan, "paste-scan", menu, tr("Paste scan"), keys({"Ctrl+V"}),
       tr("Open the picture on the clipboard as a scan.")},
      {OpenRecipe, "open-recipe", menu, tr("Open recipe…"), keys({"Ctrl+Shift+O"}),
       tr("Apply saved settings, corners and choices to this drawing, or open a saved pen drawing.")},
      {SaveRecipe, "save-recipe", menu, tr("Save recipe"), keys({"Ctrl+S"}),
       tr("Save all settings, corners and choices to the same file; asks for a name the first time.")},
      {SaveRecipeAs, "save-recipe-as", menu, tr("Save recipe as…"), keys({"Ctrl+Shift+S"}),
       tr("Save all settings, corners and choices under another name, for this program or batten-cli.")},
      {Export, "export", menu, tr("Export…"), keys({"Ctrl+E"}),
       tr("Write the curves to CAD, drawing programs, cutters or spreadsheets, in true size.")},
      {CopySvg, "copy-svg", menu, tr("Copy curves as SVG"), keys({"Ctrl+Shift+C"}),
       tr("Copy the curves to the clipboard for pasting into a drawing program.")},
      {Quit, "quit", menu, tr("Quit"), keys({"Ctrl+Q"}), tr("Close the program.")},
  };
}

std::vector<ActionInfo> editActions() {
  using enum ActionId;
  const auto menu = ActionMenu::Edit;
  return {
      {Undo, "undo", menu, tr("Undo"), keys({"Ctrl+Z"}), tr("Undo the last change.")},
      {Redo, "redo", menu, tr("Redo"), keys({"Ctrl+Shift+Z", "Ctrl+Y"}), tr("Redo the change that was undone.")},
      {CancelWork, "cancel", menu, tr("Stop"), keys({"Esc"}),
       tr("Stop the running computation; finished results are kept.")},
      {ComputeAgain, "compute-again", menu, tr("Compute again"), keys({"Ctrl+R"}),
       tr("Resume a computation that was stopped.")},
      {NextCurve, "next-curve", menu, tr("Next curve"), keys({"N"}), tr("Select the next curve in the list.")},
      {PreviousCurve, "previous-curve", menu, tr("Previous curve"), keys({"Shift+N"}),
       tr("Select the previous curve in the list.")},
      {FindAction, "find-action", menu, tr("Find an action…"), keys({"Ctrl+Shift+P"}),
       tr("Search all actions and settings by name.")},
  };
}

std::vector<ActionInfo> viewActions() {
  using enum ActionId;
  const auto menu = ActionMenu::View;
  return {
      {ZoomFit, "zoom-fit", menu, tr("Fit"), keys({"0"}), tr("Show the whole drawing.")},
      {ZoomActual, "zoom-actual", menu, tr("Actual pixels"), keys({"Ctrl+1"}),
       tr("One scan pixel is one screen pixel.")},
      {ZoomIn, "zoom-in", menu, tr("Zoom in"), keys({"+", "=", "Ctrl++", "Ctrl+="}),
       tr("Zoom in; the wheel zooms at the cursor.")},
      {ZoomOut, "zoom-out", menu, tr("Zoom out"), keys({"-", "Ctrl+-"}),
       tr("Zoom out; the wheel zooms at the cursor.")},
      {Compare, "compare", menu, tr("Compare"), keys({"\\"}), tr("Hold to see the scan alone."), true, true},
      {ShowScan, "show-scan", menu, tr("Scan"), keys({"Alt+1"}), tr("Show the scan."), true},
      {ShowLogImage, "show-log-image", menu, tr("Log picture"), keys({"Alt+2"}),
       tr("Show the scan after the log transform."), true},
      {ShowPaper, "show-paper", menu, tr("Flattened paper"), keys({"Alt+P"}),
       tr("Show the scan with shadows and shading of the paper removed, as the automatic "
          "thresholds see it."),
       true},
      {ShowMask, "show-mask", menu, tr("Mask"), keys({"Alt+3"}), tr("Show what counts as ink."), true},
      {ShowEdges, "show-edges", menu, tr("Edges"), keys({"Alt+4"}), tr("Show the pixels where ink meets paper."), true},
      {ShowSegments, "show-segments", menu, tr("Segments"), keys({"Alt+5"}), tr("Show the regression segments."), true},
      {ShowCurve, "show-curve", menu, tr("Sketched curve"), keys({"Alt+6"}), tr("Show the curve before fairing."),
       true},
      {ShowFaired, "show-faired", menu, tr("Faired curve"), keys({"Alt+7"}), tr("Show the faired curve."), true},
      {ShowComb, "show-comb", menu, tr("Curvature comb"), keys({"Alt+8", "C"}),
       tr("Show the curvature as a comb along the curve."), true},
      {ShowCorners, "show-corners", menu, tr("Corners"), keys({"Alt+9"}), tr("Show marked corners."), true},
      {ShowRegions, "show-regions", menu, tr("Regions"), keys({"Alt+0"}), tr("Show the 64 threshold regions."), true},
      {ShowDeviation, "show-deviation", menu, tr("Deviation"), keys({"Alt+D"}),
       tr("Show the deviation of the faired curve from the sketched one."), true},
      {Pin, "pin", menu, tr("Pin this result"), keys({"A"}),
       tr("Keep this result as a thin line for comparison; press again to remove it."), true},
      {ShowExtrema, "show-extrema", menu, tr("Curvature extrema"), keys({"Alt+X"}),
       tr("Show the curvature extrema, their significance, and those rejected as noise."), true},
      {ShowNoise, "show-band", menu, tr("Noise band"), keys({"Alt+N"}),
       tr("Show the uncertainty of the curvature due to scan noise in the comb."), true},
      {ShowStrokes, "show-strokes", menu, tr("Strokes"), keys({"Alt+S"}),
       tr("Show stroke widths, merged strokes and bridged gaps."), true},
      {ShowFallback, "show-fallback", menu, tr("Points not located"), keys({"Alt+U"}),
       tr("Show points that could not be located on the grey values of the scan."), true},
      {ShowJunctions, "show-junctions", menu, tr("Doubtful junctions"), keys({"Alt+J"}),
       tr("Show junctions whose strokes might also be paired otherwise, and those paired by hand."), true},
      {ShowExplained, "show-explained", menu, tr("Missed and invented ink"), keys({"Alt+E"}),
       tr("Show the ink that no curve explains, and stretches of curves that have no ink."), true},
  };
}

std::vector<ActionInfo> toolActions() {
  using enum ActionId;
  const auto menu = ActionMenu::Tools;
  return {
      {ToolSelect, "tool-select", menu, tr("Select curves"), keys({"V"}),
       tr("Click a curve to show its measurements and targets."), true},
      {ToolThresholds, "tool-thresholds", menu, tr("Edit thresholds"), keys({"T"}),
       tr("Click a region, then turn the wheel or drag up and down to change its threshold."), true},
      {ToolCorners, "tool-corners", menu, tr("Mark corners"), keys({"K"}),
       tr("Click a line to mark a corner; click a corner to select it, again to remove it."), true},
      {ToolPen, "tool-pen", menu, tr("Draw with pen"), keys({"D"}),
       tr("Drag to draw a line, with a mouse or a tablet; Del removes the selected one."), true},
      {ToolSegments, "tool-segments", menu, tr("Segment points"), keys({"G"}),
       tr("Click a line where two typical curves should meet; click the selected point to remove it."), true},
      {ToolLines, "tool-lines", menu, tr("Choose lines"), keys({"L"}),
       tr("Click a line to exclude it from fairing and export; click it again to include it."), true},
      {ToolJunctions, "tool-junctions", menu, tr("Pair strokes"), keys({"J"}),
       tr("Click a junction for the next pairing of its strokes, or click two of its branches to join them."), true},
      {ToolRectangle, "tool-rectangle", menu, tr("Rectangle"), keys({"R"}),
       tr("Drag a rectangle: only the area inside is traced. Further regions are added."), true},
      {ToolLasso, "tool-lasso", menu, tr("Lasso"), keys({"Shift+R"}),
       tr("Draw around the area to trace. Further regions add to it."), true},
      {ToolScale, "tool-scale", menu, tr("Measure scale"), keys({"M"}),
       tr("Drag along something of known length, then enter that length in stage Scan."), true},
      {ToolSheet, "tool-sheet", menu, tr("Corners of the sheet"), keys({"Shift+M"}),
       tr("Drag the corners onto those of the photographed sheet; Enter makes it a rectangle."), true},
      {ToolInk, "tool-ink", menu, tr("Pick an ink"), keys({"I"}),
       tr("Click an ink of a colour scan to exclude it, or to trace it again; Shift+click traces it alone."), true},
      {ToolPaint, "tool-paint", menu, tr("Trace brush"), keys({"B"}),
       tr("Drag over ink to trace it by its outline or its centre line; [ and ] change the size of the brush."), true},
      {ToolDirection, "tool-direction", menu, tr("Directions"), keys({"F"}),
       tr("Click a curve to reverse its direction; drag the ring of a closed curve to its start "
          "point."),
       true},
      {ReverseCurve, "turn-direction", menu, tr("Reverse curve"), keys({"Shift+F"}),
       tr("Reverse the direction of the selected curve.")},
      {ClearRegions, "clear-regions", menu, tr("Clear regions"), keys({"Ctrl+Shift+R"}),
       tr("Trace the whole page again.")},
  };
}

std::vector<ActionInfo> fairingActions() {
  using enum ActionId;
  const auto menu = ActionMenu::Fairing;
  return {
      {Target1, "target-1", menu, tr("Target 1, linear"), keys({"1"}),
       tr("Fair the selected curve towards a linear profile.")},
      {Target2, "target-2", menu, tr("Target 2, quadratic"), keys({"2"}),
       tr("Fair the selected curve towards a quadratic profile.")},
      {Target3, "target-3", menu, tr("Target 3, cubic"), keys({"3"}),
       tr("Fair the selected curve towards a cubic profile.")},
      {Target4, "target-4", menu, tr("Target 4, quartic"), keys({"4"}),
       tr("Fair the selected curve towards a quartic profile.")},
      {Target5, "target-5", menu, tr("Target 5, quintic"), keys({"5"}),
       tr("Fair the selected curve towards a quintic profile.")},
      {Target6, "target-6", menu, tr("Target 6, sextic"), keys({"6"}),
       tr("Fair the selected curve towards a sextic profile.")},
  };
}

std::vector<ActionInfo> buildCatalog() {
  std::vector<ActionInfo> all;
  for (const auto& part : {fileActions(), editActions(), viewActions(), toolActions(), fairingActions()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::optional<int> offset(ActionId id, ActionId first, ActionId last) {
  const int value = static_cast<int>(id), from = static_cast<int>(first), to = static_cast<int>(last);
  if (value < from || value > to) return std::nullopt;
  return value - from;
}

}  // namespace

QString label(ActionMenu menu) {
  switch (menu) {
    case ActionMenu::File:
      return tr("File");
    case ActionMenu::Edit:
      return tr("Edit");
    case ActionMenu::View:
      return tr("View");
    case ActionMenu::Tools:
      return tr("Tools");
    case ActionMenu::Fairing:
      return tr("Fairing");
  }
  return {};
}

std::span<const ActionInfo> actionCatalog() {
  static const std::vector<ActionInfo> catalog = buildCatalog();
  return catalog;
}

const ActionInfo& actionInfo(ActionId id) {
  const auto catalog = actionCatalog();
  const auto found =
      std::find_if(catalog.begin(), catalog.end(), [id](const ActionInfo& info) { return info.id == id; });
  assert(found != catalog.end());
  return *found;
}

QAction* makeAction(ActionId id, QObject* parent) {
  const ActionInfo& info = actionInfo(id);
  auto* action = new QAction(info.text, parent);
  action->setObjectName(QString::fromLatin1(info.name));
  if (!info.isHeld) action->setShortcuts(info.shortcuts);
  action->setCheckable(info.isCheckable);
  action->setStatusTip(info.help);
  const QString shortcut =
      info.shortcuts.isEmpty() ? QString() : info.shortcuts.first().toString(QKeySequence::NativeText);
  action->setToolTip(shortcut.isEmpty() ? info.help
                                        : info.help + QStringLiteral("  (") + shortcut + QStringLiteral(")"));
  return action;
}

std::optional<Layer> layerOf(ActionId id) {
  const auto index = offset(id, ActionId::ShowScan, ActionId::ShowExplained);
  if (!index) return std::nullopt;
  return kLayers[*index];
}

std::optional<Tool> toolOf(ActionId id) {
  switch (id) {
    case ActionId::ToolSelect:
      return Tool::Select;
    case ActionId::ToolThresholds:
      return Tool::Thresholds;
    case ActionId::ToolCorners:
      return Tool::Corners;
    case ActionId::ToolPen:
      return Tool::Pen;
    case ActionId::ToolSegments:
      return Tool::Segments;
    case ActionId::ToolLines:
      return Tool::Lines;
    case ActionId::ToolRectangle:
      return Tool::Rectangle;
    case ActionId::ToolLasso:
      return Tool::Lasso;
    case ActionId::ToolScale:
      return Tool::Scale;
    case ActionId::ToolDirection:
      return Tool::Direction;
    case ActionId::ToolJunctions:
      return Tool::Junctions;
    case ActionId::ToolSheet:
      return Tool::Sheet;
    case ActionId::ToolInk:
      return Tool::Ink;
    case ActionId::ToolPaint:
      return Tool::Paint;
    default:
      return std::nullopt;
  }
}

static_assert(static_cast<int>(ActionId::Target6) - static_cast<int>(ActionId::Target1) + 1 == kMostTargetDegree);

std::optional<int> targetOf(ActionId id) {
  const auto index = offset(id, ActionId::Target1, ActionId::Target6);
  if (!index) return std::nullopt;
  return *index + 1;
}

ActionId showAction(Layer layer) {
  const auto at = std::find(kLayers.begin(), kLayers.end(), layer) - kLayers.begin();
  return static_cast<ActionId>(static_cast<int>(ActionId::ShowScan) + static_cast<int>(at));
}

ActionId toolAction(Tool tool) {
  switch (tool) {
    case Tool::Select:
      return ActionId::ToolSelect;
    case Tool::Thresholds:
      return ActionId::ToolThresholds;
    case Tool::Corners:
      return ActionId::ToolCorners;
    case Tool::Pen:
      return ActionId::ToolPen;
    case Tool::Segments:
      return ActionId::ToolSegments;
    case Tool::Lines:
      return ActionId::ToolLines;
    case Tool::Rectangle:
      return ActionId::ToolRectangle;
    case Tool::Lasso:
      return ActionId::ToolLasso;
    case Tool::Scale:
      return ActionId::ToolScale;
    case Tool::Direction:
      return ActionId::ToolDirection;
    case Tool::Junctions:
      return ActionId::ToolJunctions;
    case Tool::Sheet:
      return ActionId::ToolSheet;
    case Tool::Ink:
      return ActionId::ToolInk;
    case Tool::Paint:
      return ActionId::ToolPaint;
  }
  return ActionId::ToolSelect;
}

}  // namespace batten
