// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the pictures of the README and of the software catalogues from the real window: take_screenshots SAMPLE.png
// FOLDER
#include <QApplication>
#include <QCursor>
#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QScreen>
#include <QStandardPaths>
#include <functional>
#include <iostream>

#include "ui/main_window.h"

namespace {

constexpr int kLimitMs = 120'000;

bool waitUntil(const std::function<bool()>& done) {
  QElapsedTimer timer;
  timer.start();
  while (!done()) {
    if (timer.elapsed() > kLimitMs) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
  }
  return true;
}

/// Lets what the last change set off arrive and be painted.
void settle(batten::MainWindow& window) {
  QElapsedTimer timer;
  timer.start();
  waitUntil(
      [&] { return timer.elapsed() > 1000 && !window.session().isWorking() && window.session().targets() != nullptr; });
}

}  // namespace

int main(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("batten-screenshots"));
  QCoreApplication::setApplicationName(QStringLiteral("batten-screenshots"));
  const QStringList arguments = QCoreApplication::arguments();
  if (arguments.size() != 3) {
    std::cerr << "take_screenshots SAMPLE.png FOLDER\n";
    return 2;
  }
  const QDir folder(arguments[2]);
  batten::MainWindow window;
  window.resize(1440, 900);
  window.setThemeChoice(batten::ThemeChoice::Light);
  window.show();
  window.openPath(QFileInfo(arguments[1]).absoluteFilePath());
  if (!waitUntil(
          [&] { return window.session().hasScan() && !window.session().isBusy() && window.session().targets(); })) {
    std::cerr << "The sample was not traced in time.\n";
    return 1;
  }
  const auto save = [&](const char* name) {
    // What is under the pointer would show as hovered.
    QCursor::setPos(window.screen()->geometry().bottomRight());
    settle(window);
    const QString path = folder.filePath(QString::fromLatin1(name));
    if (!window.grab().save(path)) std::cerr << "Cannot write " << path.toStdString() << '\n';
  };
  window.setStage(batten::PanelStage::Fairing);
  save("fairing.png");
  window.setStage(batten::PanelStage::Threshold);
  save("threshold.png");
  window.setStage(batten::PanelStage::Corners);
  window.setThemeChoice(batten::ThemeChoice::Dark);
  save("corners-dark.png");
  window.setThemeChoice(batten::ThemeChoice::System);
  return 0;
}
