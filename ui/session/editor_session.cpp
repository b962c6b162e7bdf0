// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/editor_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fairing/profile/target_degrees.h"
#include "core/pipeline/run/piece_choices.h"
#include "ui/session/change_recipe.h"
#include "ui/session/curve_piece.h"
#include "ui/session/explanation_source.h"
#include "ui/session/growing_player.h"
#include "ui/session/session_runner.h"
#include "ui/session/suggestion_source.h"

namespace batten {
namespace {
constexpr int kMostUndoSteps = 500;  // limits the memory of recipes
/// [px] A curve that lies farther from a pinned one than this is another curve.
constexpr double kSamePlacePx = 24.0;

/// A step that changes more, as opening a recipe does, is no marking of corners.
bool differInMarksOnly(Recipe a, const Recipe& b) {
  if (a.cornerMarks == b.cornerMarks) return false;
  a.cornerMarks = b.cornerMarks;
  return a == b;
}
}  // namespace

EditorSession::EditorSession(QObject* parent)
    : QObject(parent),
      runner_(std::make_unique<Runner>(*this)),
      growing_(new GrowingPlayer(*this)),
      suggestions_(new SuggestionSource(*this)),
      explanation_(new ExplanationSource(*this)) {
  // A step holds two recipes; some hundred are a long afternoon.
  undo_.setUndoLimit(kMostUndoSteps);
}

EditorSession::~EditorSession() {
  growing_->close();
  // Told to stop together, then joined one by one: quitting takes as long as the slowest, not as the sum.
  runner_->pipeline.cancelAll();
  runner_->reader.cancelAll();
  runner_->targets.cancel();
  runner_->coarse.cancel();
}

void EditorSession::openScan(const QString& path, const std::optional<PageChoice>& page) {
  runner_->read(path, page, std::nullopt);
}

void EditorSession::openSaved(const QString& path, const Recipe& recipe) {
  runner_->read(path, std::nullopt, recipe, false);
}

void EditorSession::newDrawing(const Recipe& recipe) { runner_->begin(recipe, false); }

void EditorSession::restore(const QString& path, const Recipe& recipe) {
  if (path.isEmpty())
    runner_->begin(recipe, true);
  else
    runner_->read(path, std::nullopt, recipe);
}

bool EditorSession::wasRestored() const { return runner_->wasRestored; }

QString EditorSession::scanPath() const { return runner_->path; }

bool EditorSession::openedWithRecipe() const { return runner_->openedWithRecipe; }

QString EditorSession::openProblem() const { return runner_->openProblem; }

Recipe EditorSession::recipeToSave() const {
  Recipe recipe = recipe_;
  recipe.curveNumbers = runner_->numbers;
  return recipe;
}

void EditorSession::change(const QString& what, Recipe after, GestureId gesture) {
  CurveNumbers numbers = std::exchange(after.curveNumbers, {});
  const bool bringsNumbers = numbers != CurveNumbers{};
  if (bringsNumbers) {
    numbers.lastGiven = std::max(numbers.lastGiven, runner_->numbers.lastGiven);
    runner_->takeNumbers(std::move(numbers), after);
  }
  if (after == recipe_) {
    if (bringsNumbers) runner_->run();
    return;
  }
  undo_.push(new ChangeRecipe(*this, what, recipe_, std::move(after), gesture));
}

void EditorSession::setRecipe(const Recipe& recipe) {
  if (recipe == recipe_) return;
  const TracedCurve* curve = selected();
  if (runner_->selectsItself && curve && !curve->sketched.isEmpty() && differInMarksOnly(recipe_, recipe)) {
    // Marking corners is work on this line: it stays selected, though another one may be longer than its parts. By its
    // place on the curve, as the pieces may already be those of a newer recipe.
    const double middle = 0.5 * (curve->sketched.start() + curve->sketched.end());
    runner_->anchorPx = output_.frame.pointToImage(curve->sketched.point(middle));
    runner_->selectsItself = false;
  }
  keepCornerSelection(recipe.cornerMarks);
  recipe_ = recipe;
  ++runner_->recipeGeneration;
  emit recipeChanged();
  runner_->run();
}

std::span<const TracedCurve> EditorSession::curves() const {
  if (output_.faired) return output_.faired->curves;
  if (output_.constructed) return output_.constructed->curves;
  return {};
}

std::shared_ptr<const CoarseResult> EditorSession::coarseInk() const {
  return coarse_ && coarse_->generation > runner_->shownGeneration[indexOf(StageId::Filtered)] ? coarse_ : nullptr;
}

std::shared_ptr<const CoarseResult> EditorSession::coarseCurves() const {
  return coarse_ && coarse_->faired && curves().empty() ? coarse_ : nullptr;
}

const ChoiceOwners& EditorSession::choiceOwners() const {
  // Whose a line is hangs on the anchors alone: a slider that changes a target every moment must not ask again.
  const auto isAlike = [](const PieceChoice& a, const PieceChoice& b) {
    return a.anchorsPx == b.anchorsPx && a.isEmpty() == b.isEmpty();
  };
  if (known_.pieces != output_.pieces || !std::ranges::equal(known_.choices, recipe_.choices, isAlike)) {
    known_ = {output_.pieces, recipe_.choices, {}};
    if (output_.pieces) known_.owners = assignChoices(*output_.pieces, recipe_.choices);
  }
  return known_.owners;
}

const TracedCurve* EditorSession::curveAt(std::optional<int> index) const {
  const auto all = curves();
  return index && *index >= 0 && *index < std::ssize(all) ? &all[*index] : nullptr;
}

void EditorSession::setEdgesWanted(bool wanted) {
  if (runner_->edgesWanted == wanted) return;
  runner_->edgesWanted = wanted;
  if (wanted && !(output_.edges && !isStale(StageId::Edges))) runner_->run();
}

void EditorSession::setTargetsWanted(bool wanted) {
  if (std::exchange(runner_->targetsWanted, wanted) == wanted) return;
  if (wanted && !runner_->isStopped) {
    runner_->computeTargets();
  } else if (!wanted && runner_->targets.isComputing()) {
    runner_->targets.stop();
    runner_->updateBusy();
  }
}

bool EditorSession::isStale(StageId stage) const {
  return runner_->shownGeneration[indexOf(stage)] != runner_->recipeGeneration;
}

bool EditorSession::isBusy() const { return runner_->isRunning || runner_->isReading; }

bool EditorSession::isTargeting() const { return runner_->targets.isComputing(); }

bool EditorSession::isWorking() const { return isBusy() || isTargeting() || !sideWork_.isEmpty(); }

void EditorSession::cancel() { runner_->stopAll(); }

bool EditorSession::isStopped() const { return runner_->isStopped; }

void EditorSession::computeAgain() {
  runner_->isStopped = false;
  runner_->run();
  if (!isStale(StageId::Faired)) runner_->computeTargets();
}

bool EditorSession::hasRunningJobs() const {
  return runner_->reader.isRunning() || runner_->pipeline.isRunning() || runner_->targets.isRunning() ||
         runner_->coarse.isRunning();
}

void EditorSession::setSideWork(const QObject* panel, bool busy, bool isShown) {
  if (busy)
    sideWork_.insert(panel, isShown);
  else
    sideWork_.remove(panel);
  runner_->updateBusy();
}

void EditorSession::selectCurve(std::optional<int> index) {
  if (!curveAt(index)) index.reset();
  runner_->selectsItself = false;
  runner_->anchorPx.reset();
  if (const auto piece = pieceOf(*this, index)) runner_->anchorPx = anchorOf(output_.pieces->pieces[*piece]);
  if (index == selectedCurve_) return;
  selectedCurve_ = index;
  setCursor(std::nullopt);
  pointedSpan_.reset();
  targets_.reset();
  emit selectionChanged();
  emit targetsChanged();
  runner_->computeTargets();
}

void EditorSession::selectCorner(std::optional<int> mark) {
  if (mark && (*mark < 0 || *mark >= std::ssize(recipe_.cornerMarks))) mark.reset();
  if (mark == selectedCorner_) return;
  selectedCorner_ = mark;
  emit cornerSelectionChanged();
}

void EditorSession::keepCornerSelection(const std::vector<CornerMark>& after) {
  const auto& before = recipe_.cornerMarks;
  // As many as before: the selected one may have moved. Else it is where it was, or it has gone.
  if (!selectedCorner_ || after.size() == before.size()) return;
  const Vec2 place = before[*selectedCorner_].positionPx;
  const auto found =
      std::find_if(after.begin(), after.end(), [&](const CornerMark& mark) { return mark.positionPx == place; });
  selectedCorner_.reset();
  if (found != after.end()) selectedCorner_ = static_cast<int>(found - after.begin());
}

void EditorSession::selectNear(const Vec2& px) {
  runner_->selectsItself = false;
  runner_->anchorPx = px;
}

void EditorSession::pin() {
  // While a run is under way its first stages stand beside the last ones of the run before.
  if (!output_.faired || !output_.pieces || isStale(StageId::Faired)) return;
  pinned_ = std::make_shared<const PinnedResult>(PinnedResult{output_.faired, output_.pieces, output_.frame, recipe_});
  emit pinChanged();
}

void EditorSession::unpin() {
  if (!pinned_) return;
  pinned_.reset();
  emit pinChanged();
}

const TracedCurve* EditorSession::pinnedOf(std::optional<int> curve) const {
  const auto piece = pieceOf(*this, curve);
  if (!pinned_ || !piece) return nullptr;
  const Vec2 anchor = anchorOf(output_.pieces->pieces[*piece]);
  const TracedCurve* nearest = nullptr;
  double best = kSamePlacePx * kSamePlacePx;
  for (const TracedCurve& candidate : pinned_->faired->curves) {
    for (const PiecePoint& p : pinned_->pieces->pieces[candidate.piece].points) {
      if (const double d = (p.at - anchor).squaredNorm(); d < best) best = d, nearest = &candidate;
    }
  }
  return nearest;
}

void EditorSession::pointAtSpan(std::optional<double> share) {
  if (share && !(*share >= 0.0 && *share <= 1.0)) share.reset();
  if (share == pointedSpan_) return;
  pointedSpan_ = share;
  // Those of the span before would be read as those of this one.
  targets_.reset();
  emit targetsChanged();
  runner_->computeTargets();
}

void EditorSession::hoverTarget(std::optional<int> degree) {
  if (degree && !isTargetDegree(*degree)) degree.reset();
  if (degree == hoveredTarget_) return;
  hoveredTarget_ = degree;
  emit hoverChanged();
}

void EditorSession::setCursor(std::optional<double> sMm) {
  if (sMm && !std::isfinite(*sMm)) sMm.reset();
  if (sMm == cursorMm_) return;
  cursorMm_ = sMm;
  emit cursorChanged();
}

}  // namespace batten
