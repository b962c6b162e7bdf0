// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QTextBrowser>
#include <cmath>

#include "core/curve/closest_point.h"
#include "core/curve/variation_energy.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/curves/method_table.h"
#include "ui/panels/stages/curves/pin_panel.h"
#include "ui/session/curves/curve_names.h"

namespace batten {
namespace {

using test::waitUntil;

class Compare : public test::WindowFixture {
 protected:
  /// A line with two corners, in stage Curves.
  void openThreePieces() {
    openPage(test::zigzagPage());
    Recipe marked = session().recipe();
    marked.cornerMarks = {{{200, 100}}, {{400, 300}}};
    session().change(QStringLiteral("Marks"), marked);
    ASSERT_TRUE(settle());
    window_->setStage(PanelStage::Curves);
  }
};

TEST_F(Compare, EveryMethodIsComputedAndChosenFromTheTable) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  auto* table = find<MethodTable>("construct.method.row");
  for (const ConstructMethod method : kMethods) {
    ASSERT_TRUE(waitUntil([&] { return table->figures(method).has_value(); })) << word(method).toStdString();
    QTest::mouseClick(find<QAbstractButton>(("construct.method." + word(method)).toLatin1().constData()),
                      Qt::LeftButton);
    EXPECT_EQ(session().recipe().construct.method, method);
    ASSERT_TRUE(settle());
    // What the table foretold is what the drawing then has.
    ASSERT_NE(session().selected(), nullptr);
    ASSERT_TRUE(waitUntil([&] { return table->figures(method).has_value(); }));
    EXPECT_EQ(table->figures(method)->controlPoints, session().selected()->sketchedFigures.controlPoints);
    EXPECT_EQ(table->figures(method)->fromPoints.rms, session().selected()->sketchedFigures.fromPoints.rms);
  }
}

TEST_F(Compare, OneCurveCanHaveAMethodOfItsOwn) {
  openThreePieces();
  ASSERT_EQ(session().curves().size(), 3u);
  session().selectCurve(1);
  const auto click = [this](const char* name) { QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton); };
  auto* table = find<MethodTable>("construct.method.row");
  // The figures are the selected curve's, and so is the click.
  EXPECT_TRUE(find<QAbstractButton>("construct.scope.one")->isChecked());
  EXPECT_TRUE(find<QLabel>("construct.method.whose")->text().contains(curveName(session(), 1)));
  ASSERT_TRUE(waitUntil([&] { return table->figures(ConstructMethod::ControlPolygon).has_value(); }));
  const CurveFigures foretold = *table->figures(ConstructMethod::ControlPolygon);
  const NurbsCurve first = session().curves()[0].sketched;
  click("construct.method.control-polygon");
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().construct.method, ConstructMethod::Fair);
  EXPECT_EQ(session().curves()[1].sketched.degree(), session().recipe().construct.degree);
  EXPECT_EQ(session().curves()[1].sketchedFigures.controlPoints, foretold.controlPoints);
  EXPECT_EQ(session().curves()[1].sketchedFigures.fromPoints.rms, foretold.fromPoints.rms);
  EXPECT_TRUE(session().curves()[0].sketched == first);
  EXPECT_TRUE(find<QAbstractButton>("construct.method.control-polygon")->isChecked());
  session().selectCurve(0);
  EXPECT_TRUE(find<QAbstractButton>("construct.method.fair")->isChecked());
  session().selectCurve(1);
  click("construct.method.fair");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(session().recipe().choices.empty()) << "as all others: nothing of its own is left";
  // Said to be for all, it is for all, also for those that had one of their own.
  click("construct.method.bezier");
  click("construct.scope.all");
  click("construct.method.nurbs");
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().construct.method, ConstructMethod::Nurbs);
  EXPECT_TRUE(session().recipe().choices.empty());
}

TEST_F(Compare, DetailBelongsToAllCurvesOrToOne) {
  openThreePieces();
  ASSERT_EQ(session().curves().size(), 3u);
  session().selectCurve(1);
  const auto click = [this](const char* name) { QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton); };
  const auto tolerancePx = [this](std::size_t curve) { return session().curves()[curve].construct.light->tolerancePx; };
  click("construct.detail.scope.one");
  type(find<QLineEdit>("construct.detail.field"), QStringLiteral("0.6"));
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().construct.detail, 0.0);
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  EXPECT_EQ(session().recipe().choices[0].detail, 0.6);
  EXPECT_GT(tolerancePx(1), tolerancePx(0));
  EXPECT_EQ(tolerancePx(2), tolerancePx(0));
  type(find<QLineEdit>("construct.detail.field"), QStringLiteral("0"));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(session().recipe().choices.empty()) << "as all others: nothing of its own is left";
  click("construct.detail.scope.all");
  type(find<QLineEdit>("construct.detail.field"), QStringLiteral("0.5"));
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().construct.detail, 0.5);
  EXPECT_TRUE(session().recipe().choices.empty());
  EXPECT_GT(tolerancePx(0), session().recipe().construct.lightTolerancePx);
}

