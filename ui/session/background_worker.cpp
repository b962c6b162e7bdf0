// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background_worker.h"

#include <exception>
#include <utility>

namespace batten {

BackgroundWorker::BackgroundWorker() : thread_([this] { loop(); }) {}

BackgroundWorker::~BackgroundWorker() {
  {
    const std::scoped_lock lock(mutex_);
    quit_ = true;
    next_.reset();
    if (running_) running_->cancel();
  }
  wake_.notify_one();
  thread_.join();
}

CancelToken BackgroundWorker::start(Job job, Running running) {
  const CancelToken token;
  {
    const std::scoped_lock lock(mutex_);
    next_ = Waiting{std::move(job), token};
    if (running == Running::Cancel && running_) running_->cancel();
  }
  wake_.notify_one();
  return token;
}

void BackgroundWorker::cancelAll() {
  const std::scoped_lock lock(mutex_);
  next_.reset();
  if (running_) running_->cancel();
}

bool BackgroundWorker::isRunning() const {
  const std::scoped_lock lock(mutex_);
  return running_.has_value() || next_.has_value();
}

void BackgroundWorker::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return quit_ || next_.has_value(); });
    if (quit_) return;
    Waiting current = std::move(*next_);
    next_.reset();
    running_ = current.token;
    lock.unlock();
    try {
      current.job(current.token);
    } catch (const std::exception&) {
      // The job's own business; the thread has to survive.
    }
    current.job = nullptr;  // What it captured may be large and is freed outside the lock.
    lock.lock();
    running_.reset();
  }
}

}  // namespace batten
