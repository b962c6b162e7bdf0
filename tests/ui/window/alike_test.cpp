// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollArea>
#include <QStackedWidget>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/document/export_builder.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/curves/extremum_marks.h"

namespace batten {
namespace {

using test::waitUntil;

/// What the parts of the window say of one thing, they say alike.
class Alike : public test::WindowFixture {
 protected:
  /// An arc of 16 mm that bends most at a quarter of its length, upwards or downwards.
  static QImage bendPage(bool isUp) {
    return test::drawnPage({640, 400}, [isUp](QPainter& painter) {
      if (!isUp) {
        painter.translate(0, 400);
        painter.scale(1, -1);
      }
      QPainterPath path({60, 300});
      path.cubicTo({120, 60}, {240, 60}, {580, 300});
      painter.drawPath(path);
    });
  }
  void openFairing(const QImage& page) {
    ASSERT_NO_FATAL_FAILURE(openPage(page));
    window_->setStage(PanelStage::Fairing);
    // In a lower window the plot alone shows the profiles.
    window_->resize(1280, 960);
    ASSERT_TRUE(waitUntil([this] { return find<TargetTile>("target.1")->height() >= TargetTile::kLowHeight; }, 5000));
    session().selectCurve(0);
    ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
    ASSERT_TRUE(session().targets()->targets.profiles[0].valid);
  }
  /// Where the line of the sketched curve is highest in the first tile, as a share of its width.
  double peakOfTile() {
    const QPainterPath path = find<TargetTile>("target.1")->sketchedPath();
    QPointF best(0, 1e9);
    for (int i = 0; i < path.elementCount(); ++i)
      if (path.elementAt(i).y < best.y()) best = path.elementAt(i);
    const QRectF box = path.boundingRect();
    return (best.x() - box.left()) / box.width();
  }
  int violetPixels() {
    const QImage shown = find<CurveCanvas>("canvas")->grab().toImage().convertToFormat(QImage::Format_RGB32);
    int found = 0;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) {
        const QColor c = shown.pixelColor(x, y);
        found += c.red() > c.green() + 50 && c.blue() > c.red() + 30 ? 1 : 0;
      }
    return found;
  }
};

TEST_F(Alike, TilesRunAsThePlotDoes) {
  ASSERT_NO_FATAL_FAILURE(openFairing(bendPage(true)));
  auto* plots = window_->findChild<CurvePlots*>();
  const auto& set = session().targets()->targets;
  const double along =
      std::ranges::max_element(set.samples, {}, [](const CurvatureSample& s) { return std::abs(s.kappa); })->perimeter;
  ASSERT_GT(std::abs(along - 0.5), 0.05) << "the two directions would look the same";
  const auto expected = [&] { return plots->runsLeft() ? 1.0 - along : along; };
  EXPECT_TRUE(waitUntil([&] { return std::abs(peakOfTile() - expected()) < 0.05; }, 5000)) << peakOfTile();
  QTest::mouseClick(find<QAbstractButton>("plot.reverse"), Qt::LeftButton);
  EXPECT_TRUE(waitUntil([&] { return std::abs(peakOfTile() - expected()) < 0.05; }, 5000)) << peakOfTile();
}

TEST_F(Alike, TilesDoNotTurnUpsideDownWithTheSideOfTheBend) {
  for (const bool isUp : {true, false}) {
    ASSERT_NO_FATAL_FAILURE(openFairing(bendPage(isUp)));
    const double peak = peakOfTile();
    // A line upside down has its peak at an end, where the curve is flattest.
    EXPECT_GT(peak, 0.08) << isUp;
    EXPECT_LT(peak, 0.92) << isUp;
    EXPECT_TRUE(find<TargetTile>("target.1")->toolTip().contains(QStringLiteral("curvature"))) << "names its quantity";
  }
}

TEST_F(Alike, TheLineOfATileLeavesNoSpecks) {
  constexpr double kSeenPx = 1.0;  // shorter steps are drawn as specks beside the line
  ASSERT_NO_FATAL_FAILURE(openFairing(bendPage(true)));
  const QPainterPath line = find<TargetTile>("target.1")->sketchedPath();
  ASSERT_GT(line.elementCount(), 20);
  for (int i = 1; i + 1 < line.elementCount(); ++i) {
    const QPointF step = QPointF(line.elementAt(i)) - QPointF(line.elementAt(i - 1));
    EXPECT_GE(std::hypot(step.x(), step.y()), kSeenPx - 1e-9) << i;
  }
}

TEST_F(Alike, EveryMethodShowsTheExtremaThatItsFiguresCount) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  window_->setStage(PanelStage::Curves);
  for (const char* method : {"nurbs", "bezier", "control-polygon"}) {
    QTest::mouseClick(find<QAbstractButton>((std::string("construct.method.") + method).c_str()), Qt::LeftButton);
    ASSERT_TRUE(settle());
    session().selectCurve(0);
    ASSERT_GT(session().selected()->sketchedFigures.extrema, 0) << method;
    EXPECT_EQ(std::ssize(extremumMarks(session(), 0)), session().selected()->sketchedFigures.extrema) << method;
  }
}

