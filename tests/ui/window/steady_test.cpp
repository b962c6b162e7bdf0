// SPDX-License-Identifier: GPL-3.0-or-later
// What stays in its place while its contents change, and the order in which the keys walk through it.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QDir>
#include <QLabel>
#include <QLayout>
#include <QListWidget>
#include <QTableWidget>
#include <QUndoStack>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/document/unsaved_work.h"
#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/new_drawing_dialog.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/targets/target_tile.h"

namespace batten {
namespace {

using test::mixedPage;
using test::waitUntil;

class Steady : public test::WindowFixture {
 protected:
  void TearDown() override {
    window_.reset();
    QDir(MainWindow::journalFolder()).removeRecursively();
  }
  void pressInCanvas(int key) {
    auto* canvas = find<CurveCanvas>("canvas");
    canvas->setFocus();
    QTest::keyClick(canvas, static_cast<Qt::Key>(key));
  }
  CurveList* fairingList() { return find<QWidget>("panel.fairing")->findChild<CurveList*>(); }
  /// Where in the panel what can be clicked stands now.
  std::map<std::string, int> places() {
    EXPECT_TRUE(settleLayout());
    std::map<std::string, int> all;
    auto* panel = find<QWidget>("panel.fairing");
    for (const auto* button : panel->findChildren<QAbstractButton*>())
      if (button->isVisible() && button->objectName().startsWith(QStringLiteral("fairing.")))
        all[button->objectName().toStdString()] = button->mapTo(panel, QPoint(0, 0)).y();
    all["list"] = fairingList()->mapTo(panel, QPoint(0, 0)).y();
    return all;
  }
};

TEST_F(Steady, LinksAndListOfFairingStayWhileTargetsAndCurvesChange) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  ASSERT_EQ(session().curves().size(), 3u);
  window_->resize(1366, 1000);
  window_->setStage(PanelStage::Fairing);
  QTest::mouseClick(find<QAbstractButton>("fairing.mode.target"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  const auto before = places();
  EXPECT_GT(before.size(), 8u);
  const auto expectSame = [&](const std::string& when) {
    for (const auto& [name, y] : places()) {
      const auto was = before.find(name);
      if (was == before.end()) continue;
      EXPECT_EQ(y, was->second) << name << " " << when;
    }
  };
  const auto settleTargets = [this] { return settle() && waitUntil([this] { return !session().isTargeting(); }); };
  for (int row = 0; row < 3; ++row) {
    QTest::mouseClick(fairingList()->viewport(), Qt::LeftButton, {},
                      fairingList()->visualItemRect(fairingList()->item(row)).center());
    ASSERT_TRUE(settleTargets());
    ASSERT_EQ(session().selectedCurve(), row);
    expectSame("curve " + std::to_string(row));
    for (const int degree : {1, 3, 6}) {
      pressInCanvas(Qt::Key_0 + degree);
      ASSERT_TRUE(settleTargets());
      expectSame("target " + std::to_string(degree) + " of curve " + std::to_string(row));
    }
  }
  QTest::mouseClick(find<QAbstractButton>("fairing.logAesthetic"), Qt::LeftButton);
  ASSERT_TRUE(settleTargets());
  expectSame("log-aesthetic");
  QTest::mouseClick(find<QAbstractButton>("fairing.draw"), Qt::LeftButton);
  ASSERT_TRUE(settleTargets());
  expectSame("drawn");
  // A curve with a choice of its own among curves without.
  QTest::mouseClick(find<QAbstractButton>("fairing.scope.one"), Qt::LeftButton);
  pressInCanvas(Qt::Key_4);
  ASSERT_TRUE(settleTargets());
  EXPECT_TRUE(find<QAbstractButton>("fairing.useForAll")->isEnabled());
  expectSame("own choice");
  session().selectCurve(0);
  ASSERT_TRUE(settleTargets());
  expectSame("another curve");
}

TEST_F(Steady, MoreCurvesDoNotMoveWhatIsBelowTheirList) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    for (int i = 0; i < 14; ++i) painter.drawLine(20 + 25 * i, 60, 24 + 25 * i, 340);
  })));
  ASSERT_EQ(session().curves().size(), 14u);
  window_->resize(1366, 1100);
  for (const PanelStage stage : {PanelStage::Fairing, PanelStage::Curves}) {
    window_->setStage(stage);
    auto* panel = find<QWidget>(("panel." + key(stage).toStdString()).c_str());
    auto* below = panel->findChild<QWidget*>(stage == PanelStage::Fairing ? QStringLiteral("fairing.compare")
                                                                          : QStringLiteral("curves.showExplained"));
    ASSERT_NE(below, nullptr);
    const auto place = [&] {
      EXPECT_TRUE(settleLayout());
      return below->mapTo(panel, QPoint(0, 0)).y();
    };
    const int before = place();
    Recipe recipe = session().recipe();
    for (int i = 0; i < 6; ++i)
      recipe.penStrokes.push_back({{Vec2(400 + 25 * i, 60), Vec2(402 + 25 * i, 200), Vec2(404 + 25 * i, 340)}, false});
    session().change(QStringLiteral("Draw"), recipe);
    ASSERT_TRUE(settle());
    ASSERT_EQ(session().curves().size(), 20u);
    EXPECT_EQ(place(), before) << key(stage).toStdString();
    session().undoStack()->undo();
    ASSERT_TRUE(settle());
    EXPECT_EQ(place(), before) << key(stage).toStdString();
  }
}

