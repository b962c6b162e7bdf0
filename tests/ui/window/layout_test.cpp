// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QScrollArea>
#include <QSplitter>
#include <QTest>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"

namespace batten {
namespace {

using test::waitUntil;

class Layout : public test::WindowFixture {
 protected:
  int canvasHeight() { return find<CurveCanvas>("canvas")->height(); }
};

TEST_F(Layout, InALowWindowTheDrawingComesFirst) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::Fairing);
  auto* plots = find<QWidget>("plots");
  auto* canvas = find<CurveCanvas>("canvas");
  ASSERT_TRUE(waitUntil([&] { return plots->isVisible() && plots->height() > 240; }, 5000)) << plots->height();
  const int roomy = plots->height();
  window_->resize(1000, 700);
  ASSERT_TRUE(waitUntil([&] { return window_->height() <= 700 && plots->height() < roomy; }, 5000));
  EXPECT_TRUE(plots->isVisible());
  EXPECT_GE(find<QWidget>("plot")->height(), 200);
  EXPECT_GT(canvas->height(), 200);
  window_->resize(960, 600);
  ASSERT_TRUE(waitUntil([&] { return !plots->isVisible(); }, 5000));
  EXPECT_GT(canvas->height(), 360);
  EXPECT_TRUE(find<QWidget>("targetStrip")->isVisible());
  window_->resize(1280, 860);
  EXPECT_TRUE(waitUntil([&] { return plots->isVisible() && plots->height() == roomy; }, 5000)) << plots->height();
}

// Also with a title bar taken off.
TEST_F(Layout, InALowWindowTheButtonThatWritesTheFileIsSeenWhole) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::Export);
  auto* button = find<QAbstractButton>("export.run");
  for (const QSize size : {QSize(1366, 720), QSize(1366, 768)}) {
    window_->resize(size);
    ASSERT_TRUE(waitUntil([&] { return window_->size() == size; }, 5000));
    EXPECT_TRUE(waitUntil([&] { return button->visibleRegion().boundingRect() == button->rect(); }, 5000))
        << size.height();
  }
}

// From a small laptop with the title and task bars taken off to a large screen, in the sizes nobody has chosen.
TEST_F(Layout, TheDrawingHasHalfOfTheWindowAndThePlotCanBeRead) {
  openPage(test::ellipsePage());
  auto* plot = find<QWidget>("plot");
  auto* canvas = find<CurveCanvas>("canvas");
  for (const QSize size : {QSize(1366, 696), QSize(1366, 720), QSize(1366, 768), QSize(1440, 800), QSize(1500, 920)}) {
    window_->resize(size);
    ASSERT_TRUE(waitUntil([&] { return window_->size() == size; }, 5000));
    for (const PanelStage stage : {PanelStage::Curves, PanelStage::Fairing}) {
      window_->setStage(stage);
      EXPECT_TRUE(waitUntil([&] { return canvas->height() >= 0.48 * size.height() && plot->height() >= 200; }, 3000))
          << size.height() << ": " << canvas->height() << " and " << plot->height();
      for (const TargetTile* tile : window_->findChildren<TargetTile*>()) {
        EXPECT_FALSE(tile->visibleRegion().isEmpty()) << size.height();
        EXPECT_EQ(tile->visibleRegion().boundingRect(), tile->rect()) << size.height() << ", cut off";
      }
    }
  }
}

// What decides on a fairing is seen beside the drawing, on a small laptop, too, and so is where curves are chosen.
TEST_F(Layout, FairingShowsItsFiguresWithoutScrolling) {
  constexpr int kSeenRows = 3;  // of the list of curves
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    for (int i = 0; i < 12; ++i) painter.drawLine(20 + 25 * i, 60, 24 + 25 * i, 340);
  }));
  window_->resize(1366, 768);
  window_->setStage(PanelStage::Fairing);
  auto* list = find<QWidget>("panel.fairing")->findChild<CurveList*>();
  for (const bool isSelected : {false, true}) {
    session().selectCurve(isSelected ? std::optional(2) : std::nullopt);
    for (const char* mode : {"fairing.mode.none", "fairing.mode.target", "fairing.mode.monotone"}) {
      QTest::mouseClick(find<QAbstractButton>(mode), Qt::LeftButton);
      ASSERT_TRUE(settle());
      ASSERT_TRUE(settleLayout());
      for (const char* name : {"fairing.figures", "fairing.ends"}) {
        auto* table = find<QWidget>(name);
        EXPECT_EQ(table->visibleRegion().boundingRect(), table->rect()) << name << " " << mode << " " << isSelected;
      }
      EXPECT_GE(list->visibleRegion().boundingRect().height(), kSeenRows * list->sizeHintForRow(0)) << mode;
    }
  }
}

