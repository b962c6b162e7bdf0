// SPDX-License-Identifier: GPL-3.0-or-later
// The window program in a system that has few threads left for it.
#include <QDir>
#include <QFile>
#include <QProcess>

#include "tests/ui/window_fixture.h"
#include "ui/session/background/painting_threads.h"

namespace batten {
namespace {

/// The program, in a system that lets it have so many threads at once.
class Program {
 public:
  Program(int threads, const QStringList& words) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    for (const char* variable : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
      environment.insert(QString::fromLatin1(variable), home_.path());
    environment.insert(QStringLiteral("LD_PRELOAD"), QStringLiteral(BATTEN_FEW_THREADS));
    environment.insert(QStringLiteral("BATTEN_THREADS"), QString::number(threads));
    process_.setProcessEnvironment(environment);
    process_.start(QStringLiteral(BATTEN_WINDOW), words);
  }
  ~Program() {
    process_.kill();
    process_.waitForFinished();
  }
  bool ends() {
    constexpr int kLimitMs = 20000;  // a start on a busy machine
    return process_.waitForFinished(kLimitMs);
  }
  int exitCode() const { return process_.exitStatus() == QProcess::NormalExit ? process_.exitCode() : -1; }
  bool isRunning() const { return process_.state() != QProcess::NotRunning; }
  QString said() { return QString::fromUtf8(process_.readAllStandardError()); }
  /// Among the recent files are those that the window has opened.
  bool hasOpened(const QString& name) const {
    QFile settings(home_.filePath(QStringLiteral("Batten/batten.conf")));
    return settings.open(QIODevice::ReadOnly) && settings.readAll().contains(name.toUtf8());
  }

 private:
  QTemporaryDir home_;
  QProcess process_;
};

TEST(StartThreads, TooFewAreSaidAndEndTheProgram) {
  for (int threads = 0; threads < threadsOfStart(); ++threads) {
    Program program(threads, {});
    ASSERT_TRUE(program.ends()) << "waits without end where it gets " << threads << " threads";
    EXPECT_EQ(program.exitCode(), 1);
    EXPECT_TRUE(program.said().contains(QStringLiteral("the system starts no more threads. Close other programs")));
  }
}

TEST(StartThreads, JustEnoughOpenADrawing) {
  QTemporaryDir folder;
  ASSERT_TRUE(test::zigzagPage().save(folder.filePath(QStringLiteral("page.png"))));
  Program program(threadsOfStart(), {folder.filePath(QStringLiteral("page.png"))});
  EXPECT_TRUE(test::waitUntil([&] { return program.hasOpened(QStringLiteral("page.png")) || !program.isRunning(); }));
  EXPECT_TRUE(program.hasOpened(QStringLiteral("page.png")));
  EXPECT_TRUE(program.isRunning()) << program.said().toStdString();
}

}  // namespace
}  // namespace batten
