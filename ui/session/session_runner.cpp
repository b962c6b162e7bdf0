// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/session_runner.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/base/conventions.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/stage_keys.h"
#include "ui/session/guarded.h"
#include "ui/session/path_text.h"

namespace batten {
namespace {

/// Of its length: a curve that is longer or shorter by more is another one.
constexpr double kOtherCurve = 0.2;

/// Puts the outputs up to `last` of a run over the shown ones; later stages keep what they have.
void mergeOutputs(PipelineOutput& shown, const PipelineOutput& run, StageId last) {
  const auto take = [last](StageId stage, auto& to, const auto& from) {
    if (stage <= last) to = from;
  };
  take(StageId::Thresholds, shown.page, run.page);
  take(StageId::Thresholds, shown.thresholds, run.thresholds);
  take(StageId::Binary, shown.binary, run.binary);
  take(StageId::Filtered, shown.filtered, run.filtered);
  take(StageId::Edges, shown.edges, run.edges);
  take(StageId::Contours, shown.contours, run.contours);
  take(StageId::Pieces, shown.pieces, run.pieces);
  take(StageId::Segments, shown.segments, run.segments);
  take(StageId::Curves, shown.constructed, run.constructed);
  take(StageId::Faired, shown.faired, run.faired);
  if (shown.frame != run.frame) {
    // Curves in millimetres of another frame would be drawn at the wrong place.
    if (last < StageId::Curves) shown.constructed.reset();
    if (last < StageId::Faired) shown.faired.reset();
    shown.frame = run.frame;
  }
  // The numbers belong to the curves shown: curves of the run before keep theirs until the new ones are there.
  if (last == StageId::Faired || (run.numbers && !shown.faired)) shown.numbers = run.numbers;
  shown.timing = run.timing;
  shown.error = run.error;
  shown.failedStage = run.failedStage;
}

double squaredDistance(const Piece& piece, const Vec2& place) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2& point : piece.points) best = std::min(best, (point - place).squaredNorm());
  return best;
}

}  // namespace

EditorSession::Runner::Runner(EditorSession& owner)
    : session(owner), coarse(inbox, [this](const auto& scan, auto result) { applyCoarse(scan, std::move(result)); }) {
  clock.start();
  grace.setSingleShot(true);
  QObject::connect(&grace, &QTimer::timeout, &inbox, [this] { stopOvertaken(); });
}

void EditorSession::Runner::open(const QString& scanPath, bool isRestored, ScanJob job) {
  const auto id = ++newestRead;
  isReading = true;
  reader.start([this, id, scanPath, isRestored, job = std::move(job)](const CancelToken& token) {
    auto result = std::make_shared<Result<OpenedScan>>(guarded<OpenedScan>([&] { return job(token); }));
    QMetaObject::invokeMethod(
        &inbox, [this, id, scanPath, isRestored, result] { applyScan(id, scanPath, isRestored, result); },
        Qt::QueuedConnection);
  });
  updateBusy();
}

void EditorSession::Runner::read(const QString& scanPath, const std::optional<PageChoice>& page,
                                 const std::optional<Recipe>& restored) {
  const Recipe& start = session.startRecipe_;
  open(scanPath, restored.has_value(), [scanPath, page, restored, start](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto opened = openWithRecipe(nativePath(scanPath), restored ? std::optional(restored->scanPage) : page, context);
    if (opened && !opened->hasRecipe) {
      const PageChoice of = opened->recipe.scanPage;
      opened->recipe = start;
      opened->recipe.scanPage = of;
    }
    if (opened && restored) {
      opened->recipe = *restored;
      opened->problem.clear();
    }
    return opened;
  });
}

void EditorSession::Runner::begin(const Recipe& recipe, bool isRestored) {
  // A large page is some hundred megabytes of white.
  open({}, isRestored, [recipe](const CancelToken&) -> Result<OpenedScan> {
    const BlankPage page = *recipe.page;
    Scan scan = blankScan(page.widthPx, page.heightPx, recipe.dpi.value_or(kAssumedDpi));
    return OpenedScan{std::move(scan), recipe, false, {}};
  });
}

void EditorSession::Runner::applyScan(std::uint64_t id, const QString& scanPath, bool isRestored,
                                      const std::shared_ptr<Result<OpenedScan>>& result) {
  if (id != newestRead) return;
  isReading = false;
  if (!result->has_value()) {
    if (result->error().code != ErrorCode::Cancelled) fail(result->error(), FailureOrigin::OpenScan);
    updateBusy();
    return;
  }
  adopt(std::move(**result), scanPath, isRestored);
}

void EditorSession::Runner::dropOldDrawing() {
  struct Old {
    std::shared_ptr<const Scan> scan;
    PipelineOutput output;
    std::shared_ptr<const PinnedResult> pinned;
    std::vector<std::shared_ptr<const void>> stages;
  };
  // The stages are handed over: the cache belongs to the next drawing from here on.
  discarded.discard(std::make_shared<const Old>(
      Old{std::move(session.scan_), std::exchange(session.output_, {}), std::move(session.pinned_), cache.release()}));
}

