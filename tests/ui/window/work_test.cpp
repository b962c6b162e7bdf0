// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QLabel>
#include <cmath>

#include "tests/ui/scarce_threads.h"
#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/panels/stages/curves/method_table.h"
#include "ui/panels/targets/target_strip.h"

namespace batten {
namespace {

using test::waitUntil;

/// [ms] From the key to a processor that is free again; the machine may be busy with other things.
constexpr int kStopsWithinMs = 1500;

/// A long wavy line: its targets take a while.
QImage longPage() {
  QImage page(2600, 1000, QImage::Format_Grayscale8);
  page.fill(245);
  page.setDotsPerMeterX(11811);
  page.setDotsPerMeterY(11811);
  QPainter painter(&page);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(30, 30, 30), 5.0));
  QPolygonF line;
  for (int x = 60; x < 2540; x += 2) line << QPointF(x, 500 + 300 * std::sin(0.006 * x) + 60 * std::sin(0.021 * x));
  painter.drawPolyline(line);
  return page;
}

class Work : public test::WindowFixture {};

TEST_F(Work, WithoutThreadsTheWindowSaysSoAndGoesOnOnceItGetsOne) {
  const test::ScarceThreads scarce;
  BackgroundThreads* const usual = BackgroundThreads::replaceShared(&scarce.threads);
  openWindow();
  BackgroundThreads::replaceShared(usual);
  const QString path = folder_.filePath(QStringLiteral("long.png"));
  ASSERT_TRUE(longPage().save(path));
  window_->openPath(path);
  auto* hint = find<QLabel>("status.hint");
  ASSERT_TRUE(waitUntil([&] { return hint->text().contains(QStringLiteral("Close other programs")); }));
  EXPECT_FALSE(session().hasScan());
  *scarce.allowed = 1;
  ASSERT_TRUE(waitUntil([&] { return session().hasScan() && !session().isBusy() && !session().curves().empty(); }));
  EXPECT_FALSE(hint->text().contains(QStringLiteral("Close other programs")));
  openWindow();  // with the usual threads, before these go
}

/// Where no tile shows them, the processor is the page's: a threshold is dragged, and the curve follows.
TEST_F(Work, TheSixTargetsAreComputedWhereSomebodyLooksAtThem) {
  openPage(longPage().scaledToWidth(650, Qt::SmoothTransformation));
  const auto changeCurve = [this] {
    Recipe recipe = session().recipe();
    recipe.threshold.strength = recipe.threshold.strength == 1.0 ? 0.7 : 1.0;
    const NurbsCurve before = session().selected()->sketched;
    session().change(QStringLiteral("Contrast"), recipe);
    ASSERT_TRUE(settle());
    ASSERT_FALSE(session().selected()->sketched == before);
  };
  for (const PanelStage hidden : {PanelStage::Scan, PanelStage::Threshold, PanelStage::Edges, PanelStage::Corners}) {
    window_->setStage(hidden);
    changeCurve();
    EXPECT_FALSE(session().isTargeting()) << static_cast<int>(hidden);
    EXPECT_EQ(session().targets(), nullptr) << static_cast<int>(hidden) << ": those of the curve before";
  }
  for (const PanelStage shown : {PanelStage::Curves, PanelStage::Fairing}) {
    window_->setStage(shown);
    EXPECT_TRUE(session().isTargeting() || session().targets());
    EXPECT_TRUE(waitUntil([this] { return session().targets() && !session().isTargeting(); }));
  }
  window_->setStage(PanelStage::Edges);
  EXPECT_TRUE(session().targets()) << "they are still those of the curve";
  changeCurve();
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(session().isTargeting());
  window_->setStage(PanelStage::Edges);
  EXPECT_FALSE(session().isTargeting()) << "nobody looks any more";
  EXPECT_TRUE(waitUntil([this] { return !session().hasRunningJobs(); }));
  EXPECT_EQ(session().targets(), nullptr);
}