TEST_F(Steady, NoControlMovesWhenAMessageComesOrGoes) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  window_->setStage(PanelStage::Fairing);
  auto* strip = find<ErrorStrip>("errorStrip");
  const auto places = [&] {
    EXPECT_TRUE(settleLayout());
    std::map<const QWidget*, QRect> all;
    for (const auto* widget : window_->findChildren<QWidget*>())
      if (widget->isVisible() && widget != strip && !strip->isAncestorOf(widget))
        all[widget] = QRect(widget->mapTo(window_.get(), QPoint(0, 0)), widget->size());
    return all;
  };
  for (const int width : {960, 1366}) {
    window_->resize(width, 768);
    // The line at the bottom has a button as long as something is computed.
    ASSERT_TRUE(waitUntil([&] { return window_->width() == width && !session().isWorking(); }));
    const auto before = places();
    strip->show(QStringLiteral("A long message that says what is wrong and what can be done about it. ").repeated(3),
                QStringLiteral("Do it"));
    EXPECT_EQ(places(), before);
    const auto on = [&](const QWidget* widget) {
      return QRect(widget->mapTo(window_.get(), QPoint(0, 0)), widget->size());
    };
    const QRect canvas = on(find<QWidget>("canvas"));
    EXPECT_EQ(on(strip).topLeft(), canvas.topLeft());
    EXPECT_EQ(strip->width(), canvas.width());
    EXPECT_LT(strip->height(), canvas.height() / 2);
    EXPECT_GE(strip->height(), find<QLabel>("error.text")->heightForWidth(find<QLabel>("error.text")->width()));
    strip->hide();
    EXPECT_EQ(places(), before);
  }
}

TEST_F(Steady, SavedProfilesGrowWhereNothingIsBelowThem) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  window_->setStage(PanelStage::Fairing);
  auto* panel = find<QWidget>("panel.fairing");
  auto* shelf = find<QListWidget>("fairing.profiles");
  EXPECT_GT(panel->layout()->indexOf(shelf), panel->layout()->indexOf(fairingList()));
}

// In lower windows the plot keeps 200 px with its numbers (Layout).
TEST_F(Steady, TheAxesOfThePlotKeep200PixelsInAWindowOf768) {
  constexpr int kMarginsPx = 40;  // of the axes, for their names and numbers
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  for (const int height : {768, 800, 850, 900}) {
    window_->resize(1366, height);
    ASSERT_TRUE(waitUntil([&] { return window_->height() == height; }, 5000));
    for (const PanelStage stage : {PanelStage::Curves, PanelStage::Fairing}) {
      window_->setStage(stage);
      auto* plot = find<QWidget>("plot");
      EXPECT_TRUE(waitUntil([&] { return plot->height() >= 200 + kMarginsPx; }, 3000)) << plot->height();
      EXPECT_GE(find<CurveCanvas>("canvas")->height(), height < 800 ? 0.48 * height - 1 : height / 2 - 1);
    }
  }
}

