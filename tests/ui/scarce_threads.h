// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <system_error>
#include <utility>

#include "ui/session/background/background_threads.h"

namespace batten::test {

/// Threads of which no more can be started than the test allows, as in a system that has none left. Never destroyed,
/// as those of the program are not.
struct ScarceThreads {
  std::shared_ptr<std::atomic<int>> allowed = std::make_shared<std::atomic<int>>(0);
  BackgroundThreads& threads = *new BackgroundThreads([allowed = allowed](BackgroundThreads::Task task) {
    if (*allowed <= 0) throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    --*allowed;
    BackgroundThreads::startThread(std::move(task));
  });
};

}  // namespace batten::test
