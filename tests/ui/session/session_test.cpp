// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <atomic>
#include <memory>
#include <set>
#include <thread>

#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/piece_choices.h"
#include "tests/ui/rendered_scan.h"
#include "ui/commands/action_catalog.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/discarded_values.h"

namespace batten {
namespace {

using test::OpenSession;
using test::waitUntil;

Recipe withFactor(const Recipe& recipe, double factor) {
  Recipe changed = recipe;
  changed.log.factor = factor;
  return changed;
}

TEST(EditorSession, OpensAScanAndTracesIt) {
  OpenSession open(test::zigzagPage());
  ASSERT_TRUE(open.isReady);
  const auto& output = open.session.output();
  ASSERT_FALSE(output.error) << output.error->message;
  EXPECT_EQ(open.session.scan()->grey.width, 640);
  ASSERT_FALSE(open.session.curves().empty());
  EXPECT_NE(open.session.selected(), nullptr) << "the longest curve is selected at the start";
  for (const StageId stage : kStages) EXPECT_FALSE(open.session.isStale(stage)) << name(stage);
  EXPECT_TRUE(waitUntil([&] { return open.session.targets() != nullptr; }));
}

TEST(EditorSession, OpensADrawingWithTheRecipeBesideIt) {
  QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("page.png"));
  ASSERT_TRUE(test::zigzagPage().save(path));
  Recipe saved = withFactor(Recipe{}, 77.0);
  saved.cornerMarks = {{Vec2(200.0, 100.0)}};
  QFile file(folder.filePath(QStringLiteral("page.recipe.json")));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(recipeToJson(saved)));
  file.close();
  EditorSession session;
  session.openScan(path);
  ASSERT_TRUE(waitUntil([&] { return session.hasScan() && !session.isBusy(); }));
  EXPECT_TRUE(session.openedWithRecipe());
  EXPECT_EQ(session.recipe(), saved);
  EXPECT_EQ(session.undoStack()->count(), 0) << "opening is nothing to undo";
  ASSERT_TRUE(session.output().pieces);
  EXPECT_TRUE(session.output().pieces->lostMarks.empty());
}

TEST(EditorSession, ADamagedRecipeBesideADrawingIsNamedAndLeftOut) {
  QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("page.png"));
  ASSERT_TRUE(test::zigzagPage().save(path));
  QFile file(folder.filePath(QStringLiteral("page.recipe.json")));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"format\": \"batten-rec");
  file.close();
  EditorSession session;
  session.openScan(path);
  ASSERT_TRUE(waitUntil([&] { return session.hasScan() && !session.isBusy(); }));
  EXPECT_FALSE(session.openedWithRecipe());
  EXPECT_EQ(session.recipe(), Recipe{});
  EXPECT_TRUE(session.openProblem().contains(QStringLiteral("page.recipe.json")))
      << session.openProblem().toStdString();
  EXPECT_FALSE(session.curves().empty());
}

TEST(EditorSession, AScanThatCannotBeReadLeavesTheOpenOne) {
  OpenSession open(test::zigzagPage());
  ASSERT_TRUE(open.isReady);
  const auto before = open.session.scan();
  const auto curves = open.session.curves().size();
  QSignalSpy failed(&open.session, &EditorSession::failed);
  open.session.openScan(QStringLiteral("/nowhere/at/all.png"));
  ASSERT_TRUE(waitUntil([&] { return failed.count() > 0 && !open.session.isBusy(); }));
  const QString message = QString::fromStdString(failed.first().first().value<Error>().message);
  EXPECT_FALSE(message.isEmpty());
  EXPECT_FALSE(message.contains(QLatin1Char('\n')));
  EXPECT_EQ(open.session.scan(), before);
  EXPECT_EQ(open.session.curves().size(), curves);
}

TEST(EditorSession, ChangesOfOneGestureAreOneUndoStep) {
  EditorSession session;
  const Recipe start = session.recipe();
  const int gesture = session.newGesture();
  for (double factor = 50.0; factor <= 80.0; factor += 5.0)
    session.change("Log factor", withFactor(start, factor), gesture);
  EXPECT_EQ(session.undoStack()->count(), 1);
  EXPECT_EQ(session.recipe().log.factor, 80.0);
  session.change("Log factor", withFactor(start, 90.0), session.newGesture());
  EXPECT_EQ(session.undoStack()->count(), 2);
  session.undoStack()->undo();
  EXPECT_EQ(session.recipe().log.factor, 80.0);
  session.undoStack()->undo();
  EXPECT_EQ(session.recipe(), start);
  session.undoStack()->redo();
  EXPECT_EQ(session.recipe().log.factor, 80.0);
}

