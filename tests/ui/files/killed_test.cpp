// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that are killed while something is dragged: what they leave is offered by the next window, and no more than
// half a minute is lost. BATTEN_KILLS (3) is their number; every tenth, from ten on, lives longer than the journal
// waits. As many more are killed without waiting for their first journal: they may leave nothing, but nothing damaged.
#include <QDir>
#include <QElapsedTimer>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "tests/ui/window_fixture.h"
#include "ui/session/recipe_journal.h"

namespace batten {
namespace {

using test::waitUntil;

constexpr const char* kFolderVariable = "BATTEN_KILLED_FOLDER";
/// Values that the drag sets: they grow by this, so that each tells when it was set.
constexpr double kFirstFactor = 20.0, kFactorStep = 0.01, kLargestFactor = 149.0;
constexpr double kMostLostMs = 30000.0;
/// [ms] What the first journal may take on a busy machine.
constexpr int kWriteMs = 5000;

/// What a killed program did: drags the log factor for ever and says what it set, and when.
TEST(KilledChild, DISABLED_DragsUntilItIsKilled) {
  const QString folder = qEnvironmentVariable(kFolderVariable);
  ASSERT_FALSE(folder.isEmpty());
  EditorSession session;
  RecipeJournal journal(session, folder + QStringLiteral("/journals"));
  session.openScan(folder + QStringLiteral("/page.png"));
  ASSERT_TRUE(waitUntil([&] { return session.hasScan() && !session.isBusy(); }));
  const int gesture = session.newGesture();
  QElapsedTimer begin;
  begin.start();
  Recipe recipe = session.recipe();
  for (recipe.log.factor = kFirstFactor; recipe.log.factor < kLargestFactor; recipe.log.factor += kFactorStep) {
    // At the pace of a mouse, whatever the machine does.
    EXPECT_TRUE(waitUntil([&] { return begin.elapsed() >= (recipe.log.factor - kFirstFactor) / kFactorStep * 8.0; }));
    session.change(QStringLiteral("Log factor"), recipe, gesture);
    std::cout << recipe.log.factor << std::endl;
  }
}

struct Victim {
  std::unique_ptr<QTemporaryDir> folder = std::make_unique<QTemporaryDir>();
  std::unique_ptr<QProcess> program = std::make_unique<QProcess>();
  int livesMs = 0;
  bool isHasty = false;  ///< Killed at its time, whether its first journal is there or not.
  QElapsedTimer since;   ///< Its first change.
  struct Change {
    double factor;
    qint64 ms;
  };
  std::vector<Change> changes;
  bool isKilled = false;

