// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/pipeline/run/pipeline.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

/// What a run on a smaller page has found, to be looked at until the full one is there.
struct CoarseResult {
  int factor = 1;  ///< One px of its ink covers factor x factor px of the page.
  std::shared_ptr<const BitImage> binary;
  std::shared_ptr<const FilteredImage> filtered;
  std::shared_ptr<const FairedSet> faired;  ///< Null unless curves were asked for.
  PageFrame frame;                          ///< In which its curves lie on the full page.
  std::uint64_t generation = 0;             ///< Of the recipe and scan that it belongs to.
};

/// Runs the pipeline on a page made smaller (coarse_run.h), beside the full run and much sooner done. Belongs to the
/// GUI thread; the newest request follows the one that runs, so that a drag shows results while it goes on.
class CoarseRunner {
 public:
  /// `show` is called in the GUI thread with each result, as long as `inbox` lives.
  using Show = std::function<void(const std::shared_ptr<const Scan>&, std::shared_ptr<const CoarseResult>)>;
  CoarseRunner(Inbox& inbox, Show show) : inbox_(inbox), show_(std::move(show)) {}

  struct Request {
    std::shared_ptr<const Scan> scan;
    Recipe recipe;
    std::uint64_t generation = 0;
    bool withCurves = false;  ///< Else the ink alone.
  };
  /// Nothing happens for a page that is small enough.
  void start(Request request);
  void cancel() { worker_.cancelAll(); }
  bool isRunning() const { return worker_.isRunning(); }

 private:
  void run(const Request& request, const CancelToken& token);
  void post(const Request& request, const PipelineOutput& output);

  static constexpr std::size_t kCacheBytes = std::size_t{32} << 20;  // limits the memory of coarse results
  Inbox& inbox_;
  Show show_;
  /// Of the worker's thread alone: the page that was made smaller last, and what became of it.
  std::weak_ptr<const Scan> pageOf_;
  std::shared_ptr<const Scan> page_;
  StageCache cache_{kCacheBytes};
  BackgroundWorker worker_;  ///< Last: joined before what its jobs use goes away.
};

}  // namespace batten
