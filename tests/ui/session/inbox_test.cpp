// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/inbox.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QThread>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace batten {
namespace {

TEST(Inbox, RunsInItsOwnThreadAndOnlyWhenTheLoopComesToIt) {
  Inbox inbox;
  QThread* ranIn = nullptr;
  std::thread([&] { inbox.post([&] { ranIn = QThread::currentThread(); }); }).join();
  EXPECT_EQ(ranIn, nullptr);
  QCoreApplication::sendPostedEvents(&inbox);
  EXPECT_EQ(ranIn, inbox.thread());
}

TEST(Inbox, KeepsTheOrderOfEachThread) {
  constexpr int kThreads = 4, kEach = 500;
  Inbox inbox;
  std::vector<std::vector<int>> got(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) inbox.post([&got, t, i] { got.at(t).push_back(i); });
    });
  for (std::thread& thread : threads) thread.join();
  QCoreApplication::sendPostedEvents(&inbox);
  for (const std::vector<int>& of : got) {
    ASSERT_EQ(std::ssize(of), kEach);
    for (int i = 0; i < kEach; ++i) EXPECT_EQ(of[i], i);
  }
}

TEST(Inbox, DropsWhatWaitsWhenItGoes) {
  const auto held = std::make_shared<int>(0);
  {
    Inbox inbox;
    inbox.post([held] { ++*held; });
    EXPECT_EQ(held.use_count(), 2);
  }
  QCoreApplication::sendPostedEvents();
  EXPECT_EQ(*held, 0);
  EXPECT_EQ(held.use_count(), 1);
}

TEST(Inbox, MayGoDuringItsOwnWork) {
  auto inbox = std::make_unique<Inbox>();
  bool second = false;
  inbox->post([&] { inbox.reset(); });
  inbox->post([&] { second = true; });
  QCoreApplication::sendPostedEvents(inbox.get());
  EXPECT_EQ(inbox, nullptr);
  EXPECT_FALSE(second);
}

}  // namespace
}  // namespace batten