TEST_F(Alike, APinnedLineIsSeenBesideCurvesAndNowhereElse) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  window_->setStage(PanelStage::Curves);
  ASSERT_EQ(violetPixels(), 0);
  QTest::mouseClick(find<QAbstractButton>("pin.set"), Qt::LeftButton);
  EXPECT_TRUE(waitUntil([this] { return violetPixels() > 150; }, 5000)) << "on the same curve: " << violetPixels();
  for (const PanelStage stage : {PanelStage::Scan, PanelStage::Threshold, PanelStage::CleanUp}) {
    window_->setStage(stage);
    EXPECT_TRUE(waitUntil([this] { return violetPixels() == 0; }, 2000)) << label(stage).toStdString();
  }
}

TEST_F(Alike, RowsOfTheListKeepTheirNumbers) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({900, 700}, [](QPainter& painter) {
    for (int i = 0; i < 4; ++i) painter.drawEllipse(QRectF(40 + 210 * i, 60 + 20 * i, 150, 220 + 60 * i));
    painter.drawLine(40, 660, 860, 600);
  })));
  for (const PanelStage stage : {PanelStage::Curves, PanelStage::Fairing}) {
    window_->setStage(stage);
    ASSERT_TRUE(settle());
    const CurveList* list = nullptr;
    for (auto* one : window_->findChildren<CurveList*>())
      if (one->isVisible()) list = one;
    ASSERT_NE(list, nullptr);
    ASSERT_GT(list->count(), 4);
    EXPECT_TRUE(waitUntil([&] { return !list->item(0)->data(CurveList::kBadgeRole).toString().isEmpty(); }));
    for (int row = 0; row < list->count(); ++row) {
      const QString name = list->shownName(row);
      const int number = curveNumber(session().output(), session().curves()[row]);
      EXPECT_TRUE(name.contains(QString::number(number))) << name.toStdString();
      EXPECT_FALSE(name.contains(QChar(0x2026))) << "cut within a word: " << name.toStdString();
    }
  }
}

TEST_F(Alike, CurvesAreCalledInTheWindowAsInTheFile) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.drawLines({QLineF(60, 80, 560, 90), QLineF(60, 180, 560, 190), QLineF(60, 280, 560, 330)});
  })));
  ASSERT_EQ(session().curves().size(), 3u);
  // The line that is left keeps its number.
  Recipe recipe = session().recipe();
  recipe.regions = {rectangleRegion({0, 130}, {640, 230})};
  session().change(QStringLiteral("Region"), recipe);
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 1u);
  const ExportDocument file = exportDocument(session().output(), session().recipe(), *session().scan());
  ASSERT_EQ(file.curves.size(), 1u);
  window_->setStage(PanelStage::Curves);
  auto* list = find<QWidget>("panel.curves")->findChild<CurveList*>();
  ASSERT_EQ(list->count(), 1);
  const int number = curveNumber(session().output(), session().curves()[0]);
  ASSERT_NE(number, 1) << "its place in the list would say the same";
  const QString name = QStringLiteral("Curve %1").arg(number);
  EXPECT_EQ(curveName(session(), 0), name);
  EXPECT_TRUE(list->shownName(0).startsWith(name)) << list->shownName(0).toStdString();
  EXPECT_EQ(file.curves[0].pieces.front().name, name.toStdString());
  EXPECT_EQ(file.curves[0].id, "curve-" + std::to_string(number));
}

