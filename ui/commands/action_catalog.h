// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QKeySequence>
#include <QList>
#include <QString>
#include <optional>
#include <span>

#include "ui/session/view/view_settings.h"

class QAction;
class QObject;

namespace batten {

/// Everything the window can do. Menus, the action finder and the shortcut list are built from the catalog, so that no
/// two of them can disagree.
enum class ActionId {
  NewDrawing,
  OpenScan,
  OpenRecipe,
  SaveRecipe,
  Export,
  Quit,
  Undo,
  Redo,
  CancelWork,
  ComputeAgain,
  FindAction,
  ZoomFit,
  ZoomActual,
  ZoomIn,
  ZoomOut,
  Compare,
  ShowScan,
  ShowLogImage,
  ShowPaper,
  ShowMask,
  ShowEdges,
  ShowSegments,
  ShowCurve,
  ShowFaired,
  ShowComb,
  ShowCorners,
  ShowRegions,
  ShowDeviation,
  ShowExtrema,
  ShowNoise,
  ShowStrokes,
  ShowFallback,
  ShowJunctions,
  ShowExplained,
  ToolSelect,
  ToolThresholds,
  ToolCorners,
  ToolPen,
  ToolSegments,
  Pin,
  ToolLines,
  ToolRectangle,
  ToolLasso,
  ToolScale,
  ToolDirection,
  ClearRegions,
  Target1,
  Target2,
  Target3,
  Target4,
  Target5,
  Target6,
  SaveRecipeAs,
  NextCurve,
  PreviousCurve,
  ImportCurves,
  PasteScan,
  CopySvg,
  ReverseCurve,
  ToolJunctions,
  ToolSheet,
  ToolInk,
  ToolPaint,
};

enum class ActionMenu { File, Edit, View, Tools, Fairing };
QString label(ActionMenu);

struct ActionInfo {
  ActionId id;
  const char* name;  ///< "open-scan": stable, for tests and object names.
  ActionMenu menu;
  QString text;
  QList<QKeySequence> shortcuts;  ///< The first is the one shown.
  QString help;                   ///< One line: tooltip, status tip and what the finder searches.
  bool isCheckable = false;
  bool isHeld = false;  ///< Acts while its key is down: no QAction shortcut, the canvas sees the key itself.
};

/// All actions in the order of the menus. Built once.
std::span<const ActionInfo> actionCatalog();
const ActionInfo& actionInfo(ActionId);
/// An action with text, shortcuts, help and object name from the catalog. Held actions get no live shortcut.
QAction* makeAction(ActionId, QObject* parent);

/// The layer that a Show… action switches, the tool that a Tool… action chooses, the degree that a Target…
/// chooses.
std::optional<Layer> layerOf(ActionId);
std::optional<Tool> toolOf(ActionId);
std::optional<int> targetOf(ActionId);
ActionId showAction(Layer);
ActionId toolAction(Tool);

}  // namespace batten
