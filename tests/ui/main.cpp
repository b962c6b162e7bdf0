// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QStandardPaths>
#include <QTemporaryDir>
#include <optional>

#include "tests/ui/pause_meter.h"

int main(int argc, char** argv) {
  // Without a window system the tests run all the same.
  if (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") &&
      qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
    qputenv("QT_QPA_PLATFORM", "offscreen");
  testing::InitGoogleTest(&argc, argv);
  // Tests that run at the same time do not find each other's unsaved work and profiles; a program that a test starts
  // shares those of the test.
  constexpr const char* kHomeOfTests = "BATTEN_HOME_OF_TESTS";
  std::optional<QTemporaryDir> home;
  if (qEnvironmentVariableIsEmpty(kHomeOfTests)) {
    home.emplace();
    for (const char* name : {kHomeOfTests, "HOME"}) qputenv(name, home->path().toLocal8Bit());
  }
  QStandardPaths::setTestModeEnabled(true);
  batten::test::TestApplication app(argc, argv);
  QApplication::setApplicationName(QStringLiteral("batten-tests"));
  QApplication::setOrganizationName(QStringLiteral("batten-tests"));
  return RUN_ALL_TESTS();
}
