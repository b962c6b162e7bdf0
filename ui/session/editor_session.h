// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QHash>
#include <QObject>
#include <QString>
#include <QUndoStack>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "core/fairing/fairing.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/session/gesture_id.h"
#include "ui/session/known_splits.h"

namespace batten {

struct CoarseResult;
class ExplanationSource;
class GrowingPlayer;
class SuggestionSource;
/// A result set aside to compare later ones with. All parts belong together.
struct PinnedResult {
  std::shared_ptr<const FairedSet> faired;
  std::shared_ptr<const PieceSet> pieces;
  PageFrame frame;
  Recipe recipe;
};

/// What was being done when something failed: the window offers help by it.
enum class FailureOrigin { OpenScan, OpenRecipe, SaveRecipe, Run, Export };

/// The open drawing: scan, recipe, undo stack, and the newest outputs of the pipeline. Paints nothing. All functions
/// and signals belong to the GUI thread; work runs in the background, the newest request wins, and nothing here ever
/// waits.
class EditorSession : public QObject {
  Q_OBJECT
 public:
  explicit EditorSession(QObject* parent = nullptr);
  ~EditorSession() override;

  /// Reads a scan in the background, with the recipe that was saved beside it; scanOpened or failed follows. An open
  /// drawing stays until the new one is there.
  /// @param page of a file of several; absent: that of the recipe, else the first.
  void openScan(const QString& path, const std::optional<PageChoice>& page = {});
  /// Reads a scan to go on with work saved elsewhere: with this recipe, which counts as saved.
  void openSaved(const QString& path, const Recipe& recipe);
  /// What a scan opens with that has no recipe beside it; the program's defaults unless set.
  void setStartRecipe(const Recipe& recipe) { startRecipe_ = recipe; }
  /// Begins a drawing without a scan, on white paper of the size recipe.page, with this recipe. The paper is made in
  /// the background, scanOpened or failed follows; the undo stack is empty. @pre recipe.page
  void newDrawing(const Recipe& recipe);
  /// Opens a scan (an empty path: the page of the recipe) with this recipe, which counts as unsaved: work that a crash
  /// has left behind.
  void restore(const QString& path, const Recipe& recipe);
  bool hasScan() const { return scan_ != nullptr; }
  bool isBlankPage() const { return scan_ && isBlank(*scan_); }
  /// The page: the picture as it was read or, if the recipe wants so, rectified. All places are its pixels.
  std::shared_ptr<const Scan> scan() const { return scan_; }
  /// The picture as it was read.
  std::shared_ptr<const Scan> picture() const { return picture_; }
  QString scanPath() const;
  /// True if the drawing opened with a saved recipe: the one beside it, or that of openSaved().
  bool openedWithRecipe() const;
  /// True if the drawing was opened by restore().
  bool wasRestored() const;
  /// True while the recipe differs from what was opened or saved last.
  bool hasUnsavedChanges() const { return scan_ && !undo_.isClean() && saved_ != recipe_; }
  /// The present recipe is on disk.
  void markSaved() {
    saved_ = recipe_;
    undo_.setClean();
  }
  /// Why the recipe beside the drawing was not used; empty = there was none, or it was.
  QString openProblem() const;

  const Recipe& recipe() const { return recipe_; }
  /// The recipe with the numbers given to curves so far: what files keep. recipe() is without them, as they are no
  /// change that could be undone.
  Recipe recipeToSave() const;
  /// Changes the recipe by an undoable command. Changes with one `gesture` merge into one undo step.
  /// Numbers of curves in `after`, as a recipe from a file has them, count from now on.
  void change(const QString& what, Recipe after, GestureId gesture = {});
  /// A fresh gesture number for a drag.
  int newGesture() { return ++lastGesture_; }
  QUndoStack* undoStack() { return &undo_; }
  /// Only for the undo command: sets the recipe and starts a run.
  void setRecipe(const Recipe&);

  /// Outputs of the newest run that has got that far; parts may still be from the run before (see isStale).
  const PipelineOutput& output() const { return output_; }
  /// The curves to show, which selectedCurve() counts: the faired set, or the constructed one while there is none.
  std::span<const TracedCurve> curves() const;
  /// Of large pages: what a quick run on a smaller page has found, for as long as it is newer than what output() holds.
  /// To be looked at; everything else goes by output(). Curves are only there while curves() is empty. Null otherwise.
  std::shared_ptr<const CoarseResult> coarseInk() const;
  std::shared_ptr<const CoarseResult> coarseCurves() const;
  /// Whose choice is whose in the present recipe: on the pieces shown, as the next run applies them.
  const ChoiceOwners& choiceOwners() const;
  /// One of curves(), or null where there is none of that index.
  const TracedCurve* curveAt(std::optional<int> index) const;
  /// The selected one of curves(), or null.
  const TracedCurve* selected() const { return curveAt(selectedCurve_); }
  /// The edges layer is only computed while someone looks at it (off at the start).
  void setEdgesWanted(bool);
  /// So are the six targets of the selected curve (on at the start). What is there stays when it is switched off; what
  /// is computed stops.
  void setTargetsWanted(bool);
  /// True while a stage's shown output does not belong to the present recipe yet.
  bool isStale(StageId) const;
  bool isBusy() const;
  /// True while the six targets of the selected curve are computed.
  bool isTargeting() const;
  /// True while anything runs that cancel() stops: reading, the pipeline, the targets, work of panels.
  bool isWorking() const;
  /// Esc: stops running work; the outputs so far stay.
  void cancel();
  /// True after cancel() has stopped something, until it is computed again.
  bool isStopped() const;
  /// Computes what cancel() has stopped.
  void computeAgain();
  /// True while a thread of the session still runs a job, even a cancelled one.
  bool hasRunningJobs() const;
  /// Work that a panel does in the background for its own display: shown as busy, and stopped by `stopped`.
  /// @param isShown the display lacks something while it is stopped.
  void setSideWork(const QObject* panel, bool busy, bool isShown = true);
  /// Milliseconds of the last finished run.
  double lastRunMilliseconds() const { return lastRunMs_; }