TEST_F(Steady, TilesSayTheSimilarityOnASmallScreenToo) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  for (const int width : {1366, 1920}) {
    window_->resize(width, 740);
    ASSERT_TRUE(waitUntil([&] { return window_->width() == width; }, 5000));
    ASSERT_TRUE(settleLayout());
    for (const TargetTile* tile : window_->findChildren<TargetTile*>())
      EXPECT_TRUE(tile->showsSimilarity()) << tile->objectName().toStdString() << " at " << width;
  }
}

TEST_F(Steady, ANarrowListKeepsTheNamesAndLeavesTheControlPointsOut) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  window_->setStage(PanelStage::Curves);
  auto* list = find<QWidget>("panel.curves")->findChild<CurveList*>();
  ASSERT_TRUE(waitUntil([&] { return !list->item(0)->data(CurveList::kBadgeRole).toString().isEmpty(); }));
  EXPECT_TRUE(list->columns().hasPoints);
  for (int width = list->width(); width > 120 && list->columns().hasPoints; width -= 4) {
    list->setFixedWidth(width);
    QCoreApplication::processEvents();
  }
  EXPECT_FALSE(list->columns().hasPoints);
  for (int row = 0; row < list->count(); ++row)
    EXPECT_TRUE(list->shownName(row).startsWith(QStringLiteral("Curve"))) << list->shownName(row).toStdString();
}

TEST_F(Steady, AnErrorCoversTheOfferOfUnsavedWorkOnlyUntilItIsDismissed) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  {
    EditorSession lost;
    lost.newDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
    ASSERT_TRUE(waitUntil([&] { return lost.hasScan() && !lost.isBusy(); }));
    Recipe recipe = lost.recipe();
    recipe.penStrokes.push_back({{Vec2(10, 20), Vec2(60, 25)}, false});
    ASSERT_TRUE(QDir().mkpath(MainWindow::journalFolder()));
    QFile file(MainWindow::journalFolder() + QStringLiteral("/lost.journal"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    UnsavedWork work;
    work.recipe = recipe;
    file.write(QByteArray::fromStdString(unsavedWorkToJson(work)));
  }
  ASSERT_TRUE(window_->offerLeftWork());
  auto* strip = find<ErrorStrip>("errorStrip");
  const QString offer = strip->message();
  EXPECT_TRUE(offer.contains(QStringLiteral("Unsaved work"))) << offer.toStdString();
  window_->openPath(folder_.filePath(QStringLiteral("is-not-there.png")));
  ASSERT_TRUE(waitUntil([&] { return !strip->message().isEmpty() && strip->message() != offer; }, 5000));
  QTest::mouseClick(find<QAbstractButton>("error.dismiss"), Qt::LeftButton);
  EXPECT_EQ(strip->message(), offer);
  window_->openPath(folder_.filePath(QStringLiteral("is-not-there.png")));
  ASSERT_TRUE(waitUntil([&] { return strip->message() != offer; }, 5000));
  pressInCanvas(Qt::Key_Escape);
  EXPECT_EQ(strip->message(), offer) << "after Esc, too";
  QTest::mouseClick(find<QAbstractButton>("error.dismiss"), Qt::LeftButton);
  EXPECT_TRUE(strip->message().isEmpty()) << "discarded";
}

TEST_F(Steady, TheDarkThemeIsDarkBeforeADrawingIsOpen) {
  auto* canvas = find<CurveCanvas>("canvas");
  window_->setThemeChoice(ThemeChoice::Dark);
  QImage dark;
  EXPECT_TRUE(waitUntil(
      [&] {
        dark = canvas->grab().toImage();
        return qGray(dark.pixel(3, canvas->height() / 2)) < 80;
      },
      5000));
  window_->setThemeChoice(ThemeChoice::Light);
  int least = 255, most = 0;
  for (int x = canvas->width() / 2 - 180; x < canvas->width() / 2 + 180; ++x) {
    for (int y = canvas->height() / 2 - 20; y < canvas->height() / 2 + 20; ++y) {
      least = std::min(least, qGray(dark.pixel(x, y)));
      most = std::max(most, qGray(dark.pixel(x, y)));
    }
  }
  EXPECT_LT(least, 80) << "the box of the invitation";
  EXPECT_GT(most, 180) << "its words";
}

TEST_F(Steady, TheDarkThemeHasADarkDeskAndTheSamePage) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage({400, 400})));
  window_->setStage(PanelStage::Scan);
  auto* canvas = find<CurveCanvas>("canvas");
  const QPoint desk(3, canvas->height() / 2), page = canvas->toWidget({200, 200}).toPoint();
  const QImage light = canvas->grab().toImage();
  window_->setThemeChoice(ThemeChoice::Dark);
  QImage dark;
  EXPECT_TRUE(waitUntil(
      [&] {
        dark = canvas->grab().toImage();
        return qGray(dark.pixel(desk)) < 80;
      },
      5000));
  EXPECT_GT(qGray(light.pixel(desk)), 180);
  EXPECT_EQ(dark.pixel(page), light.pixel(page)) << "what was drawn keeps its look";
  window_->setThemeChoice(ThemeChoice::Light);
}