TEST_F(Alike, TabWalksThePanelsFromTopToBottom) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    QCoreApplication::processEvents();
    auto* scroll = qobject_cast<QScrollArea*>(find<QStackedWidget>("inspector")->currentWidget());
    ASSERT_NE(scroll, nullptr);
    QWidget* panel = scroll->widget();
    std::vector<QWidget*> walked;
    QWidget* one = find<CurveCanvas>("canvas");
    for (int i = 0; i < 5000; ++i) {
      one = one->nextInFocusChain();
      if (one == find<CurveCanvas>("canvas")) break;
      if (panel->isAncestorOf(one) && one->isVisible() && one->isEnabled() && (one->focusPolicy() & Qt::TabFocus))
        walked.push_back(one);
    }
    ASSERT_FALSE(walked.empty()) << label(stage).toStdString();
    const auto bottomOf = [panel](const QWidget* w) { return w->mapTo(panel, QPoint(0, w->height())).y(); };
    const auto topOf = [panel](const QWidget* w) { return w->mapTo(panel, QPoint(0, 0)).y(); };
    for (std::size_t i = 1; i < walked.size(); ++i)
      EXPECT_GT(bottomOf(walked[i]), topOf(walked[i - 1]))
          << label(stage).toStdString() << ": " << walked[i - 1]->objectName().toStdString() << " before "
          << walked[i]->objectName().toStdString();
  }
}

TEST_F(Alike, CanvasAndPlotSayTheRadiusOfTheCurveItself) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  window_->setStage(PanelStage::Curves);
  session().selectCurve(0);
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Radius);
  const NurbsCurve& curve = session().selected()->sketched;
  const ArcLength arc(curve);
  auto* value = find<QLabel>("plot.value");
  for (const double share : {0.11, 0.2137, 0.35}) {
    const double s = share * arc.total();
    session().setCursor(s);
    const double radius = std::abs(1.0 / *curvature(curve, arc.parameter(s)));
    const QString said = QStringLiteral("R %1 mm").arg(radius, 0, 'f', radius < 10.0 ? 2 : radius < 100.0 ? 1 : 0);
    EXPECT_TRUE(value->text().endsWith(said)) << value->text().toStdString() << ", not " << said.toStdString();
  }
}

TEST_F(Alike, TheFinderListsNamesNotSentences) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  window_->action(ActionId::FindAction)->trigger();
  int settings = 0;
  for (const QAction* action : window_->findChildren<QAction*>()) {
    if (!action->objectName().startsWith(QStringLiteral("setting."))) continue;
    ++settings;
    EXPECT_FALSE(action->text().contains(QStringLiteral(". "))) << action->text().toStdString();
  }
  EXPECT_GT(settings, 20);
  QTest::keyClick(find<QLineEdit>("palette.edit"), Qt::Key_Escape);
}

TEST_F(Alike, NoHintSpeaksOfCurvesWhereNoneAreDrawn) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  auto* hint = find<QLabel>("status.hint");
  window_->setStage(PanelStage::Threshold);
  window_->action(ActionId::ToolSelect)->trigger();
  EXPECT_FALSE(hint->text().contains(QStringLiteral("Click a curve"))) << hint->text().toStdString();
  window_->setStage(PanelStage::Corners);
  const QString ofStage = hint->text();
  window_->setStage(PanelStage::Curves);
  window_->action(ActionId::ToolCorners)->trigger();
  EXPECT_EQ(hint->text(), ofStage) << "one sentence for one tool";
}

TEST_F(Alike, TheToolbarStandsStillWhenWorkIsUnsaved) {
  ASSERT_NO_FATAL_FAILURE(openPage(bendPage(true)));
  auto* undo = find<QAbstractButton>("undoButton");
  QCoreApplication::processEvents();
  const int before = undo->x();
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  ASSERT_TRUE(find<QLabel>("documentTitle")->text().endsWith(QStringLiteral("•")));
  ASSERT_TRUE(settleLayout());
  EXPECT_EQ(undo->x(), before);
}

}  // namespace
}  // namespace batten
