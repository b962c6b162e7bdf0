// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/base/platform.h"

namespace batten {
namespace {

/// Threads that stay and help with whatever loop is being run. A loop never waits for a thread that has not begun to
/// help: with none free its caller does all of the work.
class Helpers {
 public:
  /// Runs `work` here and, as long as it lasts, on up to `count` threads besides. @pre `work` does not throw.
  void run(int count, const std::function<void()>& work) {
    Task task{&work, count};
    {
      const std::scoped_lock lock(mutex_);
      asked_ += count;
      provide();
      if (threads_ > 0) waiting_.push_back(&task);
    }
    wake_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    std::erase(waiting_, &task);
    asked_ -= count;
    left_.wait(lock, [&] { return task.inside == 0; });
  }

 private:
  struct Task {
    const std::function<void()>* work;
    int wanted;
    int inside = 0;
  };

  /// As many as all loops that are being run have asked for: a short one need not wait for a long one.
  void provide() {
    try {
      for (; threads_ < std::min(asked_, most_); ++threads_) std::thread([this] { help(); }).detach();
    } catch (const std::system_error&) {
      // The system gives no more threads: those there are do the work, the caller's at the least.
    }
  }
  [[noreturn]] void help() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [&] { return !waiting_.empty(); });
      Task& task = *waiting_.front();
      if (--task.wanted == 0) waiting_.pop_front();
      ++task.inside;
      lock.unlock();
      (*task.work)();
      lock.lock();
      if (--task.inside == 0) left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, left_;
  std::deque<Task*> waiting_;
  int threads_ = 0, asked_ = 0;
  // Threads that leave no memory to the work would be worse than none.
  const int most_ = threadsWithinLimits().value_or(std::numeric_limits<int>::max());
};

/// Never destroyed: its threads wait for work until the process ends.
Helpers& helpers() {
  static auto* const all = new Helpers;
  return *all;
}

}  // namespace

int threadCount(const RunContext& context) {
  if (context.threads > 0) return context.threads;
  return std::max(1u, std::thread::hardware_concurrency());
}

void parallelFor(const RunContext& context, int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  const int step = std::max(1, grain);
  const int blocks = (count - 1) / step + 1;
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&] {
    for (int block = next++; block < blocks && !context.isCancelled(); block = next++) {
      try {
        body(block * step, std::min(count, (block + 1) * step));
      } catch (...) {
        const std::scoped_lock lock(failureMutex);
        if (!failure) failure = std::current_exception();
        next = blocks;
      }
    }
  };
  const int more = std::min(threadCount(context), blocks) - 1;
  if (more > 0) {
    helpers().run(more, work);
  } else {
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace batten
