// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTimer>

#include "core/base/platform.h"
#include "core/document/unsaved_work.h"
#include "tests/ui/window_fixture.h"
#include "ui/new_drawing_dialog.h"
#include "ui/session/files/path_text.h"
#include "ui/session/recipe_journal.h"

namespace batten {
namespace {

using test::waitUntil;

/// A session with unsaved work on an empty page, and a journal that ticks fast, in a folder of its own.
class Journal : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_.isValid());
    session_.newDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
    ASSERT_TRUE(waitUntil([&] { return session_.hasScan() && !session_.isBusy(); }));
  }
  QString folder() const { return folder_.filePath(QStringLiteral("journals")); }
  void draw(double y) {
    Recipe recipe = session_.recipe();
    recipe.penStrokes.push_back({{Vec2(10, y), Vec2(60, y + 5)}, false});
    session_.change(QStringLiteral("Draw"), recipe);
    ASSERT_TRUE(waitUntil([&] { return !session_.isBusy(); }));
  }
  static std::size_t strokesIn(const QString& path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return 0;
    const auto work = unsavedWorkFromJson(file.readAll().toStdString());
    return work ? work->recipe.penStrokes.size() : 0;
  }
  /// A journal of one stroke that a program left which has ended.
  void leaveWork(QString& file) {
    file = folder() + QStringLiteral("/left.journal");
    ASSERT_TRUE(QDir().mkpath(folder()));
    Recipe recipe = session_.recipe();
    recipe.penStrokes.push_back({{Vec2(10, 20), Vec2(60, 25)}, false});
    const std::string bytes = unsavedWorkToJson({"", recipe});
    QFile out(file);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(bytes.data(), static_cast<qint64>(bytes.size()));
  }
  /// What a second window finds to offer.
  std::optional<RecipeJournal::Left> leftToAnother() {
    EditorSession another;
    RecipeJournal journal(another, folder());
    return journal.left();
  }

  QTemporaryDir folder_;
  EditorSession session_;
};

TEST_F(Journal, AWriteThatFailsIsTriedAgain) {
  // A file where the folder is to be: nothing can be written there.
  QFile obstacle(folder());
  ASSERT_TRUE(obstacle.open(QIODevice::WriteOnly));
  obstacle.close();
  RecipeJournal journal(session_, folder());
  journal.setIntervalMs(20);
  QSignalSpy failing(&journal, &RecipeJournal::failingChanged);
  ASSERT_NO_FATAL_FAILURE(draw(20));
  auto* clock = journal.findChild<QTimer*>();
  ASSERT_NE(clock, nullptr);
  QSignalSpy ticks(clock, &QTimer::timeout);
  ASSERT_TRUE(waitUntil([&] { return ticks.count() >= 3; }, 5000));
  EXPECT_FALSE(QFile::exists(journal.file()));
  // No change follows: the next tick alone writes what is there.
  ASSERT_TRUE(QFile::remove(folder()));
  EXPECT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  ASSERT_TRUE(waitUntil([&] { return failing.count() == 2; }, 5000)) << "told once, however often it failed";
  EXPECT_TRUE(failing[0][0].toBool());
  EXPECT_FALSE(failing[1][0].toBool());
}

TEST_F(Journal, AWriteThatFailsAlthoughTheLockIsHeldIsTriedAgain) {
  RecipeJournal journal(session_, folder());
  journal.setIntervalMs(20);
  QSignalSpy failing(&journal, &RecipeJournal::failingChanged);
  ASSERT_TRUE(QDir().mkpath(journal.file()));  // a folder where the file is to be
  ASSERT_NO_FATAL_FAILURE(draw(20));
  ASSERT_TRUE(waitUntil([&] { return failing.count() == 1; }, 5000));
  ASSERT_TRUE(QFile::exists(journal.file() + QStringLiteral(".lock")));
  QSignalSpy ticks(journal.findChild<QTimer*>(), &QTimer::timeout);
  ASSERT_TRUE(waitUntil([&] { return ticks.count() >= 3; }, 5000));
  // No change follows.
  ASSERT_TRUE(QDir().rmdir(journal.file()));
  EXPECT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  EXPECT_TRUE(waitUntil([&] { return failing.count() == 2; }, 5000));
}

TEST_F(Journal, ALockWithoutAJournalGoesWithItsOwner) {
  ASSERT_TRUE(QDir().mkpath(folder()));
  const QString left = folder() + QStringLiteral("/killed.journal.lock"),
                held = folder() + QStringLiteral("/a.journal");
  for (const QString& path : {left, folder() + QStringLiteral("/notes.lock")}) {
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  }
  LockFile other(nativePath(held + QStringLiteral(".lock")));
  ASSERT_TRUE(other.hold());
  EXPECT_FALSE(leftToAnother());
  EXPECT_FALSE(QFile::exists(left));
  EXPECT_TRUE(QFile::exists(held + QStringLiteral(".lock"))) << "its program runs";
  EXPECT_TRUE(QFile::exists(folder() + QStringLiteral("/notes.lock"))) << "not ours";
}