TEST_F(Compare, APinnedResultStaysAndIsSetBesideThePresentOne) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  auto* figures = find<FigureTable>("pin.figures");
  EXPECT_FALSE(figures->isVisible());
  const TracedCurve before = *session().selected();
  QTest::mouseClick(find<QAbstractButton>("pin.set"), Qt::LeftButton);
  ASSERT_TRUE(session().pinned());
  EXPECT_TRUE(window_->action(ActionId::Pin)->isChecked());
  QTest::mouseClick(find<QAbstractButton>("construct.method.control-polygon"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  ASSERT_NE(session().pinnedOf(session().selectedCurve()), nullptr);
  EXPECT_EQ(session().pinnedOf(session().selectedCurve())->sketched, before.sketched);
  EXPECT_FALSE(session().selected()->sketched == before.sketched);
  const QString points = QString::number(session().selected()->sketchedFigures.controlPoints);
  ASSERT_TRUE(waitUntil([&] {
    return figures->isVisible() && figures->rows().size() == 6 && figures->rows()[2].cells[1].text == points;
  }));
  EXPECT_EQ(figures->rows()[2].cells[0].text, QString::number(before.sketchedFigures.controlPoints));
  EXPECT_EQ(figures->rows()[3].cells[1].text, QString::number(session().selected()->sketchedFigures.extrema));
  const Comparison c = compare(before, *session().selected());
  EXPECT_EQ(c.pinned.energy, variationEnergy(before.sketched));
  EXPECT_GE(c.apartMm, deviation(before.sketched, session().selected()->sketched).rms);
  // Undo and redo leave the pin alone; its button takes it away.
  session().undoStack()->undo();
  EXPECT_TRUE(session().pinned());
  QTest::mouseClick(find<QAbstractButton>("pin.clear"), Qt::LeftButton);
  EXPECT_FALSE(session().pinned());
  ASSERT_TRUE(settle());
  window_->action(ActionId::Pin)->trigger();
  EXPECT_TRUE(session().pinned());
  window_->action(ActionId::Pin)->trigger();
  EXPECT_FALSE(session().pinned());
}

TEST_F(Compare, NothingIsPinnedWhileItsPartsAreOfTwoRuns) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  Recipe recipe = session().recipe();
  recipe.cornerMarks.clear();
  recipe.edges.mode = EdgeMode::Outline;
  session().change(QStringLiteral("Outline"), recipe);
  session().pin();
  EXPECT_FALSE(session().pinned());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(find<QAbstractButton>("pin.set")->isEnabled());
  session().pin();
  ASSERT_TRUE(session().pinned());
  EXPECT_EQ(session().pinned()->pieces, session().output().pieces);
}

TEST_F(Compare, EveryMethodHasAHelpPageBehindTheQuestionMark) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  for (const ConstructMethod method : kMethods) {
    EXPECT_TRUE(QFile::exists(QStringLiteral(":/help/%1.md").arg(helpPage(method)))) << helpPage(method).toStdString();
    Recipe recipe = session().recipe();
    recipe.construct.method = method;
    session().change(QStringLiteral("Method"), recipe);
    QTest::mouseClick(find<QAbstractButton>("construct.method.help"), Qt::LeftButton);
    auto* text = window_->findChild<QTextBrowser*>(QStringLiteral("help.text"));
    ASSERT_NE(text, nullptr);
    EXPECT_GT(text->toPlainText().size(), 400) << helpPage(method).toStdString();
  }
}

TEST_F(Compare, ARecentFileOpensWithTheRecipeBesideIt) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.cornerMarks = {{{200, 100}}};
  recipe.construct.method = ConstructMethod::Bezier;
  QFile file(folder_.filePath(QStringLiteral("page.recipe.json")));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(recipeToJson(recipe)));
  file.close();
  // By the menu of recent files, as a user would.
  auto* menu = window_->findChild<QMenu*>(QStringLiteral("recentMenu"));
  ASSERT_NE(menu, nullptr);
  emit menu->aboutToShow();
  ASSERT_FALSE(menu->actions().isEmpty());
  menu->actions().first()->trigger();
  ASSERT_TRUE(waitUntil([&] { return session().recipe() == recipe && !session().isBusy(); }));
  EXPECT_EQ(session().curves().size(), 2u);
}

TEST_F(Compare, AFileDroppedOnTheWindowIsOpened) {
  const QString path = folder_.filePath(QStringLiteral("dropped drawing.png"));
  ASSERT_TRUE(test::ellipsePage().save(path));
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(path)});
  QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &drop);
  ASSERT_TRUE(waitUntil([this] { return session().hasScan() && !session().isBusy(); }));
  EXPECT_EQ(QFileInfo(session().scanPath()), QFileInfo(path));
  EXPECT_EQ(session().curves().size(), 1u);
}

TEST_F(Compare, CurvesAreWalkedByTheirOwnKeysAndArrowsMoveTheSelectedCorner) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  clickCanvas({200, 100});
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  auto* canvas = find<CurveCanvas>("canvas");
  const Vec2 before = session().recipe().cornerMarks[0].positionPx;
  const int steps = session().undoStack()->count();
  QTest::keyClick(canvas, Qt::Key_Right);
  QTest::keyClick(canvas, Qt::Key_Right);
  QTest::keyClick(canvas, Qt::Key_Up, Qt::ShiftModifier);
  EXPECT_LT((session().recipe().cornerMarks[0].positionPx - (before + Vec2(2.0, -0.1))).norm(), 1e-9);
  EXPECT_EQ(session().undoStack()->count(), steps + 1) << "arrows in a row are one step";
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 2u);
  window_->setStage(PanelStage::Curves);
  session().selectCurve(0);
  window_->activateWindow();
  canvas->setFocus();
  QTest::keyClick(canvas, Qt::Key_N);
  EXPECT_EQ(session().selectedCurve(), 1);
  QTest::keyClick(canvas, Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(session().selectedCurve(), 0);
  // Tab leaves the drawing at once, however many curves there are.
  QTest::keyClick(canvas, Qt::Key_Tab);
  EXPECT_EQ(session().selectedCurve(), 0);
  EXPECT_FALSE(canvas->hasFocus());
}

}  // namespace
}  // namespace batten