TEST(EditorSession, ChangesWithoutGestureStaySeparate) {
  EditorSession session;
  const Recipe start = session.recipe();
  session.change("Log factor", withFactor(start, 50.0));
  session.change("Log factor", withFactor(start, 60.0));
  EXPECT_EQ(session.undoStack()->count(), 2);
  session.change("Log factor", withFactor(start, 60.0));
  EXPECT_EQ(session.undoStack()->count(), 2) << "no change, no step";
}

TEST(EditorSession, AGestureThatReturnsLeavesNoStep) {
  EditorSession session;
  const Recipe start = session.recipe();
  const int gesture = session.newGesture();
  session.change("Log factor", withFactor(start, 70.0), gesture);
  session.change("Log factor", start, gesture);
  EXPECT_EQ(session.undoStack()->count(), 0);
  EXPECT_EQ(session.recipe(), start);
}

TEST(EditorSession, TheNewestOfManyChangesIsWhatShows) {
  OpenSession open(test::zigzagPage());
  ASSERT_TRUE(open.isReady);
  QSignalSpy finished(&open.session, &EditorSession::runFinished);
  const Recipe start = open.session.recipe();
  const int gesture = open.session.newGesture();
  for (int i = 0; i < 40; ++i) {
    Recipe recipe = start;
    recipe.threshold.mode = ThresholdMode::Manual;
    recipe.threshold.manualLevel = 90.0 + i;
    open.session.change("Level", recipe, gesture);
    EXPECT_TRUE(open.session.isStale(StageId::Thresholds));
    QCoreApplication::processEvents();
  }
  ASSERT_TRUE(open.settle());
  ASSERT_TRUE(open.session.output().thresholds);
  for (const double level : open.session.output().thresholds->level) EXPECT_EQ(level, 129.0);
  EXPECT_EQ(finished.count(), 1) << "only the newest run reports its end";
  for (const StageId stage : kStages) EXPECT_FALSE(open.session.isStale(stage)) << name(stage);

  // The same recipe from scratch gives the same curves: no stale part was mixed in.
  StageCache cache;
  const auto fresh = runPipeline(*open.session.scan(), open.session.recipe(), cache, {}, {});
  ASSERT_TRUE(fresh.faired);
  ASSERT_EQ(fresh.faired->curves.size(), open.session.curves().size());
  for (std::size_t i = 0; i < fresh.faired->curves.size(); ++i)
    EXPECT_TRUE(fresh.faired->curves[i].faired == open.session.curves()[i].faired) << i;
}

TEST(EditorSession, CancelStopsAndKeepsWhatThereIs) {
  OpenSession open(test::zigzagPage({2400, 1600}));
  ASSERT_TRUE(open.isReady);
  const auto before = open.session.output().faired;
  Recipe recipe = open.session.recipe();
  recipe.threshold.mode = ThresholdMode::Manual;
  recipe.threshold.manualLevel = 100.0;
  open.session.change("Level", recipe);
  ASSERT_TRUE(open.session.isBusy());
  open.session.cancel();
  EXPECT_FALSE(open.session.isBusy()) << "cancelling never waits";
  EXPECT_EQ(open.session.output().faired, before);
  EXPECT_TRUE(open.session.isStale(StageId::Faired));
  // The next change works as ever.
  open.session.undoStack()->undo();
  ASSERT_TRUE(open.settle());
  EXPECT_FALSE(open.session.isStale(StageId::Faired));
}

TEST(EditorSession, ClosesWhileItWorks) {
  const QImage page = test::zigzagPage({2400, 1600});
  QTemporaryDir folder;
  const QString path = folder.filePath("page.png");
  ASSERT_TRUE(page.save(path));
  auto session = std::make_unique<EditorSession>();
  session->openScan(path);
  ASSERT_TRUE(waitUntil([&] { return session->hasScan(); }));
  EXPECT_TRUE(session->isBusy());
  // Another session, opened afterwards, gets all its stages while the abandoned run ends: nothing of the first one is
  // posted to an object that is gone (address sanitizer too), nor told while it goes, and no job of it keeps its scan.
  int delivered = 0;
  QObject::connect(session.get(), &EditorSession::stageReady, qApp, [&delivered] { ++delivered; });
  QObject::connect(session.get(), &EditorSession::runFinished, qApp, [&delivered] { ++delivered; });
  const std::weak_ptr<const Scan> scan = session->scan();
  const int beforeItsDeath = delivered;
  QElapsedTimer closing;
  closing.start();
  session.reset();
  EXPECT_LT(closing.elapsed(), 2000) << "closing waits at most for the step that runs";
  OpenSession next(test::zigzagPage());
  ASSERT_TRUE(next.isReady);
  EXPECT_FALSE(next.session.isStale(StageId::Faired));
  EXPECT_TRUE(waitUntil([&] { return scan.expired(); })) << "something still works on the closed drawing";
  EXPECT_EQ(delivered, beforeItsDeath) << "stages of the closed drawing were delivered";
}