void EditorSession::Runner::adopt(OpenedScan opened, const QString& scanPath, bool isRestored) {
  pipeline.cancelAll();
  targeting.cancelAll();
  coarse.cancel();
  ++newestTargets;
  isTargeting = isStopped = false;
  dropOldDrawing();
  session.scan_ = std::make_shared<const Scan>(std::move(opened.scan));
  path = scanPath;
  openedWithRecipe = opened.hasRecipe;
  wasRestored = isRestored;
  openProblem = QString::fromStdString(opened.problem).simplified();
  session.recipe_ = std::move(opened.recipe);
  numbers = std::exchange(session.recipe_.curveNumbers, {});
  session.output_.frame = frameFor(*session.scan_, session.recipe_);
  session.pinned_.reset();
  session.selectedCurve_ = session.selectedCorner_ = -1;
  session.pointedSpan_.reset();
  session.targets_.reset();
  session.coarse_.reset();
  shownInkKey = {};
  session.cursorMm_.reset();
  session.hoveredTarget_ = 0;
  targetsCurve.reset();
  anchorPx.reset();
  selectsItself = true;
  shownGeneration.fill(0);
  ++recipeGeneration;
  session.undo_.clear();
  if (isRestored) session.undo_.resetClean();
  clearFailure();
  emit session.scanOpened();
  emit session.recipeChanged();
  emit session.selectionChanged();
  emit session.cornerSelectionChanged();
  emit session.targetsChanged();
  emit session.cursorChanged();
  emit session.pinChanged();
  run();
}

void EditorSession::Runner::run() {
  if (!session.scan_) return;
  const auto runId = ++newestRun;
  isRunning = true;
  isStopped = false;
  const qint64 started = startedMs.load();
  const bool spare = started >= 0 && clock.elapsed() - started < kGraceMs;
  overtaken.push_back(newestToken);
  auto job = [this, runId, generation = recipeGeneration, scan = session.scan_, recipe = session.recipeToSave(),
              edges = edgesWanted](const CancelToken& token) {
    const qint64 begin = clock.elapsed();
    startedMs = begin;
    RunContext context;
    context.cancel = token;
    std::atomic<int> stagesDone{0}, lastPercent{-1};
    context.progress = [&, this](double fraction) {
      const int percent = static_cast<int>(100.0 * (stagesDone + std::clamp(fraction, 0.0, 1.0)) / kStages.size());
      if (lastPercent.exchange(percent) == percent) return;
      QMetaObject::invokeMethod(
          &inbox,
          [this, runId, percent] {
            if (runId == newestRun && isRunning) emit session.progress(percent / 100.0);
          },
          Qt::QueuedConnection);
    };
    PipelineRequest request;
    request.needEdges = edges;
    request.stageReady = [&, this](StageId stage, const PipelineOutput& soFar) {
      stagesDone = static_cast<int>(stage) + 1;
      if (token.isCancelled()) return;
      QMetaObject::invokeMethod(
          &inbox, [this, scan, generation, stage, soFar] { applyStage(scan, generation, stage, soFar); },
          Qt::QueuedConnection);
    };
    PipelineOutput output;
    if (auto done = guarded<PipelineOutput>(
            [&] { return Result<PipelineOutput>(runPipeline(*scan, recipe, cache, request, context)); }))
      output = std::move(*done);
    else
      output.error = done.error();
    const double milliseconds = static_cast<double>(clock.elapsed() - begin);
    startedMs = -1;
    QMetaObject::invokeMethod(
        &inbox,
        [this, scan, generation, runId, output, milliseconds] {
          applyEnd(scan, generation, runId, output, milliseconds);
        },
        Qt::QueuedConnection);
  };
  newestToken = pipeline.start(std::move(job), BackgroundWorker::Running::Finish);
  if (!spare)
    stopOvertaken();
  else if (!grace.isActive())
    grace.start(static_cast<int>(kGraceMs - (clock.elapsed() - started)));
  updateBusy();
  runCoarse();
}

void EditorSession::Runner::runCoarse() {
  inkKey = stageKeys(*session.scan_, session.recipe_, session.output_.frame)[StageId::Filtered];
  const bool hasCurves = !session.curves().empty();
  if (hasCurves && inkKey == shownInkKey) return;
  coarse.start({session.scan_, session.recipe_, recipeGeneration, !hasCurves});
}

void EditorSession::Runner::applyCoarse(const std::shared_ptr<const Scan>& scan,
                                        std::shared_ptr<const CoarseResult> result) {
  if (scan != session.scan_ || result->generation <= shownGeneration[indexOf(StageId::Faired)]) return;
  session.coarse_ = std::move(result);
  emit session.coarseReady();
}

