// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QHash>
#include <QPainter>
#include <QPointer>
#include <optional>
#include <vector>

#include "core/image/log_transform.h"
#include "ui/command_palette.h"
#include "ui/error_strip.h"
#include "ui/help_window.h"
#include "ui/main_window.h"
#include "ui/opening_guard.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"
#include "ui/session/background/thread_shortage.h"
#include "ui/session/recipe_journal.h"

class QSplitter;
class QStackedWidget;

namespace batten {

class CurveCanvas;
class CurvePlots;
class ExportPanel;
class ScanPanel;
class SettingFinder;
class ShapeWindow;
class StageRail;
class StatusLine;
class TargetStrip;
class TopBar;

/// What the main window is made of; shared by its source files only.
struct MainWindow::Parts {
  TopBar* topBar = nullptr;
  ErrorStrip* errors = nullptr;
  StageRail* rail = nullptr;
  QSplitter* splitter = nullptr;
  CurveCanvas* canvas = nullptr;
  QWidget* lower = nullptr;
  TargetStrip* strip = nullptr;
  CurvePlots* plots = nullptr;
  QStackedWidget* inspector = nullptr;
  ScanPanel* scanPanel = nullptr;
  ExportPanel* exportPanel = nullptr;
  StatusLine* status = nullptr;
  CommandPalette* finder = nullptr;
  QPointer<HelpWindow> help;
  QPointer<ShapeWindow> shapes;
  QMenu* mainMenu = nullptr;
  QMenu* layersMenu = nullptr;
  QMenu* recentMenu = nullptr;
  QHash<int, QAction*> actions;
  QList<QAction*> ownActions;  ///< Beside the catalog: stages, plots, help, theme.
  QAction* foldAction = nullptr;
  struct StageLayer {
    Layer layer;
    bool before, during;
  };
  bool isFitting = false;       ///< fitLower() is on its way.
  std::optional<int> lowerPx;   ///< Height of targets and plots, once the user has drawn it.
  bool showsLower = true;       ///< Whether they are shown in the stages that they belong to.
  bool showsLowerHere = false;  ///< Brought up by hand in another stage, until it is left.
  SettingFinder* settings = nullptr;
  QString recipePath;  ///< Where the recipe was read from or saved last; empty: nowhere yet.
  QString pageRecipe;  ///< The file of the drawing that is being opened, when it is one without a scan.
  std::vector<StageLayer> stageLayers;  ///< Switched by the present stage, switched back when it is left.
  LogParams log;                        ///< Of the log picture in stage Scan.
  enum class StrokesFor { Nothing, Bridges, Merges };
  StrokesFor strokesFor = StrokesFor::Nothing;  ///< Why the layer of strokes was shown by itself last.
  bool hidesBridges = false;                    ///< The user has hidden that layer: bridges do not show it any more.
  std::function<void()> remedy, dismissal;      ///< Of the message shown.
  std::optional<FailureOrigin> problemOrigin;   ///< Of the message shown.
  UnsavedQuestion unsavedQuestion;
  ThreadShortage threadShortage{BackgroundThreads::shared()};
  std::unique_ptr<RecipeJournal> journal;
  std::unique_ptr<OpeningGuard> opening;
  std::optional<RecipeJournal::Left> leftWork;  ///< Offered, not yet answered.
  QString sample;                               ///< Opened when the offer at the start is discarded.
  QStringList goneFiles;                        ///< Recent files that were not there when last looked for.
  std::vector<std::function<void()>> afterRecentCheck;
  Inbox inbox;
  std::unique_ptr<BackgroundWorker> recipeReader = std::make_unique<BackgroundWorker>();
  std::unique_ptr<BackgroundWorker> recentChecker = std::make_unique<BackgroundWorker>();
};

/// The tool that a stage begins with.
inline Tool usualTool(PanelStage stage) {
  return stage == PanelStage::Threshold ? Tool::Thresholds
         : stage == PanelStage::Corners ? Tool::Corners
                                        : Tool::Select;
}

/// A panel with a hairline at its left edge.
class HairlineFrame : public QWidget {
  Q_OBJECT
 public:
  using QWidget::QWidget;

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.fillRect(rect(), theme.panel);
    painter.fillRect(0, 0, 1, height(), theme.line);
  }
};

}  // namespace batten