TEST(EditorSession, TheSelectionStaysWithItsPlace) {
  QImage page = test::zigzagPage();
  {
    QPainter painter(&page);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(30, 30, 30), 5.0));
    painter.drawArc(QRectF(440, 260, 140, 100), 0, 180 * 16);
  }
  OpenSession open(page);
  ASSERT_TRUE(open.isReady);
  ASSERT_GE(open.session.curves().size(), 2u);
  open.session.selectCurve(static_cast<int>(open.session.curves().size()) - 1);
  const Vec2 middle = anchorOf(open.session.output().pieces->pieces[open.session.selected()->piece]);
  Recipe recipe = open.session.recipe();
  recipe.cornerMarks = {{Vec2(200, 100)}, {Vec2(400, 300)}};
  open.session.change("Corners", recipe);
  ASSERT_TRUE(open.settle());
  ASSERT_NE(open.session.selected(), nullptr);
  const auto& piece = open.session.output().pieces->pieces[open.session.selected()->piece];
  double nearest = 1e9;
  for (const PiecePoint& point : piece.points) nearest = std::min(nearest, (point.at - middle).norm());
  EXPECT_LT(nearest, 2.0);
}

TEST(BackgroundWorker, RunsTheNewestAndDropsWhatWaited) {
  std::atomic<int> ran{0};
  std::atomic<bool> firstStarted{false}, release{false}, firstSawCancel{false}, lastRan{false};
  {
    BackgroundWorker worker;
    worker.start([&](const CancelToken& token) {
      firstStarted = true;
      while (!release) std::this_thread::yield();
      firstSawCancel = token.isCancelled();
      ++ran;
    });
    while (!firstStarted) std::this_thread::yield();
    for (int i = 0; i < 10; ++i) worker.start([&](const CancelToken&) { ++ran; });
    worker.start([&](const CancelToken&) { ++ran, lastRan = true; });
    release = true;
    while (!lastRan) std::this_thread::yield();
  }
  EXPECT_TRUE(firstSawCancel);
  EXPECT_EQ(ran, 2) << "the first and the last";
}

TEST(BackgroundWorker, SurvivesAJobThatThrows) {
  std::atomic<bool> ran{false};
  BackgroundWorker worker;
  worker.start([](const CancelToken&) { throw std::bad_alloc(); });
  worker.start([&](const CancelToken&) { ran = true; });
  while (!ran) std::this_thread::yield();
  EXPECT_TRUE(ran);
}

TEST(ActionCatalog, HasEveryActionOnceWithTextAndHelp) {
  std::set<std::string> names;
  std::set<QString> shortcuts;
  for (const ActionInfo& info : actionCatalog()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.text.isEmpty()) << info.name;
    EXPECT_TRUE(info.help.endsWith(QLatin1Char('.'))) << info.name;
    for (const QKeySequence& key : info.shortcuts) {
      EXPECT_FALSE(key.isEmpty()) << info.name;
      EXPECT_TRUE(shortcuts.insert(key.toString()).second) << info.name << " shares " << key.toString().toStdString();
    }
  }
  for (const Layer layer : kLayers) EXPECT_EQ(layerOf(showAction(layer)), layer);
  EXPECT_EQ(targetOf(ActionId::Target4), 4);
  EXPECT_FALSE(targetOf(ActionId::Undo));
}

int numberAt(const EditorSession& session, const Vec2& px) {
  const auto curves = session.curves();
  int number = 0;
  double nearest = 8.0;
  for (const TracedCurve& curve : curves) {
    for (const Vec2& p : positionsOf(session.output().pieces->pieces[curve.piece].points)) {
      if ((p - px).norm() >= nearest) continue;
      nearest = (p - px).norm();
      number = curveNumber(session.output(), curve);
    }
  }
  return number;
}

void paintThreeLines(QPainter& painter) {
  painter.drawLines({QLineF(60, 80, 560, 90), QLineF(60, 180, 560, 190), QLineF(60, 280, 560, 330)});
}

/// Beside the drawing, where a session that opens it finds it.
void saveBeside(const OpenSession& open, const Recipe& recipe) {
  QFile file(open.folder.filePath(QStringLiteral("page.recipe.json")));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(recipeToJson(recipe)));
}