void EditorSession::Runner::stopOvertaken() {
  const qint64 started = startedMs.load();
  const qint64 elapsed = clock.elapsed() - started;
  if (started >= 0 && elapsed < kGraceMs) {
    grace.start(static_cast<int>(kGraceMs - elapsed));
    return;
  }
  for (const CancelToken& token : overtaken) token.cancel();
  overtaken.clear();
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
  overtaken.clear();
  if (!wasCancelled) {
    // Only of runs that no newer one has overtaken: a drag does not use up a number for every line it comes past.
    if (output.numbers) numbers = output.numbers->known;
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
  const int before = session.selectedCurve_;
  int index = -1;
  if (selectsItself) {
    double longest = -1.0;
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i].included && curves[i].sketchedFigures.lengthMm > longest) {
        longest = curves[i].sketchedFigures.lengthMm;
        index = static_cast<int>(i);
      }
  } else if (anchorPx && session.output_.pieces) {
    const auto& pieces = session.output_.pieces->pieces;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const auto piece = static_cast<std::size_t>(curves[i].piece);
      if (piece >= pieces.size()) continue;
      const double distance = squaredDistance(pieces[piece], *anchorPx);
      if (distance < nearest) nearest = distance, index = static_cast<int>(i);
    }
  }
  if (index != before) session.pointedSpan_.reset();
  session.selectedCurve_ = index;
  const TracedCurve* now = session.selected();
  const bool isKnown = now != nullptr && targetsCurve && *targetsCurve == now->sketched;
  const bool areOfAnother = index != before && session.targets_ && !isKnown;
  if (areOfAnother) {
    session.targets_.reset();
    targetsCurve.reset();
  }
  if (index != before) emit session.selectionChanged();
  if (areOfAnother) emit session.targetsChanged();
  // Stages that were done when Esc was pressed still arrive: they begin nothing new.
  if (!isStopped) computeTargets();
}

void EditorSession::Runner::computeTargets() {
  const TracedCurve* curve = session.selected();
  if (curve == nullptr || curve->sketched.isEmpty()) {
    targeting.cancelAll();
    ++newestTargets;
    targetsCurve.reset();
    isTargeting = false;
    updateBusy();
    if (session.targets_) {
      session.targets_.reset();
      emit session.targetsChanged();
    }
    return;
  }
  // The chosen mode and target do not change the six outcomes.
  FairingParams params = curve->fairingUsed;
  params.mode = FairingMode::None;
  params.target = FairingTarget::Recommended;
  params.lowPassMm = FairingParams{}.lowPassMm;
  params.keepExtrema = kKeepSignificant;
  params.keptAt.clear();
  params.profile.clear();
  params.spanTargets.clear();
  const auto span = session.pointedSpan_;
  if (targetsCurve && *targetsCurve == curve->sketched && targetsParams == params && targetsSpan == span) return;
  targetsCurve = curve->sketched;
  targetsParams = params;
  targetsSpan = span;
  const auto id = ++newestTargets;
  isTargeting = true;
  // While one curve changes, its last outcomes stay; another curve's would be read as this one's.
  const double length = curve->sketchedFigures.lengthMm;
  if (session.targets_ && std::abs(length - targetsLengthMm) > kOtherCurve * std::max(length, targetsLengthMm)) {
    session.targets_.reset();
    emit session.targetsChanged();
  }
  if (!session.isStale(StageId::Faired)) isStopped = false;
  targeting.start([this, id, job = *curve, span](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto result = guarded<TargetOutcomes>([&] { return targetsFor(job, context, span); });
    if (!result && result.error().code == ErrorCode::Cancelled) return;
    std::shared_ptr<const TargetOutcomes> outcomes;
    if (result) outcomes = std::make_shared<const TargetOutcomes>(std::move(*result));
    QMetaObject::invokeMethod(
        &inbox, [this, id, outcomes, length = job.sketchedFigures.lengthMm] { applyTargets(id, outcomes, length); },
        Qt::QueuedConnection);
  });
  updateBusy();
}

void EditorSession::Runner::applyTargets(std::uint64_t id, std::shared_ptr<const TargetOutcomes> outcomes,
                                         double lengthMm) {
  if (id != newestTargets) return;
  session.targets_ = std::move(outcomes);
  targetsLengthMm = lengthMm;
  isTargeting = false;
  emit session.targetsChanged();
  updateBusy();
}

void EditorSession::Runner::stopAll() {
  pipeline.cancelAll();
  coarse.cancel();
  reader.cancelAll();
  targeting.cancelAll();
  overtaken.clear();
  ++newestRead;
  const bool ran = isRunning;
  if (ran) ++newestRun;  // What a stopped run still reports is no longer the newest.
  if (isTargeting) {
    ++newestTargets;
    targetsCurve.reset();
  }
  const auto& side = session.sideWork_;
  if (ran || isTargeting || std::find(side.begin(), side.end(), true) != side.end()) isStopped = true;
  isRunning = isReading = isTargeting = false;
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
