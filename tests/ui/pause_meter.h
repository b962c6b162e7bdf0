// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <QString>
#include <QStringList>
#include <memory>
#include <vector>

namespace batten::test {

class StackSampler;

/// How long something took.
struct Spent {
  double wallMs = 0.0;
  double processorMs = 0.0;  ///< Of the thread of the window alone: what a busy machine adds is not in it.
  long waits = 0;            ///< How often the thread gave the processor back to wait for something.
};

/// Measures how long the window is busy without looking at the next event: the time of each event, less that of an
/// event loop of its own (a dialog, a menu), whose events are measured by themselves.
class PauseMeter {
 public:
  struct Pause {
    Spent spent;
    QString doing;      ///< What the test did.
    QString event;      ///< The event that took so long, and those within it that took most of that.
    QStringList stack;  ///< Calls that were seen during it, if a sampler is set.
  };

  PauseMeter();
  ~PauseMeter();
  /// Begins, or begins anew: before, no event is measured, as that takes a tenth of a test's time.
  void reset();
  /// What is done from now on, to be named with the pauses.
  void setDoing(const QString& doing) { doing_ = doing; }
  /// From now on the calls are noted that the thread of the window is in while a pause lasts. To be called from it.
  void watchCalls();
  /// By the clock on the wall, and by the processor's time.
  const Pause& longest() const { return longest_; }
  const Pause& mostWork() const { return mostWork_; }
  /// Over 100 ms of wall clock, and of the processor's time.
  int over100Ms() const { return over_; }
  int workOver100Ms() const { return workOver_; }
  /// Those over 60 ms, in order.
  const std::vector<Pause>& pauses() const { return pauses_; }

  /// An event begins in the event loop of this depth, and ends.
  void begin(int loop, const QObject& receiver, const QEvent& event);
  void end();

 private:
  struct Moment {
    qint64 wallNs = 0, processorNs = 0;
    long waits = 0;
  };
  struct Event {
    int loop;      ///< Depth of the event loop that sent it.
    Moment since;  ///< When it began, or went on after the last event of a loop of its own.
    Moment begun;
    const char* receiver;  ///< Its class.
    QString name;
    int type;
    QStringList parts;  ///< What of it took long, the last first.
    bool hasLoop = false;
    bool isPart = false;  ///< Sent by the event before it, whose time it is.
  };
  Moment now() const;
  static Spent between(const Moment& from, const Moment& to);
  static QString describe(const Event& event, const Spent& spent);
  void add(const Event& event);

  QElapsedTimer clock_;
  std::vector<Event> events_;
  std::vector<Pause> pauses_;
  Pause longest_, mostWork_;
  int over_ = 0, workOver_ = 0;
  QString doing_;
  std::unique_ptr<StackSampler> sampler_;
};

/// The application of the window's tests: tells its meter of every event.
class TestApplication : public QApplication {
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override;
  static PauseMeter& meter();
};

}  // namespace batten::test
