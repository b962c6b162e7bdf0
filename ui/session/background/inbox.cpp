// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/inbox.h"

#include <QMetaObject>
#include <utility>

namespace batten {

void Inbox::post(std::function<void()> work) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(work));
  }
  // By name: a functor would make Qt hand over an object that was allocated here, outside of its locks.
  QMetaObject::invokeMethod(this, "runNext", Qt::QueuedConnection);
}

void Inbox::runNext() {
  std::function<void()> work;
  {
    const std::scoped_lock lock(mutex_);
    if (waiting_.empty()) return;
    work = std::move(waiting_.front());
    waiting_.pop_front();
  }
  work();
}

}  // namespace batten
