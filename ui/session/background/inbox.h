// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <deque>
#include <functional>
#include <mutex>

namespace batten {

/// Where worker threads leave what the GUI thread is to do with their results. The queue and its lock are our own and
/// not Qt's, which no thread sanitizer sees: so a result that is touched after it was posted shows.
class Inbox : public QObject {
  Q_OBJECT
 public:
  /// From any thread that ends before the inbox does. `work` runs in the thread of the inbox, when its event loop next
  /// comes to it, in the order of posting. What waits when the inbox is destroyed is dropped.
  void post(std::function<void()> work);

 private:
  Q_INVOKABLE void runNext();

  std::mutex mutex_;
  std::deque<std::function<void()>> waiting_;  ///< One call of runNext() is queued for each.
};

}  // namespace batten