  void start() {
    test::zigzagPage().save(folder->filePath(QStringLiteral("page.png")));
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QString::fromLatin1(kFolderVariable), folder->path());
    environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
    program->setProcessEnvironment(environment);
    program->setProcessChannelMode(QProcess::MergedChannels);
    program->start(QCoreApplication::applicationFilePath(),
                   {QStringLiteral("--gtest_also_run_disabled_tests"), QStringLiteral("--gtest_filter=KilledChild.*")});
  }
  /// Reads what it says; kills it when its time has come.
  void watch() {
    while (!isKilled && program->canReadLine()) {
      bool isNumber = false;
      const double factor = program->readLine().trimmed().toDouble(&isNumber);
      if (!isNumber) continue;
      if (!since.isValid()) since.start();
      changes.push_back({factor, since.elapsed()});
    }
    if (isKilled || !since.isValid() || since.elapsed() < livesMs) return;
    if (!isHasty && !hasJournal() && since.elapsed() < kWriteMs) return;
    isKilled = true;
    program->kill();  // SIGKILL: it cannot say goodbye
  }
  QString journals() const { return folder->filePath(QStringLiteral("journals")); }
  bool hasJournal() const { return !QDir(journals()).entryList({QStringLiteral("*.journal")}, QDir::Files).isEmpty(); }
  bool isOver() const { return isKilled && program->state() == QProcess::NotRunning; }
};

/// Half of them hasty; those that live longest first: they live side by side.
std::vector<Victim> victimsOf(int count) {
  std::mt19937 random(5);
  std::vector<Victim> victims(2 * count);
  for (int i = 0; i < std::ssize(victims); ++i) {
    victims[i].isHasty = i >= count;
    const bool isLong = count >= 10 && i % 10 == 0 && !victims[i].isHasty;
    const int shortMs = static_cast<int>(random() % (victims[i].isHasty ? 200 : 2500));
    victims[i].livesMs = isLong ? RecipeJournal::kIntervalMs + static_cast<int>(random() % 15000) : shortMs;
  }
  std::stable_sort(victims.begin(), victims.end(), [](const Victim& a, const Victim& b) {
    return a.livesMs / RecipeJournal::kIntervalMs > b.livesMs / RecipeJournal::kIntervalMs;
  });
  return victims;
}

/// Starts them, a few at once, and watches until all are dead; false where that takes too long.
bool areKilled(std::vector<Victim>& victims) {
  constexpr int kAtOnce = 4, kLimitMs = 600000;
  std::size_t started = 0;
  return waitUntil(
      [&] {
        int running = 0;
        for (std::size_t i = 0; i < started; ++i) {
          victims[i].watch();
          running += victims[i].isOver() ? 0 : 1;
        }
        while (started < victims.size() && running < kAtOnce) {
          victims[started++].start();
          ++running;
        }
        return running == 0;
      },
      kLimitMs);
}

/// Offers back what one has left. @return [ms] the work that is lost; absent: nothing is offered.
std::optional<double> lostOf(const Victim& victim) {
  EditorSession session;
  const bool hasJournal = victim.hasJournal();
  RecipeJournal journal(session, victim.journals());
  const auto left = journal.left();
  // What is there is whole, whenever the program died.
  EXPECT_EQ(left.has_value(), hasJournal) << "killed after " << victim.livesMs << " ms";
  EXPECT_TRUE(left || victim.isHasty) << "nothing is offered after " << victim.livesMs << " ms";
  if (!left) return std::nullopt;
  session.restore(left->scanPath, left->recipe);
  EXPECT_TRUE(waitUntil([&] { return session.hasScan() && !session.isBusy(); }));
  EXPECT_TRUE(session.hasUnsavedChanges());
  EXPECT_FALSE(session.curves().empty());
  // What was set until the kill, less what the journal holds.
  double lost = static_cast<double>(victim.changes.back().ms);
  for (const auto& change : victim.changes)
    if (change.factor <= left->recipe.log.factor + 0.5 * kFactorStep)
      lost = static_cast<double>(victim.changes.back().ms - change.ms);
  return lost;
}

class Killed : public test::WindowFixture {};

TEST_F(Killed, TheWorkOfADragIsOfferedBack) {
  bool isNumber = false;
  const int asked = qEnvironmentVariableIntValue("BATTEN_KILLS", &isNumber);
  const int count = isNumber && asked > 0 ? asked : 3;
  std::vector<Victim> victims = victimsOf(count);
  ASSERT_TRUE(areKilled(victims));

  double mostLost = 0.0;
  int offered = 0, offeredHasty = 0;
  for (const Victim& victim : victims) {
    ASSERT_FALSE(victim.changes.empty());
    const auto lost = lostOf(victim);
    ASSERT_FALSE(HasFailure());
    if (!lost) continue;
    ++(victim.isHasty ? offeredHasty : offered);
    mostLost = std::max(mostLost, *lost);
  }
  std::cout << offered << " of " << count << " killed programs: work offered back, at most " << mostLost / 1000.0
            << " s lost; of those killed within 0.2 s of a drag, " << offeredHasty << "\n";
  EXPECT_EQ(offered, count);
  EXPECT_LE(mostLost, kMostLostMs);
}

}  // namespace
}  // namespace batten
