// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "ui/session/background/background_worker.h"

namespace batten {

/// Frees large values in a thread of its own: up to a gigabyte goes back to the system, which takes a while. What is
/// discarded is handed over and touches nothing else. Values that wait are freed at the latest by the destructor.
class DiscardedValues {
 public:
  void discard(std::shared_ptr<const void> value);
  /// True while something waits or is being freed.
  bool isBusy() const { return worker_.isRunning(); }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const void>> waiting_;
  BackgroundWorker worker_;  ///< Last: joined before what it takes from goes away.
};

}  // namespace batten
