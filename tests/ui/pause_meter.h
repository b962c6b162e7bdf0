// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <QString>
#include <vector>

namespace batten::test {

/// Measures how long the window is busy without looking at the next event: the time of each event, less that of an
/// event loop of its own (a dialog, a menu), whose events are measured by themselves.
class PauseMeter {
 public:
  /// Begins anew.
  void reset();
  /// What is done from now on, to be named with the longest pause.
  void setDoing(const QString& doing) { doing_ = doing; }
  double longestMs() const { return static_cast<double>(longestNs_) * 1e-6; }
  int over100Ms() const { return over_; }
  const QString& longestDoing() const { return longestDoing_; }

  /// An event begins in the event loop of this depth, and ends.
  void begin(int loop);
  void end();

 private:
  struct Event {
    int loop;      ///< Depth of the event loop that sent it.
    qint64 since;  ///< [ns] When it began, or went on after the last event of a loop of its own.
    bool hasLoop = false;
    bool isPart = false;  ///< Sent by the event before it, whose time it is.
  };
  void add(qint64 since);

  QElapsedTimer clock_;
  std::vector<Event> events_;
  qint64 longestNs_ = 0;
  int over_ = 0;
  QString doing_, longestDoing_;
};

/// The application of the window's tests: tells its meter of every event.
class TestApplication : public QApplication {
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override;
  static PauseMeter& meter();
};

}  // namespace batten::test
