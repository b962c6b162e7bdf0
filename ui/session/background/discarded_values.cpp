// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/discarded_values.h"

#include <utility>

namespace batten {

void DiscardedValues::discard(std::shared_ptr<const void> value) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(value));
  }
  // A job that waits may be replaced by this one, which takes what that one would have taken.
  worker_.start(
      [this](const CancelToken&) {
        std::vector<std::shared_ptr<const void>> taken;  // freed after the lock is released
        const std::scoped_lock lock(mutex_);
        taken.swap(waiting_);
      },
      BackgroundWorker::Running::Finish);
}

}  // namespace batten
