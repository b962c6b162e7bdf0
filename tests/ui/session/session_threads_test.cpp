// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QSemaphore>
#include <QThreadPool>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "tests/ui/rendered_scan.h"
#include "tests/ui/scarce_threads.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/painting_threads.h"
#include "ui/session/background/thread_shortage.h"

namespace batten {
namespace {

using test::ScarceThreads;
using test::waitUntil;

TEST(BackgroundWorker, KeepsItsNewestJobUntilThereIsAThread) {
  const ScarceThreads scarce;
  std::atomic<int> ran{0};
  BackgroundWorker worker(scarce.threads);
  worker.start([&](const CancelToken&) { ran += 1; });
  worker.start([&](const CancelToken&) { ran += 10; });
  EXPECT_TRUE(scarce.threads.isStuck());
  EXPECT_TRUE(worker.isRunning());
  scarce.threads.tryAgain();
  EXPECT_TRUE(scarce.threads.isStuck());
  *scarce.allowed = 1;
  scarce.threads.tryAgain();
  ASSERT_TRUE(waitUntil([&] { return !worker.isRunning(); }));
  EXPECT_EQ(ran, 10);
  EXPECT_FALSE(scarce.threads.isStuck());
}

TEST(BackgroundWorker, TriesAgainAtTheNextRequestOfAny) {
  const ScarceThreads scarce;
  std::atomic<int> ran{0};
  BackgroundWorker first(scarce.threads), second(scarce.threads);
  first.start([&](const CancelToken&) { ++ran; });
  *scarce.allowed = 1;
  second.start([&](const CancelToken&) { ++ran; });
  EXPECT_TRUE(waitUntil([&] { return ran == 2; })) << "one thread is enough for both";
}

TEST(BackgroundWorker, GoesWithoutWaitingForAThreadThatDoesNotCome) {
  const ScarceThreads scarce;
  auto held = std::make_shared<int>(1);
  {
    BackgroundWorker worker(scarce.threads);
    worker.start([held](const CancelToken&) { *held = 2; });
  }
  EXPECT_EQ(held.use_count(), 1) << "what the job held is freed";
  *scarce.allowed = 1;
  scarce.threads.tryAgain();
  EXPECT_TRUE(waitUntil([&] { return !scarce.threads.isStuck(); }));
  EXPECT_EQ(*held, 1) << "the job of a worker that has gone is not done";
}

TEST(BackgroundWorker, DoesShortJobsBesideALongOne) {
  const ScarceThreads scarce;
  *scarce.allowed = 2;
  std::atomic<bool> release{false}, ran{false};
  BackgroundWorker slow(scarce.threads), quick(scarce.threads);
  slow.start([&](const CancelToken&) {
    while (!release) std::this_thread::yield();
  });
  quick.start([&](const CancelToken&) { ran = true; });
  EXPECT_TRUE(waitUntil([&] { return ran.load(); }));
  release = true;
}

TEST(ThreadShortage, IsToldWhenItBeginsAndEnds) {
  const ScarceThreads scarce;
  ThreadShortage shortage(scarce.threads);
  std::vector<bool> told;
  QObject::connect(&shortage, &ThreadShortage::changed, [&](bool isShort) { told.push_back(isShort); });
  std::atomic<bool> ran{false};
  BackgroundWorker worker(scarce.threads);
  worker.start([&](const CancelToken&) { ran = true; });
  ASSERT_TRUE(waitUntil([&] { return told.size() == 1; }));
  EXPECT_TRUE(told[0]);
  *scarce.allowed = 1;
  EXPECT_TRUE(waitUntil([&] { return ran && told.size() == 2; }));
  EXPECT_FALSE(told[1]);
}

TEST(PaintingThreads, StayAndAreKnownToBeThere) {
  QThreadPool pool;
  pool.setMaxThreadCount(2);
  EXPECT_EQ(keepPaintingThreads(pool), PaintingThreads::All);
  EXPECT_EQ(pool.expiryTimeout(), -1);
  // From here on none can be started: work is done by those there are.
  pool.setStackSize(1);
  QSemaphore done;
  for (int i = 0; i < 10; ++i) pool.start([&] { done.release(); });
  EXPECT_TRUE(done.tryAcquire(10, 10'000));
  static auto& none = *new QThreadPool;
  none.setMaxThreadCount(2);
  none.setStackSize(1);  // [bytes] less than the system allows, so that no thread starts
  EXPECT_EQ(keepPaintingThreads(none), PaintingThreads::None);
}

}  // namespace
}  // namespace batten
