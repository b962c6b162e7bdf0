// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QDir>
#include <QFileInfo>

#include "ui/main_window.h"

namespace {

/// The sketch that ships with the program, beside it in the build and installed trees.
QString samplePath() {
  const QString path =
      QCoreApplication::applicationDirPath() + QStringLiteral("/../share/batten/samples/coupe-side.png");
  return QFileInfo::exists(path) ? QDir::cleanPath(path) : QString();
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("Batten"));
  QCoreApplication::setApplicationName(QStringLiteral("batten"));
  QCoreApplication::setApplicationVersion(QStringLiteral("0.1.0"));
  QGuiApplication::setApplicationDisplayName(QStringLiteral("Batten"));

  batten::MainWindow window;
  window.show();
  const QStringList arguments = QCoreApplication::arguments().mid(1);
  if (!arguments.isEmpty()) {
    window.offerLeftWork();
    window.openPath(QFileInfo(arguments.first()).absoluteFilePath());
  } else {
    window.openAtStart(samplePath());  // The sample opens finished, by the recipe beside it: one learns by changing it.
  }
  return QApplication::exec();
}
