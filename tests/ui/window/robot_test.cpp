// SPDX-License-Identifier: GPL-3.0-or-later
// A robot at the window: nothing it does may crash it, make Qt complain or hold the window up. BATTEN_ROBOT_EVENTS
// (1000) is the number of events, BATTEN_ROBOT_SEED (1) where they begin. With BATTEN_ROBOT_LIST every pause over 60 ms
// is printed, with the calls that were seen in it.
#include "tests/ui/robot.h"

#include <QDir>
#include <QFileInfo>
#include <iostream>

#include "tests/ui/pause_meter.h"
#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

/// [ms] What a user takes for a hang on a busy machine; 100 ms is what the window aims at, and what is printed.
constexpr double kHangMs = 2000.0;

int numberFrom(const char* variable, int otherwise) {
  bool isNumber = false;
  const int value = qEnvironmentVariableIntValue(variable, &isNumber);
  return isNumber && value > 0 ? value : otherwise;
}

class RobotAtTheWindow : public test::WindowFixture {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
    home_ = qgetenv("HOME");
    before_ = QDir::currentPath();
    qputenv("HOME", folder_.path().toUtf8());
    ASSERT_TRUE(QDir::setCurrent(folder_.path()));
  }
  void TearDown() override {
    qputenv("HOME", home_);
    QDir::setCurrent(before_);
  }

  /// A third of the events on the document as it is now.
  void letLoose(const char* document, std::uint32_t part) {
    answer_ = UnsavedAnswer::Discard;
    test::WarningCatcher catcher;
    test::PauseMeter& meter = test::TestApplication::meter();
    meter.reset();
    if (qEnvironmentVariableIsSet("BATTEN_ROBOT_LIST")) meter.watchCalls();
    const int events = numberFrom("BATTEN_ROBOT_EVENTS", 1000) / 3;
    const auto seed = static_cast<std::uint32_t>(numberFrom("BATTEN_ROBOT_SEED", 1));
    test::Robot robot(*window_, 3 * seed + part);
    robot.run(events);
    session().cancel();
    EXPECT_TRUE(test::waitUntil([&] { return !session().hasRunningJobs(); }));
    std::cout << document << ": " << events << " events, longest pause ";
    print(meter.longest());
    std::cout << "  most work in one: ";
    print(meter.mostWork());
    std::cout << "  over 100 ms: " << meter.over100Ms() << ", of these by work of the window " << meter.workOver100Ms()
              << '\n';
    listPauses(meter);
    EXPECT_LT(meter.longest().spent.wallMs, kHangMs) << meter.longest().doing.toStdString();
    EXPECT_TRUE(test::WarningCatcher::warnings().isEmpty())
        << test::WarningCatcher::warnings().join(QLatin1Char('\n')).toStdString();
  }

  static void print(const test::PauseMeter::Pause& pause) {
    std::cout << pause.spent.wallMs << " ms, " << pause.spent.processorMs << " ms of them work, " << pause.spent.waits
              << " waits (it " << pause.doing.toStdString() << ": " << pause.event.toStdString() << ")\n";
  }
  /// Every pause over 60 ms, with the calls that were seen.
  static void listPauses(const test::PauseMeter& meter) {
    if (!qEnvironmentVariableIsSet("BATTEN_ROBOT_LIST")) return;
    for (const test::PauseMeter::Pause& pause : meter.pauses()) {
      std::cout << "  pause ";
      print(pause);
      for (const QString& stack : pause.stack) std::cout << "    in " << stack.toStdString() << '\n';
    }
  }

  test::NoBrowser browser_;
  QByteArray home_;
  QString before_;
};

TEST_F(RobotAtTheWindow, OutlivesItWithoutADrawing) { letLoose("no drawing", 0); }

TEST_F(RobotAtTheWindow, OutlivesItWhileADrawingIsComputed) {
  path_ = folder_.filePath(QStringLiteral("page.png"));
  ASSERT_TRUE(test::zigzagPage({1600, 1200}).save(path_));
  window_->openPath(path_);
  letLoose("a drawing that is being computed", 1);
}

TEST_F(RobotAtTheWindow, OutlivesItOnAFinishedDrawing) {
  // With the recipe beside it, as it ships: corners, choices and faired curves.
  const QFileInfo sample(QStringLiteral(BATTEN_SAMPLE));
  for (const QString& name : {sample.fileName(), sample.completeBaseName() + QStringLiteral(".recipe.json")})
    QFile::copy(sample.absolutePath() + QLatin1Char('/') + name, folder_.filePath(name));
  ASSERT_NO_FATAL_FAILURE(openFile(folder_.filePath(sample.fileName())));
  ASSERT_FALSE(session().curves().empty());
  letLoose("a finished drawing", 2);
}

}  // namespace
}  // namespace batten
