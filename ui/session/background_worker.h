// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/cancel_token.h"

namespace batten {

/// One thread that does the newest job asked for. A job waiting behind a running one is replaced by the next, so that a
/// drag leaves no queue. Starting and cancelling never wait; only the destructor does, after cancelling.
class BackgroundWorker {
 public:
  using Job = std::function<void(const CancelToken&)>;

  BackgroundWorker();
  ~BackgroundWorker();
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  enum class Running { Cancel, Finish };
  /// Runs `job` as soon as the thread is free, with the token returned here. `running` says whether a job in progress
  /// is told to stop. Exceptions that leave a job are dropped: a job reports its own failures.
  CancelToken start(Job job, Running running = Running::Cancel);
  /// Tells the running job to stop and drops the one that waits.
  void cancelAll();
  /// True while a job runs or waits, a cancelled one too until it has ended.
  bool isRunning() const;

 private:
  void loop();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  struct Waiting {
    Job job;
    CancelToken token;
  };
  std::optional<Waiting> next_;
  std::optional<CancelToken> running_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace batten
