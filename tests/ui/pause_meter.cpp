// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/pause_meter.h"

#include <QThread>

namespace batten::test {

void PauseMeter::reset() {
  clock_.start();
  longestNs_ = 0;
  over_ = 0;
  longestDoing_.clear();
}

void PauseMeter::begin(int loop) {
  if (!clock_.isValid()) clock_.start();
  const bool isPart = !events_.empty() && loop <= events_.back().loop;
  if (!isPart && !events_.empty() && !events_.back().hasLoop) {
    events_.back().hasLoop = true;
    add(events_.back().since);
  }
  events_.push_back({loop, clock_.nsecsElapsed(), false, isPart});
}

void PauseMeter::end() {
  const Event event = events_.back();
  events_.pop_back();
  if (event.isPart) {
    // A loop of its own was one of the event that it belongs to.
    if (event.hasLoop) {
      events_.back().hasLoop = true;
      events_.back().since = event.since;
    }
    return;
  }
  add(event.since);
  if (!events_.empty()) events_.back().since = clock_.nsecsElapsed();
}

void PauseMeter::add(qint64 since) {
  constexpr qint64 kNoticed = 100'000'000;  // [ns]
  const qint64 took = clock_.nsecsElapsed() - since;
  if (took > kNoticed) ++over_;
  if (took <= longestNs_) return;
  longestNs_ = took;
  longestDoing_ = doing_;
}

bool TestApplication::notify(QObject* receiver, QEvent* event) {
  if (QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
  meter().begin(QThread::currentThread()->loopLevel());
  const bool isDone = QApplication::notify(receiver, event);
  meter().end();
  return isDone;
}

PauseMeter& TestApplication::meter() {
  static PauseMeter meter;
  return meter;
}

}  // namespace batten::test
