// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QEventLoop>
#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QUrl>
#include <random>

#include "ui/main_window.h"

namespace batten::test {

/// Presses, drags, turns the wheel and types at random in a window and in whatever it opens. The same seed gives the
/// same events; what they meet may differ, as work runs in the background. Writes no file outside of the present folder
/// and the user's home: it navigates in no file dialog and types no slash.
class Robot : public QObject {
 public:
  Robot(MainWindow& window, std::uint32_t seed) : window_(window), random_(seed) {}
  /// Does so many events, closes what they have opened, and comes back.
  void run(int events);

 private:
  void stepSoon();
  void step();
  void act(QWidget& top);
  void pressSomewhere(QWidget& top);
  void goOnDragging();
  void release();
  void turnWheel(QWidget& top);
  void typeSomething(QWidget& top);
  QWidget* aimAt(QWidget& top, QPoint& at);
  void say(const char* what, const QWidget* where) const;
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }

  MainWindow& window_;
  std::mt19937 random_;
  QEventLoop loop_;
  int left_ = 0, inDialog_ = 0;
  QPointer<QWidget> held_;  ///< Where the left button is down.
  QPoint heldAt_;
};

/// Keeps links from starting a browser while it lives.
class NoBrowser : public QObject {
  Q_OBJECT
 public:
  NoBrowser();
  ~NoBrowser() override;

 public slots:
  void open(const QUrl&) {}
};

/// Collects what Qt complains about while it lives.
class WarningCatcher {
 public:
  WarningCatcher();
  ~WarningCatcher();
  static QStringList& warnings();
};

}  // namespace batten::test
