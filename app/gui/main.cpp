// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QThreadPool>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/base/platform.h"
#include "core/base/platform_memory.h"
#include "ui/main_window.h"
#include "ui/session/background/painting_threads.h"
#include "ui/session/files/path_text.h"

namespace {

/// The sketch that ships with the program, beside it in the build and installed trees.
QString samplePath() {
  const QString path =
      QCoreApplication::applicationDirPath() + QStringLiteral("/../share/batten/samples/coupe-side.png");
  return QFileInfo::exists(path) ? QDir::cleanPath(path) : QString();
}

/// What can be said without a window, and so without a display; true if that was all that was asked.
bool answeredInWords(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word == "--version") return std::puts("batten " BATTEN_VERSION) >= 0;
  if (word != "--help" && word != "-h") return false;
  return std::puts(
             "batten [SCAN | CURVES | RECIPE]   opens a scan, a file of curves, or a recipe drawn on "
             "an empty page") >= 0;
}

int endWithoutThreads() {
  std::fputs("batten: the system starts no more threads. Close other programs and start Batten again.\n", stderr);
  return 1;
}

int runWindow(int argc, char** argv) {
  batten::MainWindow window;
  window.show();
  // Qt has taken its own arguments out; the rest are bytes, as the system has them.
  if (argc > 1) {
    window.offerLeftWork();
    window.openPath(batten::absolutePath(batten::pathText(std::filesystem::path(argv[1]))));
  } else {
    window.openAtStart(samplePath());  // The sample opens with its finished recipe, for exploration.
  }
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  if (answeredInWords(argc, argv)) return 0;
  // A file that grows beyond what is allowed is a failed write, with a message, and not the end of the work.
  batten::reportLargeFilesAsErrors();
  batten::keepFewHeaps();
  // Before Qt asks for its own: it waits without end, and shows nothing, where it does not get one.
  if (!batten::canStartThreads(batten::threadsOfStart())) return endWithoutThreads();
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("Batten"));
  QCoreApplication::setApplicationName(QStringLiteral("batten"));
  QCoreApplication::setApplicationVersion(QStringLiteral(BATTEN_VERSION));
  QGuiApplication::setDesktopFileName(QStringLiteral("org.batten.Batten"));
  QGuiApplication::setApplicationDisplayName(QStringLiteral("Batten"));

  const auto painters = batten::keepPaintingThreads(*QThreadPool::globalInstance());
  const int code = painters == batten::PaintingThreads::None ? endWithoutThreads() : runWindow(argc, argv);
  // Qt would wait for those that were never started.
  if (painters != batten::PaintingThreads::All) std::_Exit(code);
  return code;
}