TEST_F(Work, EscStopsTheSixTargetsAndTheWindowSaysThatTheyRan) {
  const QString path = folder_.filePath(QStringLiteral("long.png"));
  ASSERT_TRUE(longPage().save(path));
  window_->setStage(PanelStage::Fairing);
  window_->openPath(path);
  ASSERT_TRUE(waitUntil([this] { return session().isTargeting() && !session().isBusy(); }));
  EXPECT_TRUE(session().isWorking());
  EXPECT_TRUE(find<QAbstractButton>("status.cancel")->isVisible());
  EXPECT_EQ(find<QLabel>("status.work")->text(), QStringLiteral("computing targets"));
  EXPECT_TRUE(window_->action(ActionId::CancelWork)->isEnabled());
  QElapsedTimer clock;
  clock.start();
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Escape);
  EXPECT_FALSE(session().isWorking());
  ASSERT_TRUE(waitUntil([this] { return !session().hasRunningJobs(); }));
  EXPECT_LT(clock.elapsed(), kStopsWithinMs) << "until the thread has really stopped";
  RecordProperty("escLatencyMs", static_cast<int>(clock.elapsed()));
  EXPECT_EQ(session().targets(), nullptr);
  EXPECT_EQ(find<QLabel>("status.work")->text(), QStringLiteral("stopped"));
  auto* again = find<QAbstractButton>("status.again");
  ASSERT_TRUE(again->isVisible());
  QTest::mouseClick(again, Qt::LeftButton);
  EXPECT_FALSE(again->isVisible());
  EXPECT_TRUE(waitUntil([this] { return session().targets() != nullptr; }));
}

TEST_F(Work, EscStopsTheComparisonOfMethodsToo) {
  openPage(longPage());
  session().cancel();
  ASSERT_TRUE(waitUntil([this] { return !session().hasRunningJobs(); }));
  QTest::mouseClick(find<QAbstractButton>("status.again"), Qt::LeftButton);
  window_->setStage(PanelStage::Curves);
  ASSERT_TRUE(waitUntil([this] { return session().isWorking(); }));
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Escape);
  EXPECT_FALSE(session().isWorking());
  QTest::qWait(
      50);  // what began by itself would begin in the next turns of the event loop: there is nothing to wait for
  EXPECT_FALSE(session().isWorking()) << "it does not begin again by itself";
  auto* table = find<MethodTable>("construct.method.row");
  QTest::mouseClick(find<QAbstractButton>("status.again"), Qt::LeftButton);
  for (const ConstructMethod method : kMethods)
    EXPECT_TRUE(waitUntil([&] { return table->figures(method).has_value(); })) << word(method).toStdString();
  EXPECT_TRUE(waitUntil([this] { return !session().isWorking(); }));
}

TEST_F(Work, AfterEscThereIsAWayOnAndExportSaysWhyItWaits) {
  openPage(longPage());
  window_->action(ActionId::Export)->trigger();
  ASSERT_TRUE(find<QAbstractButton>("export.run")->isEnabled());
  Recipe recipe = session().recipe();
  recipe.threshold.mode = ThresholdMode::Manual;
  recipe.threshold.manualLevel = 100.0;
  session().change(QStringLiteral("Level"), recipe);
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Escape);
  ASSERT_TRUE(session().isStale(StageId::Faired));
  EXPECT_FALSE(find<QAbstractButton>("export.run")->isEnabled());
  EXPECT_TRUE(find<QLabel>("export.note")->text().contains(QStringLiteral("stopped")));
  QTest::mouseClick(find<QAbstractButton>("export.again"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(session().isStale(StageId::Faired));
  EXPECT_TRUE(find<QAbstractButton>("export.run")->isEnabled());
}

TEST_F(Work, TheExportOfANewDrawingIsNamedAfterIt) {
  openPage(test::zigzagPage());
  window_->action(ActionId::Export)->trigger();
  auto* path = find<QLineEdit>("export.path");
  ASSERT_TRUE(QDir(folder_.path()).mkdir(QStringLiteral("out")));
  type(path, folder_.filePath(QStringLiteral("out/roof")));
  QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
  const QString roof = folder_.filePath(QStringLiteral("out/roof.svg"));
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(roof) && !find<QLabel>("export.result")->text().isEmpty(); }))
      << "the suffix is added";
  EXPECT_EQ(path->text(), roof);
  EXPECT_EQ(window_->focusWidget(), find<QAbstractButton>("export.run")) << "the focus stays where it was";
  const QString other = folder_.filePath(QStringLiteral("wing.png"));
  ASSERT_TRUE(test::ellipsePage().save(other));
  ASSERT_NO_FATAL_FAILURE(openFile(other));
  EXPECT_EQ(path->text(), folder_.filePath(QStringLiteral("out/wing.svg"))) << "the folder stays, the name does not";
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("archive"));
  ASSERT_NO_FATAL_FAILURE(openWindow());
  EXPECT_EQ(find<QComboBox>("export.preset")->currentData().toString(), QStringLiteral("archive"))
      << "the format comes back";
  ASSERT_NO_FATAL_FAILURE(openFile(other));
  EXPECT_EQ(find<QLineEdit>("export.path")->text(), folder_.filePath(QStringLiteral("out/wing.json")));
}

