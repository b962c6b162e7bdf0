// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QCursor>
#include <QListWidget>
#include <QWheelEvent>

#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/session/curves/extremum_marks.h"

namespace batten {
namespace {

using test::waitUntil;

class Gesture : public test::WindowFixture {
 protected:
  CurveCanvas* canvas() { return find<CurveCanvas>("canvas"); }
  QPoint at(double x, double y) { return canvas()->toWidget({x, y}).toPoint(); }
  void press(double x, double y) { QTest::mousePress(canvas(), Qt::LeftButton, {}, at(x, y)); }
  void dragTo(double x, double y) {
    const QPointF to = canvas()->toWidget({x, y});
    QMouseEvent move(QEvent::MouseMove, to, canvas()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas(), &move);
  }
  void release(double x, double y) { QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at(x, y)); }
  void hover(double x, double y) {
    const QPointF to = canvas()->toWidget({x, y});
    QMouseEvent move(QEvent::MouseMove, to, canvas()->mapToGlobal(to), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas(), &move);
  }
  void wheel(double x, double y, int eighths) {
    const QPointF place = canvas()->toWidget({x, y});
    QWheelEvent event(place, canvas()->mapToGlobal(place), {}, {0, eighths}, Qt::NoButton, {}, Qt::NoScrollPhase,
                      false);
    QCoreApplication::sendEvent(canvas(), &event);
  }
};

TEST_F(Gesture, EscTakesBackWhatTheButtonHoldsAndNothingElse) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  clickCanvas({130, 200});
  ASSERT_TRUE(settle());
  const Recipe before = session().recipe();
  const int steps = session().undoStack()->count();
  canvas()->setFocus();
  const struct {
    ActionId tool;
    Vec2 from, to;
  } drags[] = {{ActionId::ToolCorners, before.cornerMarks[0].positionPx, {160, 157}},
               {ActionId::ToolCorners, {300, 200}, {330, 230}},
               {ActionId::ToolSegments, {300, 200}, {330, 230}},
               {ActionId::ToolThresholds, {280, 125}, {280, 90}},
               {ActionId::ToolPen, {60, 40}, {200, 60}},
               {ActionId::ToolRectangle, {60, 40}, {200, 160}},
               {ActionId::ToolLasso, {60, 40}, {200, 160}}};
  for (const auto& drag : drags) {
    window_->action(drag.tool)->trigger();
    // A message that Esc would hide, and work that it would stop.
    find<ErrorStrip>("errorStrip")->show(QStringLiteral("something"), {});
    emit session().selectionChanged();
    press(drag.from.x(), drag.from.y());
    dragTo(0.5 * (drag.from.x() + drag.to.x()), 0.5 * (drag.from.y() + drag.to.y()));
    dragTo(drag.to.x(), drag.to.y());
    QTest::keyClick(canvas(), Qt::Key_Escape);
    EXPECT_EQ(session().recipe(), before) << window_->action(drag.tool)->objectName().toStdString();
    release(drag.to.x(), drag.to.y());
    EXPECT_EQ(session().recipe(), before) << "the button that is let go of later does nothing";
    EXPECT_EQ(session().undoStack()->count(), steps) << "and no step is left";
    EXPECT_TRUE(find<ErrorStrip>("errorStrip")->isVisible());
    ASSERT_TRUE(settle());
    EXPECT_FALSE(session().isStale(StageId::Faired)) << "nor was anything stopped";
    window_->action(ActionId::ToolSelect)->trigger();
  }
}

TEST_F(Gesture, ACornerIsSelectedBeforeItIsRemovedAndTheListShowsTheSame) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  clickCanvas({200, 100});
  ASSERT_TRUE(settle());
  clickCanvas({400, 300});
  ASSERT_TRUE(settle());
  auto* list = find<QListWidget>("corners.list");
  EXPECT_EQ(list->currentRow(), 1) << "the one just marked";
  clickCanvas({200, 100});
  ASSERT_EQ(session().recipe().cornerMarks.size(), 2u) << "the first click selects";
  EXPECT_EQ(session().selectedCorner(), 0);
  EXPECT_EQ(list->currentRow(), 0);
  const Vec2 place = session().recipe().cornerMarks[0].positionPx;
  QTest::keyClick(canvas(), Qt::Key_Right);
  EXPECT_LT((session().recipe().cornerMarks[0].positionPx - place - Vec2(1, 0)).norm(), 1e-9);
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  list->setCurrentRow(1);
  EXPECT_EQ(session().selectedCorner(), 1);
  canvas()->setFocus();
  QTest::keyClick(canvas(), Qt::Key_Backtab);
  EXPECT_EQ(session().selectedCorner(), 0);
  QTest::keyClick(canvas(), Qt::Key_Tab);
  EXPECT_EQ(session().selectedCorner(), 1) << "Tab walks the corners in this tool";
  clickCanvas({400, 300});
  EXPECT_EQ(session().recipe().cornerMarks.size(), 1u) << "a click on the selected one removes it";
}