TEST_F(Layout, AHeightDrawnByHandStaysInALowWindow) {
  openPage(test::ellipsePage());
  window_->resize(1366, 720);
  window_->setStage(PanelStage::Fairing);
  auto* canvas = find<CurveCanvas>("canvas");
  ASSERT_TRUE(waitUntil([&] { return window_->height() == 720 && find<QWidget>("plots")->isVisible(); }, 5000));
  ASSERT_TRUE(settleLayout());
  auto* handle = find<QSplitter>("centreSplitter")->handle(1);
  const QPoint at = handle->rect().center();
  QTest::mousePress(handle, Qt::LeftButton, {}, at);
  QTest::mouseMove(handle, at - QPoint(0, 40));
  QTest::mouseRelease(handle, Qt::LeftButton, {}, at - QPoint(0, 40));
  const int drawn = canvas->height();
  window_->setStage(PanelStage::Corners);
  window_->setStage(PanelStage::Fairing);
  EXPECT_TRUE(waitUntil([&] { return std::abs(canvas->height() - drawn) <= 1; }, 2000)) << canvas->height();
  EXPECT_LT(drawn, 345) << "it was drawn up from half of the window";
  window_->close();
  openWindow();
  window_->resize(1366, 720);
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::Fairing);
  EXPECT_TRUE(waitUntil([&] { return std::abs(canvasHeight() - drawn) <= 1; }, 2000)) << canvasHeight();
}

TEST_F(Layout, OnlyWhatTheToleranceAllowsIsRecommended) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Fairing);
  Recipe recipe = session().recipe();
  recipe.fairing.toleranceMm = 0.01;
  session().change(QStringLiteral("Tolerance"), recipe);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  const int degree = session().targets()->recommendedDegree.value_or(0);
  ASSERT_GT(degree, 0);
  const auto& outcome = session().targets()->faired[degree - 1];
  ASSERT_TRUE(outcome);
  auto* tile = find<QAbstractButton>(("target." + std::to_string(degree)).c_str());
  EXPECT_EQ(tile->accessibleName().contains(QStringLiteral("recommended")), outcome->report.withinTolerance);
  EXPECT_EQ(tile->accessibleName().contains(QStringLiteral("simplest fit")), false)
      << "it is recommended, or it does not fit";
}

TEST_F(Layout, EveryPlotNamesItsQuantityAndComesBack) {
  openPage(test::ellipsePage());
  auto* plots = window_->findChild<CurvePlots*>();
  auto* quantity = find<QLabel>("plot.quantity");
  for (const PlotTab tab :
       {PlotTab::Radius, PlotTab::Speed, PlotTab::CurvatureSlope, PlotTab::Deviation, PlotTab::Curvature}) {
    plots->setTab(tab);
    EXPECT_TRUE(quantity->text().contains(QStringLiteral("mm"))) << quantity->text().toStdString();
  }
  window_->close();
  openWindow();
  EXPECT_EQ(window_->findChild<CurvePlots*>()->tab(), PlotTab::Curvature);
}

TEST_F(Layout, TargetsAndPlotsAreShownWhereCurvesAreJudged) {
  openPage(test::ellipsePage());
  auto* strip = find<QWidget>("targetStrip");
  auto* plot = find<QWidget>("plot");
  for (const QSize size : {QSize(1366, 720), QSize(1440, 900)}) {
    window_->resize(size);
    for (const PanelStage stage : kPanelStages) {
      window_->setStage(stage);
      const bool isJudging = stage == PanelStage::Curves || stage == PanelStage::Fairing;
      EXPECT_EQ(strip->isVisible(), isJudging) << label(stage).toStdString();
      EXPECT_EQ(plot->isVisible(), isJudging) << label(stage).toStdString();
      if (isJudging) {
        EXPECT_TRUE(waitUntil([&] { return plot->height() >= 200; }, 3000)) << plot->height();
      }
    }
  }
}