TEST_F(Work, AFailureToOpenOutlastsTheRunInProgressAndHelps) {
  openPage(test::zigzagPage());
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  window_->openPath(QStringLiteral("/nowhere/at/all.png"));
  auto* strip = find<ErrorStrip>("errorStrip");
  ASSERT_TRUE(waitUntil([&] { return strip->isVisible(); }));
  const QString message = strip->message();
  EXPECT_EQ(find<QAbstractButton>("error.action")->text(), QStringLiteral("Open…")) << "with a drawing open too";
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  EXPECT_EQ(strip->message(), message);
  window_->action(ActionId::Export)->trigger();
  type(find<QLineEdit>("export.path"), QStringLiteral("/nowhere/at/all.svg"));
  QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return strip->message() != message; }));
  EXPECT_EQ(find<QAbstractButton>("error.action")->text(), QStringLiteral("Choose a place…"));
  // No ink at all: the thresholds are to blame.
  Recipe recipe = session().recipe();
  recipe.contours.minLengthPx = 1e5;
  session().change(QStringLiteral("Length"), recipe);
  ASSERT_TRUE(waitUntil([&] { return session().output().error && !session().isBusy(); }));
  EXPECT_EQ(find<QAbstractButton>("error.action")->text(), QStringLiteral("Show the thresholds"));
  QTest::mouseClick(find<QAbstractButton>("error.action"), Qt::LeftButton);
  EXPECT_EQ(window_->stage(), PanelStage::Threshold);
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  EXPECT_FALSE(strip->isVisible()) << "what a run said goes with the next";
}

TEST_F(Work, ARecipeFileThatIsNoneIsRefused) {
  openPage(test::zigzagPage());
  const QString path = folder_.filePath(QStringLiteral("huge.json"));
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  ASSERT_TRUE(file.resize(qint64{200} << 20));
  file.close();
  const Recipe before = session().recipe();
  window_->openPath(path);
  auto* strip = find<ErrorStrip>("errorStrip");
  ASSERT_TRUE(waitUntil([&] { return strip->isVisible(); }));
  EXPECT_TRUE(strip->message().contains(QStringLiteral("too large")));
  EXPECT_EQ(find<QAbstractButton>("error.action")->text(), QStringLiteral("Open recipe…"));
  EXPECT_EQ(session().recipe(), before);
}

TEST_F(Work, LayersSwitchedInAPanelStayAsTheyWereLeft) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Threshold);
  auto* regions = find<QAbstractButton>("threshold.showRegions");
  ASSERT_TRUE(regions->isChecked());
  QTest::mouseClick(regions, Qt::LeftButton, {}, QPoint(8, regions->height() / 2));
  EXPECT_FALSE(window_->view().isVisible(Layer::Regions));
  window_->setStage(PanelStage::Curves);
  EXPECT_FALSE(window_->view().isVisible(Layer::Regions));
}

}  // namespace
}  // namespace batten
