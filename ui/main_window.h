// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>
#include <functional>
#include <memory>

#include "ui/commands/action_catalog.h"
#include "ui/panels/rail/panel_stage.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"
#include "ui/theme/theme.h"

class QMenu;

namespace batten {

struct ImportReport;

/// What is to become of unsaved work that is in the way.
enum class UnsavedAnswer { Save, Discard, Cancel };

/// The one window: stages at the left, the drawing in the middle, the inspector at the right, targets and plots below.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow();
  ~MainWindow() override;

  /// Opens a scan, with the recipe saved beside it; a recipe file (.json) is applied to the open one. Asks first where
  /// unsaved work would go.
  void openPath(const QString& path);
  /// What the program starts with: work that a crash has left, else the newest recent file that is there, else
  /// `sample`.
  void openAtStart(const QString& sample);
  /// Offers work that a program left which did not end as it should; false = there is none.
  bool offerLeftWork();
  /// Begins a drawing on the empty page of the recipe, with the pen in hand. Asks first where unsaved work would go.
  void beginDrawing(const Recipe& recipe);
  /// Who answers what is to become of unsaved work in a drawing of this name; a box on the screen unless set.
  using UnsavedQuestion = std::function<UnsavedAnswer(const QString& drawing)>;
  void setUnsavedQuestion(UnsavedQuestion question);
  void setStage(PanelStage stage);
  PanelStage stage() const;
  EditorSession& session() { return session_; }
  ViewSettings& view() { return view_; }
  QAction* action(ActionId id) const;
  void setThemeChoice(ThemeChoice choice);
  static ThemeChoice storedTheme();
  /// Files opened or saved lately, newest first, as they were remembered.
  static QStringList recentFiles();
  /// Where journals of unsaved work lie.
  static QString journalFolder();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;
  void closeEvent(QCloseEvent*) override;
  void changeEvent(QEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  bool focusNextPrevChild(bool next) override;

 private:
  void makeActions();
  void makeMenus();
  QWidget* makeInspector(QWidget* whole);
  QWidget* makeCentre(QWidget* whole);
  void connectSession();
  void connectActions();
  void connectLayers();
  void showStrokes(bool isEntering);
  void showHere(Layer, bool on);
  void showLog();
  void showRoundings();
  void trigger(ActionId id);
  void applyTarget(int degree);
  void newDrawing();
  void chooseScan();
  void chooseRecipe();
  /// Both false when it was not saved after all. The first asks for a place only while there is none.
  bool saveRecipe();
  bool saveRecipeAs();
  bool saveRecipeTo(const QString& path);
  QString proposedRecipePath() const;
  /// @param withScan opened as the drawing that the recipe was saved for; empty: used on the one that is open.
  void readRecipe(const QString& path, const QString& withScan = {});
  void chooseImport();
  /// Takes the lines of a file over: into the open drawing, or as a drawing of their own.
  void readImport(const QString& path, bool intoDrawing);
  void useImport(const ImportReport& report, bool intoDrawing);
  void openPage(const PageChoice& page);
  void pasteScan();
  void useRecipe(const QString& path, const Result<Recipe>& recipe, const QString& withScan);
  /// True when nothing unsaved is left that would be lost.
  bool maybeDiscard();
  void scanOpened();
  void tellNotOpened(const QString& path);
  void checkRecent(std::function<void()> then);
  QString drawingName() const;
  void findAction();
  void walkCurves(int step);
  void stepBack(bool isUndo);
  void showHelp(const QString& page);
  void showShapes();
  void showProblem(const Error& error, FailureOrigin origin);
  void leaveProblem();
  /// What helps against an error: the button's text, and what it does.
  std::pair<QString, std::function<void()>> remedyFor(const Error& error, FailureOrigin origin);
  void refreshActions();
  void refreshTitle();
  void refreshRecent();
  void fillRecent();
  /// The recent recipes, and the scans that have none, the newest first.
  QStringList recentDrawings() const;
  /// Greys what the last look did not find, and no more what it found, in its place.
  void greyGone();
  QString stageHint() const;
  /// @param scan of a recipe: that it was saved for.
  void rememberFile(const QString& path, const QString& scan = {});
  /// The scan that a recent recipe was saved for; empty: not known, or none.
  static QString scanOfRecipe(const QString& path);
  void openRecent(const QString& path);
  void offerSavedRecipe();
  /// Where file dialogs open: at the drawing, else where the last one was.
  QString startFolder() const;
  void enterStage(PanelStage stage);
  void showLayersOf(PanelStage stage);
  /// Targets and plots, in main_window_lower.cpp: shown where curves are judged; in a low window the strip shrinks,
  /// then the plots fold.
  void fitLower();
  void fitLowerSoon();   ///< Once the parts of the window have their sizes.
  void followTargets();  ///< Computed where somebody looks at them: with the tiles, with Compare shapes.
  void foldLower(bool shown);
  bool isLowerWanted() const;
  void loadSettings();
  void saveSettings();

  EditorSession session_;
  ViewSettings view_;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
