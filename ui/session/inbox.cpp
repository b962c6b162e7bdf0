// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/inbox.h"

#include <QCoreApplication>
#include <QEvent>
#include <utility>

namespace batten {

void Inbox::post(std::function<void()> work) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(work));
  }
  QCoreApplication::postEvent(this, new QEvent(QEvent::User));
}

void Inbox::customEvent(QEvent*) {
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