TEST_F(Steady, TheTableOfThresholdsTakesTheColoursOfANewTheme) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage({400, 400})));
  window_->setStage(PanelStage::Threshold);
  auto* table = find<QTableWidget>("threshold.table");
  for (const ThemeChoice choice : {ThemeChoice::Dark, ThemeChoice::Light}) {
    window_->setThemeChoice(choice);
    QCoreApplication::processEvents();
    const int ink = qGray(table->item(3, 3)->foreground().color().rgb());
    const int ground = qGray(table->palette().color(QPalette::Base).rgb());
    EXPECT_GT(std::abs(ink - ground), 120) << "a grey level of " << ink << " on one of " << ground;
  }
}

TEST_F(Steady, TabWalksThePanelFirstAndTheTopBarLast) {
  ASSERT_NO_FATAL_FAILURE(openPage(mixedPage()));
  window_->activateWindow();
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    QCoreApplication::processEvents();
    auto* canvas = find<CurveCanvas>("canvas");
    canvas->setFocus();
    ASSERT_TRUE(waitUntil([&] { return canvas->hasFocus(); }, 3000));
    enum Part { Panel, Lower, Status, Rail, Top };
    const std::pair<Part, const char*> parts[] = {{Panel, "inspector"},   {Lower, "targetStrip"}, {Lower, "plots"},
                                                  {Status, "statusLine"}, {Rail, "stageRail"},    {Top, "topBar"}};
    std::vector<Part> walked;
    std::set<const QWidget*> seen;
    std::string names;
    const QWidget* now = nullptr;
    for (int i = 0; i < 200; ++i) {
      QTest::keyClick(window_->focusWidget(), Qt::Key_Tab);
      now = window_->focusWidget();
      ASSERT_NE(now, nullptr);
      if (now == canvas || !seen.insert(now).second) break;  // once round
      for (const auto& [part, name] : parts) {
        const auto* widget = window_->findChild<QWidget*>(QString::fromLatin1(name));
        if (widget != nullptr && widget->isAncestorOf(now)) walked.push_back(part);
      }
      names += now->objectName().toStdString() + " (" + now->metaObject()->className() + "), ";
    }
    EXPECT_EQ(now, canvas) << label(stage).toStdString() << ": after the top bar the drawing comes, not "
                           << now->objectName().toStdString();
    ASSERT_GT(walked.size(), 5u) << label(stage).toStdString();
    EXPECT_EQ(walked.front(), Panel) << label(stage).toStdString();
    EXPECT_EQ(walked.back(), Top) << label(stage).toStdString();
    EXPECT_TRUE(std::is_sorted(walked.begin(), walked.end())) << label(stage).toStdString() << ": " << names;
    // And back the same way.
    canvas->setFocus();
    QTest::keyClick(canvas, Qt::Key_Backtab);
    const QWidget* last = window_->focusWidget();
    ASSERT_NE(last, nullptr);
    EXPECT_TRUE(find<QWidget>("topBar")->isAncestorOf(last)) << label(stage).toStdString();
    QTest::keyClick(window_->focusWidget(), Qt::Key_Tab);
    EXPECT_EQ(window_->focusWidget(), canvas) << label(stage).toStdString();
  }
}

}  // namespace
}  // namespace batten
