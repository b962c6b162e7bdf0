// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QTimer>

#include "ui/session/background/background_threads.h"
#include "ui/session/background/inbox.h"

namespace batten {

/// Notices that the system gives no thread for the work in the background, and tries again until it does.
class ThreadShortage : public QObject {
  Q_OBJECT
 public:
  explicit ThreadShortage(BackgroundThreads& threads, QObject* parent = nullptr);
  ~ThreadShortage() override;

 signals:
  void changed(bool isShort);

 private:
  void begin();
  void tryAgain();

  BackgroundThreads& threads_;
  QTimer timer_{this};
  Inbox inbox_;
};

}  // namespace batten
