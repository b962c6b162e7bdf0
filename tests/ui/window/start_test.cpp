// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QAbstractButton>
#include <QDir>
#include <QProcess>
#include <QSettings>
#include <csignal>

#include "core/base/platform.h"
#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/opening_guard.h"

namespace batten {
namespace {

using test::waitUntil;

class Start : public test::WindowFixture {
 protected:
  void SetUp() override {
    QDir(MainWindow::journalFolder()).removeRecursively();
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
  }
  /// The number of a program that has gone.
  static qint64 goneProgram() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    int status = 0;
    waitpid(child, &status, 0);
    return child;
  }
  bool isOpen() { return session().hasScan() && session().scanPath() == path_ && !session().isBusy(); }
};

TEST_F(Start, AFileOnWhichTheLastStartEndedIsNotOpenedByItself) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  ASSERT_NO_FATAL_FAILURE(openWindow());
  bool isMarked = false;
  const QObject here;
  QObject::connect(&session(), &EditorSession::scanOpened, &here, [&] { isMarked = OpeningGuard::hasFailed(path_); });
  window_->openAtStart({});
  ASSERT_TRUE(waitUntil([this] { return isOpen(); })) << "the last file opens at the start";
  EXPECT_TRUE(isMarked) << "in case the program ends meanwhile";
  ASSERT_FALSE(OpeningGuard::hasFailed(path_)) << "and is marked no longer once it is there";
  // What a start leaves behind that ends while it opens the file.
  QSettings settings;
  settings.setValue(QStringLiteral("opening/path"), path_);
  settings.setValue(QStringLiteral("opening/program"), goneProgram());
  settings.sync();
  ASSERT_NO_FATAL_FAILURE(openWindow());
  window_->openAtStart({});
  auto* strip = window_->findChild<ErrorStrip*>();
  ASSERT_TRUE(waitUntil([&] { return strip->isVisible(); }));
  EXPECT_FALSE(session().hasScan());
  EXPECT_FALSE(session().isBusy());
  QAbstractButton* open = nullptr;
  for (auto* button : strip->findChildren<QAbstractButton*>())
    if (button->isVisible() && button->text() == QStringLiteral("Open it anyway")) open = button;
  ASSERT_NE(open, nullptr);
  QTest::mouseClick(open, Qt::LeftButton);
  ASSERT_TRUE(waitUntil([this] { return isOpen(); }));
  EXPECT_FALSE(strip->isVisible());
  EXPECT_FALSE(OpeningGuard::hasFailed(path_)) << "it did no harm";
}

TEST_F(Start, AFileThatAnotherWindowIsOpeningHasNotFailed) {
  const QString path = folder_.filePath(QStringLiteral("a.png"));
  const QString parent = QString::fromStdString(processMark(getppid()));
  const auto hasFailed = [&](const QString& program) {
    QSettings settings;
    settings.setValue(QStringLiteral("opening/path"), path);
    settings.setValue(QStringLiteral("opening/program"), program);
    settings.sync();
    return OpeningGuard::hasFailed(path);
  };
  EXPECT_FALSE(hasFailed(parent));
  // Numbers are given again: the same one of another time or another start of the system is another program.
  QStringList words = parent.split(QLatin1Char(' '));
  ASSERT_EQ(words.size(), 3);
  EXPECT_TRUE(hasFailed(words[0]));
  EXPECT_TRUE(hasFailed(words[0] + QStringLiteral(" 1 ") + words[2]));
  EXPECT_TRUE(hasFailed(words[0] + QLatin1Char(' ') + words[1] + QStringLiteral(" other-start")));
}

// A file that grows beyond what is allowed is a failed write, with a message: its signal must not end the program.
TEST_F(Start, TheProgramIgnoresTheSignalOfTooLargeFiles) {
  QProcess program;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
    environment.insert(QString::fromLatin1(name), folder_.path());
  program.setProcessEnvironment(environment);
  program.start(QStringLiteral(BATTEN_WINDOW), {});
  ASSERT_TRUE(program.waitForStarted());
  const auto isIgnored = [&] {
    const QString status = QString::fromLatin1(read(QStringLiteral("/proc/%1/status").arg(program.processId())));
    const QString ignored = status.section(QStringLiteral("SigIgn:"), 1).section(u'\n', 0, 0).trimmed();
    return (ignored.toULongLong(nullptr, 16) >> (SIGXFSZ - 1) & 1U) != 0;
  };
  EXPECT_TRUE(waitUntil(isIgnored, 20000));
  program.kill();
  program.waitForFinished();
}

}  // namespace
}  // namespace batten
