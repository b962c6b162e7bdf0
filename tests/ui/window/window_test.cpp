// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QCursor>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainterPath>
#include <QProcess>
#include <QSettings>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <QTextBrowser>
#include <cmath>
#include <set>

#include "core/contour/corner/corner_marks.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "tests/ui/rendered_scan.h"
#include "tests/ui/window_fixture.h"
#include "ui/canvas/curve_canvas.h"
#include "ui/command_palette.h"
#include "ui/error_strip.h"
#include "ui/main_window.h"
#include "ui/plots/plot_series.h"

namespace batten {
namespace {

using test::waitUntil;
class Window : public test::WindowFixture {};

/// Two straight legs, joined in sharp corners at (200, 100) and (400, 300) to a bend between them.
QImage bendPage() {
  return test::drawnPage({640, 400}, [](QPainter& painter) {
    QPainterPath path(QPointF(60, 300));
    path.lineTo(200, 100);
    path.cubicTo(280, 110, 400, 160, 400, 300);
    path.lineTo(580, 80);
    painter.drawPath(path);
  });
}

TEST_F(Window, ThresholdsAreGivenOnTheTonesThatAreShown) {
  openPage(bendPage());
  window_->setStage(PanelStage::Threshold);
  window_->view().setSelectedRegion(27);
  auto* field = find<QLineEdit>("threshold.regionLevel");
  type(field, QStringLiteral("140"));
  ASSERT_EQ(session().recipe().threshold.grid[27], 140.0);
  window_->view().choose(Layer::LogImage, true);
  // y = a log(1 + x) with the recipe's a.
  const double a = session().recipe().log.factor;
  EXPECT_NEAR(field->text().toDouble(), a * std::log(141.0), 0.51);
  EXPECT_NEAR(find<QTableWidget>("threshold.table")->item(3, 3)->text().toDouble(), a * std::log(141.0), 0.51);
  type(field, QStringLiteral("200"));
  EXPECT_NEAR(*session().recipe().threshold.grid[27], std::exp(200.0 / a) - 1.0, 1e-6);
  window_->view().choose(Layer::LogImage, false);
  EXPECT_NEAR(field->text().toDouble(), std::exp(200.0 / a) - 1.0, 0.51);
}

TEST_F(Window, TheSampleOpensWithItsCornersAndFollowsATarget) {
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  ASSERT_TRUE(waitUntil([this] { return session().curves().size() == 14; }));
  EXPECT_EQ(session().recipe().cornerMarks.size(), 9u);
  window_->setStage(PanelStage::Fairing);
  session().selectCurve(0);
  ASSERT_TRUE(waitUntil([this] { return !session().isBusy() && session().targets(); }));
  const Recipe before = session().recipe();
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_3);
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().selected()->fairingUsed.target, FairingTarget::Degree3);
  while (session().undoStack()->canUndo()) session().undoStack()->undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe(), before);
  EXPECT_EQ(session().curves().size(), 14u);
}

/// The walk through all stages, stage by stage.
class WholeWalk : public Window {
 protected:
  void setScan() {
    const Recipe start = session().recipe();
    window_->setStage(PanelStage::Scan);
    EXPECT_FALSE(window_->view().isVisible(Layer::LogImage)) << "the scan is shown as it is";
    auto* factor = find<QSlider>("log.factor");
    QTest::mousePress(factor, Qt::LeftButton, {}, QPoint(factor->width() / 2, factor->height() / 2));
    QTest::mouseMove(factor, QPoint(factor->width() / 2 + 12, factor->height() / 2));
    QTest::mouseMove(factor, QPoint(factor->width() / 2 + 30, factor->height() / 2));
    QTest::mouseRelease(factor, Qt::LeftButton, {}, QPoint(factor->width() / 2 + 30, factor->height() / 2));
    EXPECT_NE(session().recipe().log.factor, start.log.factor);
    EXPECT_EQ(session().undoStack()->count(), 1) << "a drag is one step";
    EXPECT_TRUE(window_->view().isVisible(Layer::LogImage)) << "what is dragged is seen";
  }

  void setThreshold() {
    window_->setStage(PanelStage::Threshold);
    clickCanvas({280, 175});
    ASSERT_EQ(window_->view().selectedRegion(), 27);
    type(find<QLineEdit>("threshold.regionLevel"), QStringLiteral("140"));
    ASSERT_TRUE(session().recipe().threshold.grid[27]);
    EXPECT_EQ(*session().recipe().threshold.grid[27], 140.0);
    EXPECT_EQ(find<QTableWidget>("threshold.table")->item(3, 3)->text(), QStringLiteral("140"));
    ASSERT_TRUE(settle());
  }

