// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>
#include <memory>

#include "ui/commands/action_catalog.h"
#include "ui/panels/panel_stage.h"
#include "ui/session/editor_session.h"
#include "ui/session/view_settings.h"
#include "ui/theme/theme.h"

class QMenu;

namespace batten {

/// The one window: stages at the left, the drawing in the middle, the inspector at the right, targets and plots below.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow();
  ~MainWindow() override;

  /// Opens a scan, with the recipe saved beside it; a recipe file (.json) is applied to the open one.
  void openPath(const QString& path);
  /// Begins a drawing on the empty page of the recipe, with the pen in hand.
  void beginDrawing(const Recipe& recipe);
  void setStage(PanelStage stage);
  PanelStage stage() const;
  EditorSession& session() { return session_; }
  ViewSettings& view() { return view_; }
  QAction* action(ActionId id) const;
  void setThemeChoice(ThemeChoice choice);
  static ThemeChoice storedTheme();
  /// Files opened lately, newest first; those that have gone are left out.
  static QStringList recentFiles();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;
  void closeEvent(QCloseEvent*) override;
  void changeEvent(QEvent*) override;

 private:
  void makeActions();
  void makeMenus();
  QWidget* makeInspector();
  QWidget* makeCentre();
  void connectSession();
  void connectActions();
  void connectLayers();
  void trigger(ActionId id);
  void newDrawing();
  void chooseScan();
  void chooseRecipe();
  void saveRecipe();
  void applyRecipeFile(const QString& path);
  void findAction();
  void showHelp(const QString& page);
  void showShapes();
  void showProblem(const QString& message);
  void actOnProblem();
  void refreshActions();
  void refreshTitle();
  void refreshRecent();
  void rememberFile(const QString& path);
  /// Where file dialogs open: at the drawing, else where the last one was.
  QString startFolder() const;
  void enterStage(PanelStage stage);
  void loadSettings();
  void saveSettings();

  EditorSession session_;
  ViewSettings view_;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