TEST_F(Layout, PFoldsTargetsAndPlotsAndBringsThemUpAnywhere) {
  openPage(test::ellipsePage());
  auto* strip = find<QWidget>("targetStrip");
  auto* canvas = find<CurveCanvas>("canvas");
  const auto press = [&] {
    canvas->setFocus();
    QTest::keyClick(canvas, Qt::Key_P);
  };
  window_->setStage(PanelStage::Fairing);
  press();
  EXPECT_FALSE(strip->isVisible());
  window_->setStage(PanelStage::Curves);
  EXPECT_FALSE(strip->isVisible()) << "folded for both";
  window_->setStage(PanelStage::Threshold);
  press();
  EXPECT_TRUE(strip->isVisible()) << "asked for, they come in any stage";
  window_->setStage(PanelStage::Corners);
  EXPECT_FALSE(strip->isVisible());
  window_->setStage(PanelStage::Fairing);
  press();
  EXPECT_TRUE(strip->isVisible());
}

TEST_F(Layout, TheLinesOfTheSixTargetsCarryTheirNumbers) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Curvature);
  int valid = 0;
  for (int degree = 1; degree <= 6; ++degree) {
    const bool isValid = session().targets()->targets.profiles[degree - 1].valid;
    valid += isValid ? 1 : 0;
    const auto* text = window_->findChild<QObject*>(QStringLiteral("plot.target.%1").arg(degree));
    EXPECT_EQ(text != nullptr, isValid) << degree;
    if (text) {
      EXPECT_EQ(text->property("text").toString(), QString::number(degree));
      EXPECT_NE(window_->findChild<QObject*>(QStringLiteral("plot.target.%1.leader").arg(degree)), nullptr);
    }
  }
  EXPECT_GT(valid, 3);
}

TEST_F(Layout, TheNameOfTheQuantityLiesOverNothing) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  auto* quantity = find<QLabel>("plot.quantity");
  auto* plot = find<QWidget>("plot");
  for (const PlotTab tab :
       {PlotTab::Radius, PlotTab::Curvature, PlotTab::CurvatureSlope, PlotTab::Speed, PlotTab::Deviation}) {
    window_->findChild<CurvePlots*>()->setTab(tab);
    ASSERT_TRUE(settleLayout());
    const QRect box = quantity->geometry();
    ASSERT_FALSE(box.isEmpty());
    quantity->hide();
    const QImage under = plot->grab(box).toImage().convertToFormat(QImage::Format_RGB32);
    quantity->show();
    QImage plain(under.size(), under.format());
    plain.fill(under.pixelColor(0, 0));
    EXPECT_EQ(under, plain) << quantity->text().toStdString();
  }
}

TEST_F(Layout, TheTabsOfThePlotNeverLieOverOneAnother) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::Fairing);
  for (const int width : {1600, 1024, 960}) {
    window_->resize(width, 860);
    ASSERT_TRUE(waitUntil([&] { return window_->width() == width && find<QWidget>("plots")->isVisible(); }, 5000));
    ASSERT_TRUE(settleLayout());
    int right = 0;
    for (const char* name :
         {"plot.radius", "plot.curvature", "plot.slope", "plot.speed", "plot.deviation", "plot.reverse"}) {
      const auto* tab = find<QAbstractButton>(name);
      EXPECT_GE(tab->x(), right) << name << " at " << width;
      EXPECT_GE(tab->width(), tab->fontMetrics().horizontalAdvance(tab->text())) << name << " at " << width;
      right = tab->x() + tab->width();
    }
    EXPECT_LE(right, find<QWidget>("plot.radius")->parentWidget()->width()) << width;
  }
}

TEST_F(Layout, TheFiguresOfAllTilesSayAlike) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  for (const int width : {1600, 1024}) {
    window_->resize(width, 860);
    ASSERT_TRUE(waitUntil([&] { return window_->width() == width; }, 5000));
    ASSERT_TRUE(settleLayout());
    TargetTile::Figures least = TargetTile::Figures::All;
    for (const TargetTile* tile : window_->findChildren<TargetTile*>()) least = std::max(least, tile->roomFor());
    for (const TargetTile* tile : window_->findChildren<TargetTile*>()) EXPECT_EQ(tile->figures(), least) << width;
  }
}