TEST_F(Gesture, UndoUnderTheMouseLeavesNoGhost) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  clickCanvas({200, 100});
  ASSERT_TRUE(settle());
  clickCanvas({400, 300});
  ASSERT_TRUE(settle());
  hover(200, 100);
  EXPECT_EQ(canvas()->cursor().shape(), Qt::PointingHandCursor);
  session().undoStack()->undo();  // the mark at (400, 300)
  session().undoStack()->undo();  // the mark under the mouse
  ASSERT_TRUE(session().recipe().cornerMarks.empty());
  EXPECT_FALSE(session().selectedCorner());
  canvas()->setFocus();
  QTest::keyClick(canvas(), Qt::Key_Delete);
  session().undoStack()->redo();
  session().undoStack()->redo();
  ASSERT_TRUE(settle());
  hover(400, 300);
  // The first is taken away in the list: what is under the mouse is now number 0, not 1.
  Recipe recipe = session().recipe();
  recipe.cornerMarks.erase(recipe.cornerMarks.begin());
  session().change(QStringLiteral("Remove"), recipe);
  const Vec2 kept = recipe.cornerMarks[0].positionPx;
  ASSERT_TRUE(settle());
  QTest::keyClick(canvas(), Qt::Key_Delete);
  EXPECT_TRUE(session().recipe().cornerMarks.empty()) << "Del removes the mark at " << kept.transpose();
}

TEST_F(Gesture, WhatIsNotPaintedCannotBeClickedInAnyStage) {
  QImage page = test::ellipsePage();
  openPage(page);
  const auto curve = session().selectedCurve();
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    window_->action(ActionId::ToolSelect)->trigger();
    const bool shown = window_->view().isVisible(Layer::Curve) && window_->view().isVisible(Layer::Extrema);
    const auto marks = extremumMarks(session(), curve);
    ASSERT_FALSE(marks.empty());
    const Recipe before = session().recipe();
    clickCanvas(marks.front().px);
    EXPECT_EQ(session().recipe() == before, !shown) << key(stage).toStdString();
    while (session().undoStack()->canUndo()) session().undoStack()->undo();
    ASSERT_TRUE(settle());
    session().selectCurve(std::nullopt);
    clickCanvas({320, 80});
    const bool line = window_->view().isVisible(Layer::Curve) || window_->view().isVisible(Layer::Faired);
    EXPECT_EQ(session().selectedCurve().has_value(), line) << key(stage).toStdString();
    while (session().undoStack()->canUndo()) session().undoStack()->undo();
    session().selectCurve(curve);
    ASSERT_TRUE(settle());
  }
}

TEST_F(Gesture, HeldKeysWorkWhereverTheFocusIsButInText) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  window_->activateWindow();
  auto* list = find<QListWidget>("corners.suggestions");
  auto* button = find<QAbstractButton>("stage.edges");
  for (QWidget* focus : {static_cast<QWidget*>(button), static_cast<QWidget*>(list)}) {
    focus->setFocus();
    QTest::keyPress(focus, Qt::Key_Backslash);
    EXPECT_TRUE(window_->view().isScanOnly()) << focus->objectName().toStdString();
    QTest::keyRelease(focus, Qt::Key_Backslash);
    EXPECT_FALSE(window_->view().isScanOnly());
  }
  QCursor::setPos(canvas()->mapToGlobal(canvas()->rect().center()));
  ASSERT_TRUE(waitUntil([this] { return canvas()->underMouse(); }));
  QTest::keyPress(button, Qt::Key_Space);
  EXPECT_EQ(canvas()->cursor().shape(), Qt::OpenHandCursor);
  EXPECT_FALSE(button->isDown());
  QTest::keyRelease(button, Qt::Key_Space);
  EXPECT_NE(canvas()->cursor().shape(), Qt::OpenHandCursor);
  EXPECT_EQ(window_->stage(), PanelStage::Corners) << "the button was not pressed";
  window_->setStage(PanelStage::Export);
  auto* path = find<QLineEdit>("export.path");
  path->setFocus();
  const QString before = path->text();
  QTest::keyClick(path, '\\');
  QTest::keyClick(path, Qt::Key_Space);
  EXPECT_EQ(path->text(), before + QStringLiteral("\\ "));
  EXPECT_FALSE(window_->view().isScanOnly());
}

TEST_F(Gesture, FineWheelsAddUpInBothDirections) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Threshold);
  const double before = session().output().thresholds->level[19];
  for (int i = 0; i < 40; ++i) wheel(280, 125, -12);  // four notches in fortieths
  ASSERT_TRUE(session().recipe().threshold.grid[19]);
  EXPECT_NEAR(*session().recipe().threshold.grid[19], before - 8.0, 0.5);
  for (int i = 0; i < 80; ++i) wheel(280, 125, 12);
  EXPECT_NEAR(*session().recipe().threshold.grid[19], before + 8.0, 0.5);
  EXPECT_EQ(session().undoStack()->count(), 1);
}

}  // namespace
}  // namespace batten