  void markCorners() {
    window_->setStage(PanelStage::Corners);
    clickCanvas({200, 100});
    ASSERT_TRUE(settle());
    clickCanvas({400, 300});
    ASSERT_TRUE(settle());
    ASSERT_EQ(session().recipe().cornerMarks.size(), 2u);
    EXPECT_EQ(find<QListWidget>("corners.list")->count(), 2);
    ASSERT_TRUE(session().output().pieces);
    EXPECT_EQ(session().output().pieces->corners.size(), 2u);
  }

  void chooseTarget() {
    window_->setStage(PanelStage::Fairing);
    ASSERT_GT(session().curves().size(), 1u);
    session().selectCurve(0);
    const Vec2 bend = nearestContourPoint(*session().output().contours, {340, 160}, 60.0)->positionPx;
    ASSERT_TRUE(waitUntil([&] {
      clickCanvas(bend);
      return session().selectedCurve() == 1;
    }));
    ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr; }));
    auto* tile = find<QAbstractButton>("target.3");
    ASSERT_TRUE(tile->isEnabled()) << tile->toolTip().toStdString();
    QTest::mouseClick(tile, Qt::LeftButton);
    ASSERT_EQ(session().recipe().choices.size(), 1u);
    EXPECT_EQ(session().recipe().choices[0].target, FairingTarget::Degree3);
    ASSERT_TRUE(settle());
    EXPECT_EQ(session().curves()[1].fairingUsed.mode, FairingMode::Target);
    EXPECT_EQ(session().curves()[1].fairingUsed.target, FairingTarget::Degree3);
  }

  void exportTo(const QString& target) {
    window_->action(ActionId::Export)->trigger();
    EXPECT_EQ(window_->stage(), PanelStage::Export);
    ASSERT_NO_FATAL_FAILURE(chooseReceiver("archive"));
    type(find<QLineEdit>("export.path"), target);
    QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
    ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && !find<QLabel>("export.result")->text().isEmpty(); }));
  }
};

TEST_F(WholeWalk, EndsInTheCurvesThatTheRecipeGives) {
  openPage(bendPage());
  const Recipe start = session().recipe();
  ASSERT_NO_FATAL_FAILURE(setScan());
  ASSERT_NO_FATAL_FAILURE(setThreshold());
  ASSERT_NO_FATAL_FAILURE(markCorners());
  ASSERT_NO_FATAL_FAILURE(chooseTarget());

  const Recipe end = session().recipe();
  while (session().undoStack()->canUndo()) window_->action(ActionId::Undo)->trigger();
  EXPECT_EQ(session().recipe(), start);
  EXPECT_EQ(find<QListWidget>("corners.list")->count(), 0);
  while (session().undoStack()->canRedo()) window_->action(ActionId::Redo)->trigger();
  EXPECT_EQ(session().recipe(), end);
  ASSERT_TRUE(settle());

  const QString target = folder_.filePath(QStringLiteral("curves.json"));
  ASSERT_NO_FATAL_FAILURE(exportTo(target));

  // The oracle: the other program, from the saved recipe, with nothing of the window.
  const QString saved = folder_.filePath(QStringLiteral("walk.json")),
                expected = folder_.filePath(QStringLiteral("expected.json"));
  saveAs(saved, [this] { window_->action(ActionId::SaveRecipe)->trigger(); });
  QProcess cli;
  cli.start(QStringLiteral(BATTEN_CLI),
            {QStringLiteral("trace"), path_, QStringLiteral("--recipe"), saved, QStringLiteral("-o"), expected});
  ASSERT_TRUE(cli.waitForFinished(60000));
  ASSERT_EQ(cli.exitCode(), 0) << cli.readAllStandardError().toStdString();
  EXPECT_EQ(read(target).toStdString(), read(expected).toStdString());
}

TEST_F(Window, EveryParameterHasAControlOfItsOwn) {
  // fairing.mode and fairing.target are the segments and tiles, the holds a table of dots, the grid a table.
  std::set<std::string> elsewhere = {"threshold.grid",  "fairing.target",     "fairing.mode",
                                     "fairing.profile", "fairing.hold_start", "fairing.hold_end"};
  for (const Parameter& parameter : parameterTable()) {
    if (elsewhere.contains(parameter.name)) continue;
    const QString row = QString::fromStdString(parameter.name) + QStringLiteral(".row");
    EXPECT_NE(window_->findChild<QWidget*>(row), nullptr) << parameter.name;
  }
  EXPECT_NE(find<QAbstractButton>("fairing.mode.target"), nullptr);
  EXPECT_NE(find<QTableWidget>("threshold.table"), nullptr);
  EXPECT_NE(find<QAbstractButton>("target.6"), nullptr);
  QTest::mouseClick(find<QAbstractButton>("fairing.hold_start.curvature"), Qt::LeftButton);
  EXPECT_EQ(session().recipe().fairing.startHold, (EndHold{true, true}));
  QTest::mouseClick(find<QAbstractButton>("fairing.hold_start.tangent"), Qt::LeftButton);
  EXPECT_EQ(session().recipe().fairing.startHold, (EndHold{false, false}));
}