TEST_F(Layout, CornersAreShownFromTheEdgesOnAndWhereTheyAreMarked) {
  openPage(test::zigzagPage());
  auto* canvas = find<CurveCanvas>("canvas");
  const auto isSeen = [&] {
    const QImage with = canvas->grab().toImage();
    window_->view().setVisible(Layer::Corners, !window_->view().isVisible(Layer::Corners));
    const QImage other = canvas->grab().toImage();
    window_->view().setVisible(Layer::Corners, !window_->view().isVisible(Layer::Corners));
    return with != other && window_->view().isVisible(Layer::Corners);
  };
  window_->setStage(PanelStage::Corners);
  clickCanvas({200, 100});
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    window_->action(ActionId::ToolSelect)->trigger();
    EXPECT_EQ(isSeen(), stage >= PanelStage::Edges) << label(stage).toStdString();
  }
  // Where they are marked they are seen in any stage.
  window_->setStage(PanelStage::Threshold);
  window_->action(ActionId::ToolSelect)->trigger();
  const QImage without = canvas->grab().toImage();
  window_->action(ActionId::ToolCorners)->trigger();
  const QPoint at = canvas->toWidget(session().recipe().cornerMarks[0].positionPx).toPoint();
  const QRect around(at - QPoint(8, 8), QSize(17, 17));
  EXPECT_NE(canvas->grab().toImage().copy(around), without.copy(around));
}

TEST_F(Layout, CornersShowsWhatMarksThemWithoutScrolling) {
  openPage(test::zigzagPage());
  window_->resize(1366, 768);
  window_->setStage(PanelStage::Corners);
  ASSERT_TRUE(settleLayout());
  for (const char* name : {"corners.restore", "corners.remove", "corners.take", "corners.takeAll"}) {
    auto* button = find<QWidget>(name);
    EXPECT_EQ(button->visibleRegion().boundingRect(), button->rect()) << name;
  }
  constexpr int kRowPx = 22;
  EXPECT_GE(find<QWidget>("corners.suggestions")->visibleRegion().boundingRect().height(), kRowPx);
}

TEST_F(Layout, ButtonsStayWhereTheyAreWhileListsGrow) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  std::vector<QWidget*> buttons;
  for (const char* name : {"corners.remove", "corners.removeAll", "corners.take", "corners.takeAll"})
    buttons.push_back(find<QWidget>(name));
  const auto places = [&] {
    QCoreApplication::processEvents();
    std::vector<QPoint> all;
    for (const QWidget* button : buttons) all.push_back(button->mapTo(window_.get(), QPoint(0, 0)));
    return all;
  };
  auto* takeAll = find<QAbstractButton>("corners.takeAll");
  ASSERT_TRUE(waitUntil([&] { return takeAll->isEnabled(); }));
  const auto before = places();
  QTest::mouseClick(takeAll, Qt::LeftButton);
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 2u);
  EXPECT_EQ(places(), before);
  clickCanvas({300, 200});
  ASSERT_TRUE(settle());
  EXPECT_EQ(places(), before);
}

TEST_F(Layout, NothingLiesOverTheRegionsWhileTheyAreWorkedOn) {
  // A page that fills the view, so that its first region lies in its corner.
  openPage(test::zigzagPage({640, 500}));
  window_->setStage(PanelStage::Threshold);
  auto* canvas = find<CurveCanvas>("canvas");
  ASSERT_TRUE(session().selectedCurve());
  const auto corners = [&] {
    const QImage all = canvas->grab().toImage();
    return std::pair(all.copy(0, 0, 300, 60), all.copy(0, all.height() - 60, 300, 60));
  };
  const auto with = corners();
  session().selectCurve(std::nullopt);
  const auto without = corners();
  EXPECT_EQ(with.first, without.first) << "nothing is said of a curve that is not drawn";
  window_->setStage(PanelStage::Scan);
  EXPECT_NE(corners().second, without.second) << "the page's chip is back elsewhere";
}

TEST_F(Layout, AChipMakesWayForTheMouse) {
  openPage(test::zigzagPage({640, 500}));
  window_->setStage(PanelStage::Scan);
  auto* canvas = find<CurveCanvas>("canvas");
  const auto corner = [&] {
    const QImage all = canvas->grab().toImage();
    return all.copy(0, all.height() - 60, 300, 60);
  };
  const auto moveTo = [&](QPoint place) {
    QMouseEvent move(QEvent::MouseMove, place, canvas->mapToGlobal(place), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
  };
  moveTo(canvas->rect().center());
  const QImage with = corner();
  moveTo({40, canvas->height() - 22});
  EXPECT_NE(corner(), with);
  moveTo(canvas->rect().center());
  EXPECT_EQ(corner(), with);
}

}  // namespace
}  // namespace batten
