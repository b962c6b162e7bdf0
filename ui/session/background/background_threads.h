// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace batten {

/// The threads that all background workers share. One is started when work comes and none is free, and stays. Where the
/// system starts no more, work waits for one of those there are; without any it waits until tryAgain() gets one.
class BackgroundThreads {
 public:
  using Task = std::function<void()>;
  /// Starts a thread that runs the task and is never joined. Throws std::system_error where the system gives none.
  using Starter = std::function<void(Task)>;

  /// Those of the program; never destroyed, as its threads wait for work until the process ends.
  static BackgroundThreads& shared();

  explicit BackgroundThreads(Starter starter = startThread) : starter_(std::move(starter)) {}
  BackgroundThreads(const BackgroundThreads&) = delete;
  BackgroundThreads& operator=(const BackgroundThreads&) = delete;

  /// Runs `task` on a thread, soon; never waits. @pre `task` does not throw.
  void run(Task task);
  /// Starts a thread for what waits, if the system gives one by now.
  void tryAgain();
  /// Work waits, and there is no thread at all.
  bool isStuck() const;
  /// Called by run(), in its thread, each time that it leaves work stuck. Null: nobody.
  void onStuck(std::function<void()> told);

  static void startThread(Task task);
  /// For tests: what workers made from now on use. @return what they used before.
  static BackgroundThreads* replaceShared(BackgroundThreads* threads);

 private:
  void provide();
  void work();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> waiting_;
  std::size_t threads_ = 0;   ///< that were started
  std::size_t starting_ = 0;  ///< of these, have not come to their work yet
  std::size_t idle_ = 0;      ///< of these, wait for work
  std::function<void()> told_;
  Starter starter_;
};

}  // namespace batten
