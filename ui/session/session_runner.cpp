// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/session_runner.h"

#include <QElapsedTimer>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/base/conventions.h"
#include "core/base/platform_memory.h"
#include "core/pipeline/recipe/recipe_places.h"
#include "core/pipeline/run/stage_keys.h"
#include "ui/session/background/guarded.h"
#include "ui/session/curve_piece.h"
#include "ui/session/files/path_text.h"
#include "ui/session/runs/merge_outputs.h"

namespace batten {
namespace {

/// The page that the recipe wants: the one that is shown, or another one of the picture.
Result<std::shared_ptr<const Scan>> pageOf(const std::shared_ptr<const Scan>& shown,
                                           const std::shared_ptr<const Scan>& picture, const Recipe& recipe,
                                           const RunContext& context) {
  const RectifyParams& params = recipe.preparation.rectify;
  if (isRectifiedAs(*shown, params)) return shown;
  if (isRectifiedAs(*picture, params)) return picture;
  auto page = rectified(*picture, params, context);
  if (!page) return fail(page.error());
  return std::make_shared<const Scan>(std::move(*page));
}

double squaredDistance(const Piece& piece, const Vec2& place) {
  double best = std::numeric_limits<double>::infinity();
  for (const PiecePoint& point : piece.points) best = std::min(best, (point.at - place).squaredNorm());
  return best;
}

}  // namespace

EditorSession::Runner::Runner(EditorSession& owner)
    : session(owner),
      coarse(inbox, [this](const auto& scan, auto result) { applyCoarse(scan, std::move(result)); }),
      targets(inbox, [this](auto outcomes) { applyTargets(std::move(outcomes)); }) {}

void EditorSession::Runner::run() {
  if (!session.scan_) return;
  const auto runId = ++newestRun;
  isRunning = true;
  isStopped = false;
  overtaken.add(newestToken);
  auto job = [this, runId, generation = recipeGeneration, shown = session.scan_, picture = session.picture_,
              saved = session.recipeToSave(), page = numbersPage, isOfWanted = areNumbersOfWantedPage,
              edges = edgesWanted](const CancelToken& token) {
    QElapsedTimer clock;
    clock.start();
    overtaken.runBegins();
    RunContext context;
    context.cancel = token;
    Recipe recipe = saved;
    auto wanted = guarded<std::shared_ptr<const Scan>>([&] { return pageOf(shown, picture, recipe, context); });
    const std::shared_ptr<const Scan> scan = wanted ? *wanted : shown;
    if (!isOfWanted) recipe.curveNumbers = rectifiedNumbers(std::move(recipe.curveNumbers), page, scan->rectification);
    if (wanted && scan != shown)
      inbox.post([this, picture, scan, generation] { applyPage(picture, scan, generation); });
    std::atomic<int> stagesDone{0}, lastPercent{-1};
    context.progress = [&, this](double fraction) {
      const int percent = static_cast<int>(100.0 * (stagesDone + std::clamp(fraction, 0.0, 1.0)) / kStages.size());
      if (lastPercent.exchange(percent) == percent) return;
      inbox.post([this, runId, percent] {
        if (runId == newestRun && isRunning) emit session.progress(percent / 100.0);
      });
    };
    PipelineRequest request;
    request.needEdges = edges;
    request.stageReady = [&, this](StageId stage, const PipelineOutput& soFar) {
      stagesDone = static_cast<int>(stage) + 1;
      if (token.isCancelled()) return;
      inbox.post([this, scan, generation, stage, soFar] { applyStage(scan, generation, stage, soFar); });
    };
    PipelineOutput output;
    output.frame = frameFor(*scan, recipe);
    if (!wanted)
      output.error = wanted.error();
    else if (auto done = guarded<PipelineOutput>(
                 [&] { return Result<PipelineOutput>(runPipeline(*scan, recipe, cache, request, context)); }))
      output = std::move(*done);
    else
      output.error = done.error();
    const double milliseconds = static_cast<double>(clock.elapsed());
    overtaken.runEnds();
    // A run that was overtaken makes room for the next one at once, which takes the memory again.
    if (!token.isCancelled()) returnFreeMemory();
    inbox.post([this, scan, generation, runId, output, milliseconds] {
      applyEnd(scan, generation, runId, output, milliseconds);
    });
  };
  newestToken = pipeline.start(std::move(job), BackgroundWorker::Running::Finish);
  updateBusy();
  runCoarse();
}

void EditorSession::Runner::runCoarse() {
  if (!isRectifiedAs(*session.scan_, session.recipe_.preparation.rectify)) return;  // begins with the page
  inkKey = stageKeys(*session.scan_, session.recipe_, session.output_.frame)[StageId::Filtered];
  const bool hasCurves = !session.curves().empty();
  if (hasCurves && inkKey == shownInkKey) return;
  coarse.start({session.scan_, session.recipe_, recipeGeneration, !hasCurves});
}

void EditorSession::Runner::applyCoarse(const std::shared_ptr<const Scan>& scan,
                                        std::shared_ptr<const CoarseResult> result) {
  if (scan != session.scan_ || result->generation <= shownGeneration[indexOf(StageId::Faired)]) return;
  session.coarse_ = std::move(result);
  if (session.coarse_->generation == recipeGeneration) overtaken.newerInkIsSeen(!session.curves().empty());
  emit session.coarseReady();
}

void EditorSession::Runner::applyStage(const std::shared_ptr<const Scan>& scan, std::uint64_t generation, StageId stage,
                                       const PipelineOutput& soFar) {
  if (scan != session.scan_) return;
  mergeOutputs(session.output_, soFar, stage);
  for (const StageId done : kStages)
    if (done <= stage) shownGeneration[indexOf(done)] = generation;
  if (generation == recipeGeneration && stage == StageId::Filtered) shownInkKey = inkKey;
  if (stage == StageId::Faired) dropCoarse(generation);
  if (stage == StageId::Faired || (stage == StageId::Curves && !session.output_.faired)) curvesChanged();
  emit session.stageReady(stage);
}

void EditorSession::Runner::dropCoarse(std::uint64_t generation) {
  if (session.coarse_ && session.coarse_->generation <= generation) session.coarse_.reset();
}

void EditorSession::Runner::applyEnd(const std::shared_ptr<const Scan>& scan, std::uint64_t generation,
                                     std::uint64_t runId, const PipelineOutput& output, double milliseconds) {
  if (scan != session.scan_) return;
  const bool wasCancelled = output.error && output.error->code == ErrorCode::Cancelled;
  if (!wasCancelled) {
    session.lastRunMs_ = milliseconds;
    mergeOutputs(session.output_, output, StageId::Faired);
    shownGeneration.fill(generation);
    dropCoarse(generation);
    if (output.error) {
      // What lies beyond the failure does not belong to this recipe: show none rather than the old.
      curvesChanged();
      for (const StageId stage : kStages)
        if (!output.failedStage || stage >= *output.failedStage) emit session.stageReady(stage);
    }
  }
  if (runId != newestRun) return;
  isRunning = false;
  overtaken.forget();
  if (!wasCancelled) {
    // Only of runs that no newer one has overtaken: a drag does not use up a number for every line it comes past.
    if (output.numbers) {
      numbers = output.numbers->known;
      numbersPage = scan->rectification;
      areNumbersOfWantedPage = false;
    }
    // An empty page is not a failure, it is a beginning.
    const bool isBeginning =
        session.isBlankPage() && session.recipe_.penStrokes.empty() && session.recipe_.imports.empty();
    if (output.error && !isBeginning)
      fail(*output.error, FailureOrigin::Run);
    else
      clearFailure();
  }
  updateBusy();
  emit session.runFinished();
}

void EditorSession::Runner::curvesChanged() {
  const auto curves = session.curves();
  const auto before = session.selectedCurve_;
  std::optional<int> index;
  if (selectsItself) {
    std::optional<double> longest;
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (const double length = curves[i].sketchedFigures.lengthMm;
          curves[i].included && (!longest || length > *longest)) {
        longest = length;
        index = static_cast<int>(i);
      }
  } else if (anchorPx && session.output_.pieces) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < std::ssize(curves); ++i) {
      const auto piece = pieceOf(session, i);
      if (!piece) continue;
      const double distance = squaredDistance(session.output_.pieces->pieces[*piece], *anchorPx);
      if (distance < nearest) nearest = distance, index = i;
    }
  }
  if (index != before) session.pointedSpan_.reset();
  session.selectedCurve_ = index;
  const TracedCurve* now = session.selected();
  const bool isKnown = now != nullptr && targets.isOf(*now);
  const bool areOfAnother = index != before && session.targets_ && !isKnown;
  if (areOfAnother) {
    session.targets_.reset();
    targets.forget();
  }
  if (index != before) emit session.selectionChanged();
  if (areOfAnother) emit session.targetsChanged();
  // Stages that were done when Esc was pressed still arrive: they begin nothing new.
  if (!isStopped) computeTargets();
}