TEST_F(Window, ControlsFollowUndoWithoutAnswering) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::CleanUp);
  auto* field = find<QLineEdit>("filter.coefficient.field");
  auto* slider = find<QSlider>("filter.coefficient");
  const QString before = field->text();
  const int positionBefore = slider->value();
  type(field, QStringLiteral("4"));
  EXPECT_EQ(session().recipe().filter.coefficient, 4);
  EXPECT_GT(slider->value(), positionBefore);
  session().undoStack()->undo();
  EXPECT_EQ(field->text(), before);
  EXPECT_EQ(slider->value(), positionBefore);
  EXPECT_TRUE(session().undoStack()->canRedo()) << "showing a value must not count as a change";
}

TEST_F(Window, FieldsBoundNumbersAndKeepWordsVisible) {
  openPage(test::ellipsePage());
  window_->setStage(PanelStage::CleanUp);
  auto* field = find<QLineEdit>("filter.iterations.field");
  type(field, QStringLiteral("5000"));
  EXPECT_EQ(session().recipe().filter.iterations, 100);
  EXPECT_EQ(field->text(), QStringLiteral("100"));
  type(field, QStringLiteral("many"));
  EXPECT_EQ(session().recipe().filter.iterations, 100);
  EXPECT_EQ(field->text(), QStringLiteral("many"));
  QTest::keyClick(field, Qt::Key_Escape);
  EXPECT_EQ(field->text(), QStringLiteral("100"));
}

TEST_F(Window, ThresholdTableTakesNumbersAndDeleteMakesAutomatic) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Threshold);
  auto* table = find<QTableWidget>("threshold.table");
  table->item(2, 5)->setText(QStringLiteral("99"));
  ASSERT_TRUE(session().recipe().threshold.grid[21]);
  EXPECT_EQ(*session().recipe().threshold.grid[21], 99.0);
  table->setCurrentCell(2, 5);
  QTest::keyClick(table, Qt::Key_Delete);
  EXPECT_FALSE(session().recipe().threshold.grid[21]);
  table->item(0, 0)->setText(QStringLiteral("60"));
  table->item(7, 7)->setText(QStringLiteral("61"));
  QTest::mouseClick(find<QAbstractButton>("threshold.autoAll"), Qt::LeftButton);
  for (const auto& cell : session().recipe().threshold.grid) EXPECT_FALSE(cell);
}

TEST_F(Window, ABadFileIsAMessageInTheWindow) {
  const QString path = folder_.filePath(QStringLiteral("text.png"));
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("this is no picture");
  file.close();
  window_->openPath(path);
  auto* strip = find<ErrorStrip>("errorStrip");
  ASSERT_TRUE(waitUntil([&] { return strip->isVisible(); }));
  EXPECT_FALSE(strip->message().isEmpty());
  EXPECT_TRUE(find<QAbstractButton>("error.action")->isVisible());
  QTest::mouseClick(find<QAbstractButton>("error.dismiss"), Qt::LeftButton);
  EXPECT_FALSE(strip->isVisible());
}

TEST_F(Window, LeavingACurveOutAndBackIsUndoable) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  auto* list = find<QListWidget>("curves.list");
  ASSERT_GT(list->count(), 0);
  list->setCurrentRow(0);
  // With the mouse on the drawing Space pans.
  QCursor::setPos(list->mapToGlobal(list->rect().center()));
  ASSERT_TRUE(waitUntil([this] { return !find<CurveCanvas>("canvas")->underMouse(); }));
  QTest::keyClick(list, Qt::Key_Space);
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  EXPECT_FALSE(session().recipe().choices[0].included);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(session().curves()[0].included);
  session().undoStack()->undo();
  EXPECT_TRUE(session().recipe().choices.empty());
}

TEST_F(Window, TheScaleCanBeTyped) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Scan);
  type(find<QLineEdit>("scan.dpi"), QStringLiteral("254"));
  ASSERT_TRUE(session().recipe().dpi);
  EXPECT_EQ(*session().recipe().dpi, 254.0);
  ASSERT_TRUE(settle());
  EXPECT_NEAR(session().output().frame.mmPerPx, 0.1, 1e-12);
  QTest::mouseClick(find<QAbstractButton>("scan.dpiFromFile"), Qt::LeftButton);
  EXPECT_FALSE(session().recipe().dpi);
}

