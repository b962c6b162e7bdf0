// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/background_worker.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

namespace batten {

struct BackgroundWorker::State {
  void work();

  std::mutex mutex;
  std::condition_variable ended;
  struct Waiting {
    Job job;
    CancelToken token;
  };
  std::optional<Waiting> next;
  std::optional<CancelToken> running;
  bool hasThread = false;  ///< One works here, or will.
};

BackgroundWorker::BackgroundWorker(BackgroundThreads& threads) : threads_(threads), state_(std::make_shared<State>()) {}

BackgroundWorker::~BackgroundWorker() {
  std::unique_lock lock(state_->mutex);
  state_->next.reset();
  if (state_->running) state_->running->cancel();
  // Not for a thread that has not come yet: there may be none.
  state_->ended.wait(lock, [this] { return !state_->running; });
}

CancelToken BackgroundWorker::start(Job job, Running running) {
  const CancelToken token;
  {
    const std::scoped_lock lock(state_->mutex);
    state_->next = State::Waiting{std::move(job), token};
    if (running == Running::Cancel && state_->running) state_->running->cancel();
    if (std::exchange(state_->hasThread, true)) return token;
  }
  threads_.run([state = state_] { state->work(); });
  return token;
}

void BackgroundWorker::cancelAll() {
  const std::scoped_lock lock(state_->mutex);
  state_->next.reset();
  if (state_->running) state_->running->cancel();
}

bool BackgroundWorker::isRunning() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->running.has_value() || state_->next.has_value();
}

void BackgroundWorker::State::work() {
  std::unique_lock lock(mutex);
  while (next) {
    Waiting current = std::move(*next);
    next.reset();
    running = current.token;
    lock.unlock();
    try {
      current.job(current.token);
    } catch (const std::exception&) {
      // The job's own business; the thread has to survive.
    }
    current.job = nullptr;  // What it captured may be large and is freed outside the lock.
    lock.lock();
    running.reset();
    ended.notify_all();
  }
  hasThread = false;
}

}  // namespace batten
