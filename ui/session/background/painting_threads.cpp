// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/painting_threads.h"

#include <QThread>
#include <QThreadPool>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <latch>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace batten {

namespace {
constexpr int kMostThreads = 4;                        // more paint no window sooner
constexpr std::chrono::milliseconds kLongStart{2000};  // a thread that has not begun by then was not started

// Qt's own: one or two read what the window system sends, one is for D-Bus, which accessibility asks. Where the first
// need but one, the other is for the work.
constexpr int kOtherThreads = 3;

/// Where the threads wait for one another, so that each task gets one of its own.
struct Meeting {
  std::mutex mutex;
  std::condition_variable changed;
  int arrived = 0;
  bool isOver = false;
};
}  // namespace

int threadsOfStart() { return std::min(QThread::idealThreadCount(), kMostThreads) + kOtherThreads; }

bool canStartThreads(int count) {
  std::latch tried(1);
  std::vector<std::thread> threads;
  try {
    while (static_cast<int>(threads.size()) < count) threads.emplace_back([&tried] { tried.wait(); });
  } catch (const std::exception&) {
    // The system gives no more, or no memory for them.
  }
  tried.count_down();
  for (std::thread& one : threads) one.join();
  return static_cast<int>(threads.size()) == count;
}

PaintingThreads keepPaintingThreads(QThreadPool& pool) {
  pool.setMaxThreadCount(std::min(pool.maxThreadCount(), kMostThreads));
  pool.setExpiryTimeout(-1);
  const int wanted = pool.maxThreadCount();
  const auto meeting = std::make_shared<Meeting>();
  for (int i = 0; i < wanted; ++i)
    pool.start([meeting] {
      std::unique_lock lock(meeting->mutex);
      ++meeting->arrived;
      meeting->changed.notify_all();
      meeting->changed.wait(lock, [&] { return meeting->isOver; });
    });
  std::unique_lock lock(meeting->mutex);
  meeting->changed.wait_for(lock, kLongStart, [&] { return meeting->arrived == wanted; });
  meeting->isOver = true;
  meeting->changed.notify_all();
  if (meeting->arrived == wanted) return PaintingThreads::All;
  return meeting->arrived > 0 ? PaintingThreads::Some : PaintingThreads::None;
}

}  // namespace batten