  /// The curve that panels and plots show. Kept by position when the curves change.
  std::optional<int> selectedCurve() const { return selectedCurve_; }
  void selectCurve(std::optional<int> index);
  /// Selects the curve nearest to a place now and when the curves change next: for a line that is only being made.
  void selectNear(const Vec2& px);

  /// Sets the present result aside (nothing while there is none); a second pin replaces the first.
  void pin();
  void unpin();
  std::shared_ptr<const PinnedResult> pinned() const { return pinned_; }
  /// The pinned curve that belongs to one of curves(), by place; null = none.
  const TracedCurve* pinnedOf(std::optional<int> curve) const;

  /// The corner mark chosen in the list or on the drawing, index into recipe().cornerMarks. It follows its place
  /// when marks come and go.
  std::optional<int> selectedCorner() const { return selectedCorner_; }
  void selectCorner(std::optional<int> mark);

  /// The six targets of the selected curve, null while they are computed.
  std::shared_ptr<const TargetOutcomes> targets() const { return targets_; }
  KnownSplits& knownSplits() const { return knownSplits_; }
  /// The span of the selected curve to which the six targets belong, by a place in it as a share of the arc length;
  /// none: the whole curve, every span by itself.
  std::optional<double> pointedSpan() const { return pointedSpan_; }
  void pointAtSpan(std::optional<double> share);
  /// Degree of the target shown as a ghost while hovered.
  std::optional<int> hoveredTarget() const { return hoveredTarget_; }
  void hoverTarget(std::optional<int> degree);
  /// The cursor common to canvas and plots: arc length [mm] on the selected curve, or none.
  std::optional<double> cursor() const { return cursorMm_; }
  /// How the typical chain of the selected curve grows, step by step; idle until it is opened.
  GrowingPlayer& growing() const { return *growing_; }
  /// Places that could be corners; idle until someone looks.
  SuggestionSource& suggestions() const { return *suggestions_; }
  /// How well the curves explain the ink; idle until someone looks.
  ExplanationSource& explanation() const { return *explanation_; }
  void setCursor(std::optional<double> sMm);

 signals:
  void scanOpened();
  void pageChanged();  ///< scan() is another page of the same picture: it was rectified, or is so no more.
  void recipeChanged();
  void stageReady(batten::StageId stage);
  void coarseReady();  ///< coarseInk() or coarseCurves() is there, or newer.
  void runFinished();  ///< The newest run ended (done, failed or cancelled).
  void busyChanged(bool busy);
  void workingChanged(bool working);
  void stopped();  ///< cancel() has stopped what ran.
  void progress(double fraction);
  void selectionChanged();
  void cornerSelectionChanged();
  void targetsChanged();
  void hoverChanged();
  void cursorChanged();
  void pinChanged();
  void failed(const batten::Error& error, batten::FailureOrigin origin);
  void failureCleared();  ///< A run succeeds after one that failed.

 private:
  struct Runner;
  void keepCornerSelection(const std::vector<CornerMark>& after);

  /// What choiceOwners() found last, and for what: asked for with every move of the mouse.
  struct KnownOwners {
    std::shared_ptr<const PieceSet> pieces;
    std::vector<PieceChoice> choices;
    ChoiceOwners owners;
  };

  std::unique_ptr<Runner> runner_;
  std::shared_ptr<const Scan> picture_, scan_;  ///< The same while the page is not rectified.
  Recipe recipe_, startRecipe_;
  std::optional<Recipe> saved_;  ///< As it is on disk; none: never saved.
  PipelineOutput output_;
  std::shared_ptr<const CoarseResult> coarse_;
  mutable KnownOwners known_;
  mutable KnownSplits knownSplits_;
  QUndoStack undo_;
  int lastGesture_ = 0;
  std::optional<int> selectedCurve_, selectedCorner_;
  QHash<const QObject*, bool> sideWork_;  ///< And whether its result is on display.
  std::shared_ptr<const TargetOutcomes> targets_;
  std::optional<double> pointedSpan_;
  std::optional<int> hoveredTarget_;
  std::optional<double> cursorMm_;
  std::shared_ptr<const PinnedResult> pinned_;
  double lastRunMs_ = 0.0;
  GrowingPlayer* growing_ = nullptr;
  SuggestionSource* suggestions_ = nullptr;
  ExplanationSource* explanation_ = nullptr;
};

}  // namespace batten
