// SPDX-License-Identifier: GPL-3.0-or-later
// bench_window [SCAN]: how soon the window shows something on a large page, how long it does not look at the next
// event, and how much memory it takes. Without a scan a page of 7016 x 4960 px with 72 strokes is made. Without a
// display it needs QT_QPA_PLATFORM=offscreen. bench_window --write FILE.png WIDTH HEIGHT: writes that page.
#include <QApplication>
#include <QElapsedTimer>
#include <QImage>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/base/platform_memory.h"
#include "tests/support/large_page.h"
#include "ui/main_window.h"

namespace {

using namespace batten;

void turnUntil(const std::function<bool()>& done) {
  while (!done()) QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 20);
}

/// [MB] Memory that the program has held at most.
double peakMb() { return static_cast<double>(peakMemoryBytes().value_or(0)) / 1e6; }

/// [MB] Memory that it holds now.
double nowMb() {
  return static_cast<double>(residentMemoryBytes(QCoreApplication::applicationPid()).value_or(0)) / 1e6;
}

bool writePage(const QString& path, int width, int height) {
  const Scan scan = test::largePage(width, height, 72, 1);
  QImage image(width, height, QImage::Format_Grayscale8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.scanLine(y)[x] = static_cast<uchar>(scan.grey.row(y)[x] / 257);
  image.setDotsPerMeterX(23622);
  image.setDotsPerMeterY(23622);
  return image.save(path);
}

/// The longest time between two beats of a clock in the event loop.
class Heartbeat {
 public:
  Heartbeat() {
    QObject::connect(&timer_, &QTimer::timeout, [this] { longest_ = std::max(longest_, since_.restart()); });
    since_.start();
    timer_.start(2);
  }
  qint64 longestMs() const { return longest_; }

 private:
  QTimer timer_;
  QElapsedTimer since_;
  qint64 longest_ = 0;
};

/// False where the scan could not be opened.
bool timeOpening(MainWindow& window, const QString& path) {
  EditorSession& session = window.session();
  QElapsedTimer clock;
  qint64 picture = -1, coarse = -1, ink = -1, curves = -1;
  QObject scope;
  const auto note = [&clock](qint64& at) {
    if (at < 0) at = clock.elapsed();
  };
  QObject::connect(&session, &EditorSession::scanOpened, &scope, [&] { note(picture); });
  QObject::connect(&session, &EditorSession::coarseReady, &scope, [&] { note(coarse); });
  QObject::connect(&session, &EditorSession::stageReady, &scope, [&](StageId stage) {
    if (stage == StageId::Filtered) note(ink);
    if (stage == StageId::Curves) note(curves);
  });
  Heartbeat heart;
  clock.start();
  window.openPath(path);
  turnUntil([&] { return !session.isBusy(); });
  if (!session.hasScan()) return false;
  std::printf(
      "opening: picture %.2f s, coarse result %.2f s, ink %.2f s, curves %.2f s, done %.2f s; longest pause %lld ms; "
      "%.0f MB now, %.0f MB at most; %zu curves\n",
      picture / 1e3, coarse / 1e3, ink / 1e3, curves / 1e3, clock.elapsed() / 1e3,
      static_cast<long long>(heart.longestMs()), nowMb(), peakMb(), session.curves().size());
  turnUntil([&] { return !session.isWorking() && !session.hasRunningJobs(); });
  return true;
}

using Step = std::function<void(Recipe&, int)>;  ///< Sets the value of a step of the drag, 1..60.

void timeDrag(MainWindow& window, const char* what, const Step& set) {
  EditorSession& session = window.session();
  QObject scope;
  QElapsedTimer clock;
  int shown = 0;
  qint64 coarse = -1, ink = -1;
  bool isOver = false;
  const Recipe start = session.recipe();
  const int gesture = session.newGesture();
  QObject::connect(&session, &EditorSession::coarseReady, &scope, [&] {
    ++shown;
    if (isOver && coarse < 0) coarse = clock.elapsed();
  });
  QObject::connect(&session, &EditorSession::stageReady, &scope, [&](StageId stage) {
    if (stage != StageId::Filtered) return;
    ++shown;
    if (isOver && ink < 0 && !session.isStale(StageId::Filtered)) ink = clock.elapsed();
  });
  Heartbeat heart;
  clock.start();
  Recipe recipe = start;
  for (int step = 1; step <= 60; ++step) {
    set(recipe, step);
    session.change(QString::fromLatin1(what), recipe, gesture);
    turnUntil([&] { return clock.elapsed() >= 33 * step; });
  }
  const int during = shown;
  isOver = true;
  clock.restart();
  turnUntil([&] { return !session.isBusy(); });
  std::printf(
      "%s dragged for 2 s: %d pictures while it goes on; after it coarse %.2f s, ink %.2f s, done %.2f s; longest "
      "pause %lld ms; %.0f MB at most\n",
      what, during, coarse / 1e3, ink / 1e3, clock.elapsed() / 1e3, static_cast<long long>(heart.longestMs()),
      peakMb());
}

}  // namespace

int main(int argc, char** argv) {
  keepFewHeaps();
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("batten-bench"));
  QCoreApplication::setApplicationName(QStringLiteral("batten-bench"));
  const QStringList arguments = QCoreApplication::arguments().mid(1);
  if (arguments.size() == 4 && arguments[0] == QStringLiteral("--write"))
    return writePage(arguments[1], arguments[2].toInt(), arguments[3].toInt()) ? 0 : 1;

  QTemporaryDir folder;
  QString path = arguments.value(0);
  if (path.isEmpty()) {
    path = folder.filePath(QStringLiteral("page.png"));
    // By a program of its own: the page that is made is no memory of the window's.
    const QStringList order = {QStringLiteral("--write"), path, QStringLiteral("7016"), QStringLiteral("4960")};
    if (QProcess::execute(QCoreApplication::applicationFilePath(), order) != 0) return 1;
  }
  MainWindow window;
  window.setUnsavedQuestion([](const QString&) { return UnsavedAnswer::Discard; });
  window.resize(1920, 1040);
  window.show();
  std::printf("%.0f MB before\n", nowMb());
  if (!timeOpening(window, path)) {
    std::fprintf(stderr, "%s cannot be opened.\n", qPrintable(path));
    return 1;
  }
  window.setStage(PanelStage::Threshold);
  timeDrag(window, "Strength", [](Recipe& recipe, int step) { recipe.threshold.strength = 1.0 + 0.005 * step; });
  window.setStage(PanelStage::CleanUp);
  timeDrag(window, "Neighbourhood coefficient",
           [](Recipe& recipe, int step) { recipe.filter.coefficient = step / 12 % 5; });
  return 0;
}
