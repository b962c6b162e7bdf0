// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "core/pipeline/pipeline.h"
#include "core/pipeline/recipe.h"

namespace batten {

class GrowingPlayer;
/// A result set aside to compare later ones with. All parts belong together.
struct PinnedResult {
  std::shared_ptr<const FairedSet> faired;
  std::shared_ptr<const PieceSet> pieces;
  PageFrame frame;
  Recipe recipe;
};

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
  void openScan(const QString& path);
  /// Begins a drawing without a scan, on white paper of the size recipe.page, with this recipe. scanOpened follows at
  /// once; the undo stack is empty. @pre recipe.page
  void newDrawing(const Recipe& recipe);
  bool hasScan() const { return scan_ != nullptr; }
  bool isBlankPage() const { return scan_ && isBlank(*scan_); }
  std::shared_ptr<const Scan> scan() const { return scan_; }
  QString scanPath() const;
  /// True if the drawing opened with the recipe beside it.
  bool openedWithRecipe() const;
  /// Why the recipe beside the drawing was not used; empty = there was none, or it was.
  QString openProblem() const;

  const Recipe& recipe() const { return recipe_; }
  /// Changes the recipe by an undoable command. Changes with one `gesture` (>= 0) merge into one undo step; -1 never
  /// merges.
  void change(const QString& what, Recipe after, int gesture = -1);
  /// A fresh gesture number for a drag.
  int newGesture() { return ++lastGesture_; }
  QUndoStack* undoStack() { return &undo_; }
  /// Only for the undo command: sets the recipe and starts a run.
  void setRecipe(const Recipe&);

  /// Outputs of the newest run that has got that far; parts may still be from the run before (see isStale).
  const PipelineOutput& output() const { return output_; }
  /// The curves to show, which selectedCurve() counts: the faired set, or the constructed one while there is none.
  std::span<const TracedCurve> curves() const;
  /// The selected one of curves(), or null.
  const TracedCurve* selected() const;
  /// The edges layer is only computed while someone looks at it (off at the start).
  void setEdgesWanted(bool);
  /// True while a stage's shown output does not belong to the present recipe yet.
  bool isStale(StageId) const;
  bool isBusy() const;
  /// Esc: stops running work; the outputs so far stay.
  void cancel();
  /// Milliseconds of the last finished run.
  double lastRunMilliseconds() const { return lastRunMs_; }

  /// The curve that panels and plots show; -1 = none. Kept by position when the curves change.
  int selectedCurve() const { return selectedCurve_; }
  void selectCurve(int index);
  /// Selects the curve nearest to a place now and when the curves change next: for a line that is only being made.
  void selectNear(const Vec2& px);

  /// Sets the present result aside (nothing while there is none); a second pin replaces the first.
  void pin();
  void unpin();
  std::shared_ptr<const PinnedResult> pinned() const { return pinned_; }
  /// The pinned curve that belongs to one of curves(), by place; null = none.
  const TracedCurve* pinnedOf(int curve) const;

  /// The six targets of the selected curve, null while they are computed.
  std::shared_ptr<const TargetOutcomes> targets() const { return targets_; }
  /// Target shown as a ghost while hovered, 0 = none.
  int hoveredTarget() const { return hoveredTarget_; }
  void hoverTarget(int degree);
  /// The cursor common to canvas and plots: arc length [mm] on the selected curve, or none.
  std::optional<double> cursor() const { return cursorMm_; }
  /// How the typical chain of the selected curve grows, step by step; idle until it is opened.
  GrowingPlayer& growing() const { return *growing_; }
  void setCursor(std::optional<double> sMm);

 signals:
  void scanOpened();
  void recipeChanged();
  void stageReady(batten::StageId stage);
  void runFinished();  ///< The newest run ended (done, failed or cancelled).
  void busyChanged(bool busy);
  void progress(double fraction);
  void selectionChanged();
  void targetsChanged();
  void hoverChanged();
  void cursorChanged();
  void pinChanged();
  void failed(const QString& message);  ///< One line that says what to do.
  void failureCleared();

 private:
  struct Runner;
  std::unique_ptr<Runner> runner_;
  std::shared_ptr<const Scan> scan_;
  Recipe recipe_;
  PipelineOutput output_;
  QUndoStack undo_;
  int lastGesture_ = 0;
  int selectedCurve_ = -1;
  std::shared_ptr<const TargetOutcomes> targets_;
  int hoveredTarget_ = 0;
  std::optional<double> cursorMm_;
  std::shared_ptr<const PinnedResult> pinned_;
  double lastRunMs_ = 0.0;
  GrowingPlayer* growing_ = nullptr;
};

}  // namespace batten
