// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ui/session/background/background_worker.h"
#include "ui/session/background/discarded_values.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"
#include "ui/session/files/opened_scan.h"
#include "ui/session/runs/coarse_runner.h"
#include "ui/session/runs/overtaken_runs.h"
#include "ui/session/runs/target_runner.h"

namespace batten {

/// The background side of a session. Jobs hold values only (scan, recipe, the shared cache) and post their results to
/// `inbox`, which lives in the GUI thread; everything else here belongs to the GUI thread.
struct EditorSession::Runner {
  explicit Runner(EditorSession&);

  /// @param recipe to open with, whatever lies beside the scan; `isRestored`: it was never saved.
  void read(const QString& path, const std::optional<PageChoice>& page, const std::optional<Recipe>& recipe,
            bool isRestored = true);
  void begin(const Recipe&, bool isRestored);
  void run();
  void computeTargets();
  void dropTargets();
  void stopAll();
  void updateBusy();
  void fail(const Error& error, FailureOrigin origin);
  void clearFailure();

  EditorSession& session;
  Inbox inbox;
  StageCache cache;
  QString path, openProblem;
  CurveNumbers numbers;                      ///< Apart from the recipe, as no undo takes them back.
  std::optional<Rectification> numbersPage;  ///< Of which page of the picture their places are,
  bool areNumbersOfWantedPage = false;       ///< or of the one that the recipe makes, which is yet to be found.
  /// Numbers that came with this recipe.
  void takeNumbers(CurveNumbers, const Recipe&);
  bool openedWithRecipe = false, wasRestored = false;

  std::uint64_t recipeGeneration = 1;                           ///< Counts changes of recipe or scan.
  std::array<std::uint64_t, kStages.size()> shownGeneration{};  ///< Which of them each shown output belongs to.
  std::uint64_t newestRun = 0, newestRead = 0;
  bool isRunning = false, isReading = false, isStopped = false;
  bool wasBusy = false, wasWorking = false, hasRunFailure = false, edgesWanted = false, targetsWanted = true;
  bool selectsItself = true;  ///< Until the user selects: the longest curve.
  std::optional<Vec2> anchorPx;

  CancelToken newestToken;
  OvertakenRuns overtaken;

  /// Last, so that they are stopped and joined before anything they use goes away.
  CoarseRunner coarse;
  TargetRunner targets;
  ContentHash inkKey, shownInkKey;  ///< Of the ink asked for and of the one shown, to know whether it changes.
  DiscardedValues discarded;
  BackgroundWorker reader, pipeline;

 private:
  struct Job;
  using ScanJob = std::function<Result<OpenedScan>(const CancelToken&)>;
  void open(const QString& scanPath, bool isRestored, ScanJob job);
  void adopt(OpenedScan opened, const QString& scanPath, bool isRestored);
  void applyScan(std::uint64_t id, const QString& scanPath, bool isRestored,
                 const std::shared_ptr<Result<OpenedScan>>& result);
  /// Of the page that is shown; the stages in the cache stay.
  void dropResults(std::vector<std::shared_ptr<const void>> stages = {});
  void announceNothingSelected();
  void applyPage(const std::shared_ptr<const Scan>& picture, std::shared_ptr<const Scan> page,
                 std::uint64_t generation);
  void applyStage(const std::shared_ptr<const Scan>&, std::uint64_t generation, StageId, const PipelineOutput&);
  void applyEnd(const std::shared_ptr<const Scan>&, std::uint64_t generation, std::uint64_t runId,
                const PipelineOutput&, double milliseconds);
  void applyTargets(std::shared_ptr<const TargetOutcomes> outcomes);
  void runCoarse();
  void dropCoarse(std::uint64_t generation);
  void applyCoarse(const std::shared_ptr<const Scan>&, std::shared_ptr<const CoarseResult>);
  void curvesChanged();
};

}  // namespace batten
