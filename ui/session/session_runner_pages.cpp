// SPDX-License-Identifier: GPL-3.0-or-later
// Which page the session shows: opened, begun empty, or brought by a run that rectified it.
#include <algorithm>
#include <utility>

#include "core/base/conventions.h"
#include "ui/session/background/guarded.h"
#include "ui/session/files/path_text.h"
#include "ui/session/session_runner.h"

namespace batten {
namespace {

/// [bytes] Of the outputs that are kept: the prepared page at two bytes a pixel, and masks and lines of a few runs, so
/// that undoing finds them. Every value that a slider passes leaves some, too, which nobody asks for again.
std::size_t cacheBytes(const Scan& scan) {
  // that are kept at most; of small pages so many
  constexpr std::size_t kBytesPerPixel = 2, kLeastBytes = std::size_t{64} << 20;
  return std::max(kLeastBytes, kBytesPerPixel * scan.grey.width * scan.grey.height);
}

}  // namespace

void EditorSession::Runner::open(const QString& scanPath, bool isRestored, ScanJob job) {
  const auto id = ++newestRead;
  isReading = true;
  reader.start([this, id, scanPath, isRestored, job = std::move(job)](const CancelToken& token) {
    auto result = std::make_shared<Result<OpenedScan>>(guarded<OpenedScan>([&] { return job(token); }));
    inbox.post([this, id, scanPath, isRestored, result] { applyScan(id, scanPath, isRestored, result); });
  });
  updateBusy();
}

void EditorSession::Runner::read(const QString& scanPath, const std::optional<PageChoice>& page,
                                 const std::optional<Recipe>& recipe, bool isRestored) {
  const Recipe& start = session.startRecipe_;
  open(scanPath, recipe && isRestored, [scanPath, page, recipe, isRestored, start](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto opened = openWithRecipe(nativePath(scanPath), recipe ? std::optional(recipe->scanPage) : page, context);
    if (opened && !opened->hasRecipe) {
      const PageChoice of = opened->recipe.scanPage;
      opened->recipe = start;
      opened->recipe.scanPage = of;
    }
    if (opened && recipe) {
      opened->recipe = *recipe;
      opened->hasRecipe = opened->hasRecipe || !isRestored;
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

void EditorSession::Runner::dropResults(std::vector<std::shared_ptr<const void>> stages) {
  targets.stop();
  coarse.cancel();
  struct Old {
    std::shared_ptr<const Scan> picture, scan;
    PipelineOutput output;
    std::shared_ptr<const PinnedResult> pinned;
    std::vector<std::shared_ptr<const void>> stages;
  };
  discarded.discard(
      std::make_shared<const Old>(Old{session.picture_, std::move(session.scan_), std::exchange(session.output_, {}),
                                      std::move(session.pinned_), std::move(stages)}));
  session.pinned_.reset();
  session.selectedCurve_.reset();
  session.pointedSpan_.reset();
  session.targets_.reset();
  session.coarse_.reset();
  shownInkKey = {};
  session.cursorMm_.reset();
  session.hoveredTarget_.reset();
  anchorPx.reset();
  selectsItself = true;
  shownGeneration.fill(0);
}

void EditorSession::Runner::announceNothingSelected() {
  emit session.selectionChanged();
  emit session.cornerSelectionChanged();
  emit session.targetsChanged();
  emit session.cursorChanged();
  emit session.pinChanged();
}

void EditorSession::Runner::adopt(OpenedScan opened, const QString& scanPath, bool isRestored) {
  pipeline.cancelAll();
  isStopped = false;
  dropResults(cache.release());  // the cache belongs to the next drawing from here on
  session.picture_ = session.scan_ = std::make_shared<const Scan>(std::move(opened.scan));
  cache.setLimit(cacheBytes(*session.scan_));
  path = scanPath;
  openedWithRecipe = opened.hasRecipe;
  wasRestored = isRestored;
  openProblem = QString::fromStdString(opened.problem).simplified();
  session.recipe_ = std::move(opened.recipe);
  takeNumbers(std::exchange(session.recipe_.curveNumbers, {}), session.recipe_);
  session.output_.frame = frameFor(*session.scan_, session.recipe_);
  session.selectedCorner_.reset();
  ++recipeGeneration;
  session.undo_.clear();
  session.saved_ = session.recipe_;
  if (isRestored) {
    session.saved_.reset();
    session.undo_.resetClean();
  }
  clearFailure();
  emit session.scanOpened();
  emit session.recipeChanged();
  announceNothingSelected();
  run();
}

void EditorSession::Runner::applyPage(const std::shared_ptr<const Scan>& picture, std::shared_ptr<const Scan> page,
                                      std::uint64_t generation) {
  if (picture != session.picture_ || page == session.scan_ || generation != recipeGeneration) return;
  // What was found on the page before does not lie on this one. The cache stays: the run that brings this page is
  // filling it, and going back finds the page before in it.
  dropResults();
  session.scan_ = std::move(page);
  cache.setLimit(cacheBytes(*session.scan_));
  session.output_.frame = frameFor(*session.scan_, session.recipe_);
  emit session.pageChanged();
  emit session.recipeChanged();
  announceNothingSelected();
  runCoarse();
}

void EditorSession::Runner::takeNumbers(CurveNumbers brought, const Recipe& recipe) {
  numbers = std::move(brought);
  numbersPage.reset();
  const RectifyParams& params = recipe.preparation.rectify;
  areNumbersOfWantedPage = params.use == RectifyUse::Automatic;
  if (params.use != RectifyUse::Corners || !session.picture_) return;
  if (auto made = rectificationOf(*session.picture_, params.cornersPx, params.format)) numbersPage = std::move(*made);
}

}  // namespace batten
