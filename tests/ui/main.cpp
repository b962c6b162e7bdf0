// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QStandardPaths>

#include "tests/ui/pause_meter.h"

int main(int argc, char** argv) {
  // Without a window system the tests run all the same.
  if (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") &&
      qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
    qputenv("QT_QPA_PLATFORM", "offscreen");
  testing::InitGoogleTest(&argc, argv);
  QStandardPaths::setTestModeEnabled(true);
  batten::test::TestApplication app(argc, argv);
  QApplication::setApplicationName(QStringLiteral("batten-tests"));
  QApplication::setOrganizationName(QStringLiteral("batten-tests"));
  return RUN_ALL_TESTS();
}