TEST_F(Journal, AFileThatIsLostIsWrittenAnewWithItsLock) {
  RecipeJournal journal(session_, folder());
  journal.setIntervalMs(20);
  ASSERT_NO_FATAL_FAILURE(draw(20));
  ASSERT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  // Somebody puts the folder away: in one step, since the journal may be writing in it.
  ASSERT_TRUE(QDir().rename(folder(), folder_.filePath(QStringLiteral("put away"))));
  EXPECT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  EXPECT_FALSE(leftToAnother());
}

TEST_F(Journal, LiveWorkIsNeitherOfferedNorDiscardedWhenTheLockFileGoes) {
  RecipeJournal journal(session_, folder());
  journal.setIntervalMs(20);
  ASSERT_NO_FATAL_FAILURE(draw(20));
  ASSERT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  EXPECT_FALSE(leftToAnother()) << "it is held";
  // The lock's file alone is cleaned away: it is renewed at the next tick.
  const QString lock = journal.file() + QStringLiteral(".lock");
  ASSERT_TRUE(QFile::remove(lock));
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(lock); }, 5000));
  EXPECT_FALSE(leftToAnother());
  EXPECT_EQ(strokesIn(journal.file()), 1u);
}

TEST_F(Journal, LiveWorkIsNotOfferedBeforeTheLockIsRenewed) {
  RecipeJournal journal(session_, folder());  // no tick comes while this test runs
  ASSERT_NO_FATAL_FAILURE(draw(20));
  ASSERT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  ASSERT_TRUE(waitUntil([&] { return !takeAlone(journal.file().toStdString()); }, 5000));
  ASSERT_TRUE(QFile::remove(journal.file() + QStringLiteral(".lock")));
  EXPECT_FALSE(leftToAnother());
  EXPECT_EQ(strokesIn(journal.file()), 1u);
}

TEST_F(Journal, WorkThatWasTakenOverIsHeldFromThenOn) {
  QString file;
  ASSERT_NO_FATAL_FAILURE(leaveWork(file));
  EditorSession another;
  RecipeJournal journal(another, folder());
  const auto left = journal.left();
  ASSERT_TRUE(left);
  journal.takeOver(*left);
  ASSERT_TRUE(QFile::remove(file + QStringLiteral(".lock")));
  EXPECT_FALSE(leftToAnother());
}

TEST_F(Journal, WorkThatAnotherWindowHasByNowIsNeitherDiscardedNorTakenOver) {
  for (const bool isDiscarded : {true, false}) {
    QString file;
    ASSERT_NO_FATAL_FAILURE(leaveWork(file));
    EditorSession another;
    RecipeJournal journal(another, folder());
    const auto left = journal.left();
    ASSERT_TRUE(left);
    // While the offer stands, the lock is cleaned away and another window is faster.
    ASSERT_TRUE(QFile::remove(file + QStringLiteral(".lock")));
    LockFile other(nativePath(file + QStringLiteral(".lock")));
    ASSERT_TRUE(other.hold());
    isDiscarded ? journal.discard(*left) : journal.takeOver(*left);
    EXPECT_EQ(strokesIn(file), 1u);
    EXPECT_NE(journal.file(), file);
  }
}

TEST_F(Journal, ASessionWhoseFileAnotherHoldsGoesOnInAFileOfItsOwn) {
  RecipeJournal journal(session_, folder());
  journal.setIntervalMs(20);
  ASSERT_NO_FATAL_FAILURE(draw(20));
  ASSERT_TRUE(waitUntil([&] { return strokesIn(journal.file()) == 1; }, 5000));
  const QString first = journal.file();
  // Between a clean-up and the next tick another window was faster.
  ASSERT_TRUE(QFile::remove(first + QStringLiteral(".lock")));
  LockFile other(std::filesystem::path((first + QStringLiteral(".lock")).toStdU16String()));
  ASSERT_TRUE(other.hold());
  ASSERT_NO_FATAL_FAILURE(draw(40));
  EXPECT_TRUE(waitUntil([&] { return journal.file() != first && strokesIn(journal.file()) == 2; }, 5000));
  EXPECT_EQ(strokesIn(first), 1u) << "the other one's now";
}

TEST_F(Journal, HostileFilesInTheFolderAreNoWork) {
  ASSERT_TRUE(QDir().mkpath(folder()));
  QFile deep(folder() + QStringLiteral("/deep.journal"));
  ASSERT_TRUE(deep.open(QIODevice::WriteOnly));
  deep.write(QByteArray(500'000, '['));
  deep.close();
  ASSERT_TRUE(QFile::link(QStringLiteral("/dev/zero"), folder() + QStringLiteral("/endless.journal")));
  EXPECT_FALSE(leftToAnother());
}

}  // namespace
}  // namespace batten