TEST_F(Window, TheFinderRunsAnAction) {
  openPage(test::zigzagPage());
  window_->action(ActionId::FindAction)->trigger();
  auto* edit = find<QLineEdit>("palette.edit");
  ASSERT_TRUE(edit->isVisible());
  const bool before = window_->view().isVisible(Layer::Segments);
  QTest::keyClicks(edit, QStringLiteral("segments"));
  QTest::keyClick(edit, Qt::Key_Return);
  EXPECT_FALSE(edit->isVisible());
  EXPECT_NE(window_->view().isVisible(Layer::Segments), before);
}

TEST(CommandPalette, RanksLettersInOrder) {
  EXPECT_EQ(CommandPalette::score("xyz", "Undo"), 0);
  EXPECT_EQ(CommandPalette::score("du", "Undo"), 0);
  EXPECT_GT(CommandPalette::score("und", "Undo"), 0);
  EXPECT_GT(CommandPalette::score("zf", "Zoom fit"), CommandPalette::score("zf", "azurfix"));
  EXPECT_GT(CommandPalette::score("redo", "Redo"), CommandPalette::score("redo", "Smooth ragged outlines (Curves)"));
}

TEST_F(Window, StagesHaveHelpAndNames) {
  for (const PanelStage stage : kPanelStages) {
    EXPECT_TRUE(QFile::exists(QStringLiteral(":/help/%1.md").arg(key(stage)))) << key(stage).toStdString();
    auto* button = find<QAbstractButton>(("stage." + key(stage)).toLatin1().constData());
    ASSERT_NE(button, nullptr);
    QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_EQ(window_->stage(), stage);
    EXPECT_TRUE(button->accessibleName().startsWith(label(stage)));
  }
}

TEST_F(Window, ControlsThatTakeTheKeyboardHaveAccessibleNames) {
  for (QWidget* widget : window_->findChildren<QWidget*>()) {
    const bool control = qobject_cast<QAbstractButton*>(widget) || qobject_cast<QAbstractSlider*>(widget) ||
                         qobject_cast<QComboBox*>(widget);
    if (!control || (widget->focusPolicy() & Qt::TabFocus) == 0 ||
        widget->objectName().startsWith(QLatin1String("qt_")))
      continue;
    const auto* button = qobject_cast<QAbstractButton*>(widget);
    const QString spoken = widget->accessibleName().isEmpty() && button ? button->text() : widget->accessibleName();
    EXPECT_FALSE(spoken.isEmpty()) << widget->metaObject()->className() << " " << widget->objectName().toStdString();
  }
}

TEST_F(Window, SettingsComeBack) {
  window_->setStage(PanelStage::Fairing);
  window_->view().setCombScale(3.5);
  window_->view().setVisible(Layer::Comb, false);
  window_->setThemeChoice(ThemeChoice::Dark);
  window_->close();
  window_ = std::make_unique<MainWindow>();
  EXPECT_EQ(window_->view().combScale(), 3.5);
  window_->setStage(PanelStage::Fairing);
  EXPECT_FALSE(window_->view().isVisible(Layer::Comb));
  EXPECT_TRUE(themeOf(window_->palette()).dark);
  window_->setThemeChoice(ThemeChoice::Light);
  EXPECT_FALSE(themeOf(window_->palette()).dark);
}

TEST_F(Window, PlotsHoldFiniteNumbersOverTheWholeLength) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr; }));
  session().selectCurve(0);
  const double length = session().selected()->sketchedFigures.lengthMm;
  for (const PlotTab tab :
       {PlotTab::Radius, PlotTab::Curvature, PlotTab::CurvatureSlope, PlotTab::Speed, PlotTab::Deviation}) {
    const PlotData data = plotData(session(), tab);
    ASSERT_FALSE(data.isEmpty());
    EXPECT_NEAR(data.lengthMm, length, 1e-3 * length);
    EXPECT_LT(data.low, data.high);
    for (const PlotSeries& series : data.series) {
      for (const PlotPoint& point : series.points) {
        ASSERT_TRUE(std::isfinite(point.value));
        ASSERT_TRUE(tab != PlotTab::Radius || point.value > 0.0);
      }
    }
  }
}

TEST(PlotSeries, RadiusIsClamped) {
  EXPECT_EQ(clampedRadius(0.0, 0.1, 500.0), 500.0);
  EXPECT_EQ(clampedRadius(-0.01, 0.1, 500.0), 100.0);
  EXPECT_EQ(clampedRadius(1e9, 0.1, 500.0), 0.1);
  EXPECT_EQ(clampedRadius(std::nan(""), 0.1, 500.0), 0.1);
}

}  // namespace
}  // namespace batten