TEST(EditorSession, CurvesKeepTheirNumbersThroughEditsUndoAndTheFile) {
  OpenSession open(test::drawnPage({640, 400}, paintThreeLines));
  ASSERT_TRUE(open.isReady);
  EditorSession& session = open.session;
  const Vec2 upper(300, 84.8), middle(300, 184.8), left(100, 284), right(500, 324);
  const int one = numberAt(session, upper), two = numberAt(session, middle), three = numberAt(session, left);
  EXPECT_EQ((std::set{one, two, three}), (std::set{1, 2, 3}));
  const Recipe start = session.recipe();

  // Only the lower half of the page: the line above the others is gone, and the numbers do not move up.
  Recipe changed = start;
  changed.regions = {rectangleRegion({0, 130}, {640, 400})};
  session.change(QStringLiteral("Region"), changed);
  ASSERT_TRUE(open.settle());
  EXPECT_EQ(session.curves().size(), 2u);
  EXPECT_EQ(numberAt(session, middle), two);
  EXPECT_EQ(numberAt(session, left), three);

  // A corner divides the lower line: its longer part keeps the number, the other is a new one.
  changed.cornerMarks = {{Vec2(160, 290)}};
  session.change(QStringLiteral("Corner"), changed);
  ASSERT_TRUE(open.settle());
  EXPECT_EQ(numberAt(session, right), three);
  EXPECT_EQ(numberAt(session, left), 4);
  EXPECT_EQ(session.recipe(), changed) << "numbers are no change that could be undone";

  session.undoStack()->undo();
  session.undoStack()->undo();
  ASSERT_TRUE(open.settle());
  EXPECT_EQ(numberAt(session, upper), one);
  EXPECT_EQ(numberAt(session, left), three);
  EXPECT_EQ(session.recipeToSave().curveNumbers.lastGiven, 4);

  // A line drawn now does not get the number that the part had.
  changed = start;
  changed.penStrokes = {{{Vec2(60, 360), Vec2(200, 362), Vec2(400, 364)}}};
  session.change(QStringLiteral("Line"), changed);
  ASSERT_TRUE(open.settle());
  EXPECT_EQ(numberAt(session, Vec2(200, 362)), 5);

  // From the file, without the line above: as before.
  Recipe saved = session.recipeToSave();
  saved.regions = {rectangleRegion({0, 130}, {640, 400})};
  ASSERT_NO_FATAL_FAILURE(saveBeside(open, saved));
  EditorSession again;
  again.openScan(open.path());
  ASSERT_TRUE(waitUntil([&] { return again.hasScan() && !again.isBusy(); }));
  EXPECT_EQ(numberAt(again, middle), two);
  EXPECT_EQ(numberAt(again, left), three);
  EXPECT_EQ(numberAt(again, Vec2(200, 362)), 5);
  again.change(QStringLiteral("Region"), [&] {
    Recipe recipe = again.recipe();
    recipe.regions.clear();
    return recipe;
  }());
  ASSERT_TRUE(waitUntil([&] { return !again.isBusy(); }));
  EXPECT_EQ(numberAt(again, upper), one) << "a line that comes back is called as before";
}

TEST(DiscardedValues, FreeOnlyWhatTheyGotHoweverLate) {
  // The worker is held up by a value that takes long to free, as a large page is, until the next drawing has stored.
  struct Slow {
    std::shared_ptr<std::atomic<bool>> mayGo;
    ~Slow() {
      while (mayGo && !*mayGo) std::this_thread::yield();
    }
  };
  StageCache cache;
  const auto key = [](int i) { return HashBuilder().integer(i).finish(); };
  const auto mayGo = std::make_shared<std::atomic<bool>>(false);
  const auto old = std::make_shared<const int>(1);
  std::weak_ptr<const int> watched = old;
  {
    DiscardedValues discarded;
    const auto slow = std::make_shared<Slow>();
    slow->mayGo = mayGo;
    discarded.discard(slow);
    cache.store(key(1), old, 8);
    struct Old {
      std::vector<std::shared_ptr<const void>> stages;
    };
    discarded.discard(std::make_shared<const Old>(Old{cache.release()}));
    cache.store(key(2), std::make_shared<const int>(2), 8);
    *mayGo = true;
    EXPECT_TRUE(waitUntil([&] { return !discarded.isBusy(); }));
  }
  EXPECT_EQ(cache.find<int>(key(1)), nullptr);
  ASSERT_NE(cache.find<int>(key(2)), nullptr) << "the next drawing's stages stay";
  EXPECT_EQ(*cache.find<int>(key(2)), 2);
  EXPECT_EQ(watched.use_count(), 1) << "only this test still holds it";
}

}  // namespace
}  // namespace batten
