// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "core/base/cancel_token.h"
#include "ui/session/background/background_threads.h"

namespace batten {

/// Does the newest job asked for, on one of the threads shared by all workers, one job at a time. A job waiting behind
/// a running one is replaced by the next, so that a drag leaves no queue. Starting and cancelling never wait; only the
/// destructor does, after cancelling. While the system gives no thread a job waits for one (BackgroundThreads).
class BackgroundWorker {
 public:
  using Job = std::function<void(const CancelToken&)>;

  BackgroundWorker() : BackgroundWorker(BackgroundThreads::shared()) {}
  explicit BackgroundWorker(BackgroundThreads& threads);
  ~BackgroundWorker();
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  enum class Running { Cancel, Finish };
  /// Runs `job` as soon as the job before has ended, with the token returned here. `running` says whether a job in
  /// progress is told to stop. Exceptions that leave a job are dropped: a job reports its own failures.
  CancelToken start(Job job, Running running = Running::Cancel);
  /// Tells the running job to stop and drops the one that waits.
  void cancelAll();
  /// True while a job runs or waits, a cancelled one too until it has ended.
  bool isRunning() const;

 private:
  struct State;
  BackgroundThreads& threads_;
  std::shared_ptr<State> state_;  ///< Shared with the thread: one that comes late finds nothing to do.
};

}  // namespace batten
