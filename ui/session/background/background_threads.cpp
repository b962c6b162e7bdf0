// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/background_threads.h"

#include <exception>
#include <thread>
#include <utility>

namespace batten {

namespace {
BackgroundThreads*& sharedThreads() {
  static auto* threads = new BackgroundThreads;
  return threads;
}
}  // namespace

BackgroundThreads& BackgroundThreads::shared() { return *sharedThreads(); }

BackgroundThreads* BackgroundThreads::replaceShared(BackgroundThreads* threads) {
  return std::exchange(sharedThreads(), threads);
}

void BackgroundThreads::startThread(Task task) { std::thread(std::move(task)).detach(); }

void BackgroundThreads::onStuck(std::function<void()> told) {
  const std::scoped_lock lock(mutex_);
  told_ = std::move(told);
}

bool BackgroundThreads::isStuck() const {
  const std::scoped_lock lock(mutex_);
  return threads_ == 0 && !waiting_.empty();
}

void BackgroundThreads::run(Task task) {
  std::function<void()> told;
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(task));
    provide();
    if (threads_ == 0) told = told_;
  }
  wake_.notify_one();
  if (told) told();
}

void BackgroundThreads::tryAgain() {
  const std::scoped_lock lock(mutex_);
  provide();
}

// As many as there is work for: a short job need not wait for a long one.
void BackgroundThreads::provide() {
  try {
    for (std::size_t needed = waiting_.size(); idle_ + starting_ < needed; ++threads_, ++starting_)
      starter_([this] { work(); });
  } catch (const std::exception&) {
    // The system gives no more threads, or no memory for them: those there are do the work.
  }
}

void BackgroundThreads::work() {
  std::unique_lock lock(mutex_);
  --starting_;
  while (true) {
    ++idle_;
    wake_.wait(lock, [this] { return !waiting_.empty(); });
    --idle_;
    Task task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    task();
    task = nullptr;  // outside the lock, too
    lock.lock();
  }
}

}  // namespace batten