void EditorSession::Runner::dropTargets() {
  if (!session.targets_) return;
  session.targets_.reset();
  emit session.targetsChanged();
}

void EditorSession::Runner::computeTargets() {
  const TracedCurve* curve = session.selected();
  if (!targetsWanted) {
    if (curve == nullptr || !targets.isOf(*curve)) dropTargets();  // those of another curve are not kept for later
    return;
  }
  if (curve == nullptr || curve->sketched.isEmpty()) {
    targets.stop();
    updateBusy();
    dropTargets();
    return;
  }
  if (!targets.start(*curve, session.pointedSpan_)) return;
  // While one curve changes, its last outcomes stay; another curve's would be read as this one's.
  if (targets.isLikeAnother(*curve)) dropTargets();
  if (!session.isStale(StageId::Faired)) isStopped = false;
  updateBusy();
}

void EditorSession::Runner::applyTargets(std::shared_ptr<const TargetOutcomes> outcomes) {
  session.targets_ = std::move(outcomes);
  emit session.targetsChanged();
  updateBusy();
}

void EditorSession::Runner::stopAll() {
  pipeline.cancelAll();
  coarse.cancel();
  reader.cancelAll();
  const bool wasTargeting = targets.isComputing();
  targets.cancel();
  overtaken.forget();
  ++newestRead;
  const bool ran = isRunning;
  if (ran) ++newestRun;  // What a stopped run still reports is no longer the newest.
  const auto& side = session.sideWork_;
  if (ran || wasTargeting || std::find(side.begin(), side.end(), true) != side.end()) isStopped = true;
  isRunning = isReading = false;
  session.sideWork_.clear();
  emit session.stopped();
  updateBusy();
  if (ran) emit session.runFinished();
}

void EditorSession::Runner::updateBusy() {
  const bool busy = session.isBusy(), working = session.isWorking();
  if (std::exchange(wasBusy, busy) != busy) emit session.busyChanged(busy);
  if (std::exchange(wasWorking, working) != working) emit session.workingChanged(working);
}

void EditorSession::Runner::fail(const Error& error, FailureOrigin origin) {
  hasRunFailure = hasRunFailure || origin == FailureOrigin::Run;
  emit session.failed(error, origin);
}

void EditorSession::Runner::clearFailure() {
  if (!hasRunFailure) return;
  hasRunFailure = false;
  emit session.failureCleared();
}

}  // namespace batten
