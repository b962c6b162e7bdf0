// SPDX-License-Identifier: GPL-3.0-or-later
// Habits of hand and eye that the window must not break: where keys go, what undo shows, what the finder finds, what
// one drawing leaves to the next.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <map>

#include "tests/ui/window_fixture.h"
#include "ui/panels/rail/stage_of_change.h"

namespace batten {
namespace {

using test::waitUntil;

class Habits : public test::WindowFixture {
 protected:
  void findAndPress(const QString& letters) {
    window_->action(ActionId::FindAction)->trigger();
    auto* edit = find<QLineEdit>("palette.edit");
    ASSERT_TRUE(edit->isVisible());
    QTest::keyClicks(edit, letters);
    QTest::keyClick(edit, Qt::Key_Return);
  }
};

TEST_F(Habits, EveryShortcutHasOneMeaning) {
  std::map<QString, QString> owners;
  for (const QAction* action : window_->findChildren<QAction*>()) {
    for (const QKeySequence& keys : action->shortcuts()) {
      const auto [at, isNew] = owners.emplace(keys.toString(), action->text());
      EXPECT_TRUE(isNew) << keys.toString().toStdString() << " is " << at->second.toStdString() << " and "
                         << action->text().toStdString();
    }
  }
  EXPECT_EQ(owners[QStringLiteral("Ctrl+R")], actionInfo(ActionId::ComputeAgain).text);
  for (const PanelStage stage : kPanelStages)
    EXPECT_TRUE(owners[QStringLiteral("F%1").arg(static_cast<int>(stage) + 2)].contains(label(stage)));
}

TEST_F(Habits, KeysTypedAfterEnterAreTheDrawings) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Edges);
  window_->activateWindow();
  auto* field = find<QLineEdit>("contours.min_length.field");
  const bool comb = window_->view().isVisible(Layer::Comb);
  type(field, QStringLiteral("60"));
  ASSERT_NE(window_->focusWidget(), nullptr);
  QTest::keyClick(window_->focusWidget(), Qt::Key_C);
  EXPECT_EQ(field->text(), QStringLiteral("60"));
  EXPECT_EQ(session().recipe().contours.minLengthPx, 60.0);
  EXPECT_NE(window_->view().isVisible(Layer::Comb), comb) << "C switches the comb";
  // What cannot be read keeps the keyboard: the typing is not done.
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("wide"));
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_TRUE(field->hasFocus());
  ASSERT_TRUE(settle());
}

TEST_F(Habits, UndoInAnotherStageSaysWhatItChangedAndLeadsThere) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Corners);
  clickCanvas({200, 100});
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  window_->setStage(PanelStage::Fairing);
  auto* hint = find<QLabel>("status.hint");
  auto* show = find<QPushButton>("status.act");
  EXPECT_FALSE(show->isVisible());
  window_->action(ActionId::Undo)->trigger();
  EXPECT_EQ(hint->text(), QStringLiteral("Undone in Corners: Mark corner."));
  ASSERT_TRUE(show->isVisible());
  QTest::mouseClick(show, Qt::LeftButton);
  EXPECT_EQ(window_->stage(), PanelStage::Corners);
  EXPECT_FALSE(show->isVisible());
  window_->action(ActionId::Redo)->trigger();
  EXPECT_EQ(hint->text(), QStringLiteral("Redone: Mark corner."));
  EXPECT_FALSE(show->isVisible()) << "it is seen where one is";
}

TEST_F(Habits, EverySettingIsUndoneInItsTurn) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Threshold);
  type(find<QLineEdit>("threshold.strength.field"), QStringLiteral("1.4"));
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Corners);
  const double angle = window_->view().suggestionAngleDeg(), scale = window_->view().suggestionScalePx();
  type(find<QLineEdit>("corners.suggestScale.field"), QStringLiteral("40"));
  type(find<QLineEdit>("corners.suggestAngle.field"), QStringLiteral("60"));
  EXPECT_EQ(window_->view().suggestionScalePx(), 40.0);
  EXPECT_EQ(window_->view().suggestionAngleDeg(), 60.0);
  auto* undo = window_->action(ActionId::Undo);
  window_->setStage(PanelStage::Fairing);
  undo->trigger();
  EXPECT_EQ(find<QLabel>("status.hint")->text(), QStringLiteral("Undone in Corners: Sharper than."));
  EXPECT_EQ(window_->view().suggestionAngleDeg(), angle);
  EXPECT_EQ(window_->view().suggestionScalePx(), 40.0);
  undo->trigger();
  EXPECT_EQ(window_->view().suggestionScalePx(), scale);
  EXPECT_EQ(session().recipe().threshold.strength, 1.4);
  undo->trigger();
  EXPECT_NE(session().recipe().threshold.strength, 1.4);
  ASSERT_TRUE(settle());
  for (int i = 0; i < 3; ++i) window_->action(ActionId::Redo)->trigger();
  EXPECT_EQ(window_->view().suggestionAngleDeg(), 60.0);
  EXPECT_EQ(session().recipe().threshold.strength, 1.4);
  ASSERT_TRUE(settle());
}

TEST_F(Habits, WhatChangesNoCurveIsNoUnsavedWork) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Corners);
  type(find<QLineEdit>("corners.suggestScale.field"), QStringLiteral("40"));
  EXPECT_FALSE(session().hasUnsavedChanges());
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  EXPECT_TRUE(session().hasUnsavedChanges());
  EXPECT_TRUE(window_->isWindowModified());
}

TEST_F(Habits, EveryStageKnowsItsChanges) {
  const Recipe plain;
  const auto stageOf = [&](const auto& edit) {
    Recipe changed = plain;
    edit(changed);
    return stageOfChange(plain, changed);
  };
  EXPECT_FALSE(stageOf([](Recipe&) {}));
  EXPECT_EQ(stageOf([](Recipe& r) { r.dpi = 300.0; }), PanelStage::Scan);
  EXPECT_EQ(stageOf([](Recipe& r) { r.threshold.grid[3] = 99.0; }), PanelStage::Threshold);
  EXPECT_EQ(stageOf([](Recipe& r) { r.filter.coefficient = 3; }), PanelStage::CleanUp);
  EXPECT_EQ(stageOf([](Recipe& r) { r.contours.minLengthPx += 1.0; }), PanelStage::Edges);
  EXPECT_EQ(stageOf([](Recipe& r) { r.cornerMarks = {{Vec2(1, 2)}}; }), PanelStage::Corners);
  EXPECT_EQ(stageOf([](Recipe& r) { r.construct.method = ConstructMethod::Bezier; }), PanelStage::Curves);
  EXPECT_EQ(stageOf([](Recipe& r) { r.choices = {{.anchorsPx = {Vec2(1, 2)}, .included = false}}; }),
            PanelStage::Curves);
  EXPECT_EQ(stageOf([](Recipe& r) { r.choices = {{.anchorsPx = {Vec2(1, 2)}, .target = FairingTarget::Degree3}}; }),
            PanelStage::Fairing);
  EXPECT_EQ(stageOf([](Recipe& r) { r.fairing.toleranceMm = 1.0; }), PanelStage::Fairing);
}

TEST_F(Habits, TheFinderFindsSettingsAndLeadsToThem) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->activateWindow();
  Recipe fairs = session().recipe();
  fairs.fairing.mode = FairingMode::Tolerance;  // without a fairing its tolerance means nothing, and is greyed
  session().change(QStringLiteral("Fairing"), fairs);
  ASSERT_TRUE(settle());
  ASSERT_NO_FATAL_FAILURE(findAndPress(QStringLiteral("tolerance (fairing)")));
  EXPECT_EQ(window_->stage(), PanelStage::Fairing);
  EXPECT_EQ(window_->focusWidget(), find<QLineEdit>("fairing.tolerance.field"));
  // One that is folded away, in a panel that scrolls.
  auto* samples = find<QLineEdit>("fairing.samples.field");
  ASSERT_FALSE(samples->isVisible());
  window_->setStage(PanelStage::Scan);
  ASSERT_NO_FATAL_FAILURE(
      findAndPress(window_->findChild<QAction*>(QStringLiteral("setting.fairing.samples.field"))->text()));
  EXPECT_TRUE(samples->isVisible());
  EXPECT_EQ(window_->focusWidget(), samples);
  EXPECT_TRUE(waitUntil([&] { return !samples->visibleRegion().isEmpty(); }, 3000));
  ASSERT_NO_FATAL_FAILURE(findAndPress(QStringLiteral("resolution in dpi")));
  EXPECT_EQ(window_->focusWidget(), find<QLineEdit>("scan.dpi"));
  ASSERT_NO_FATAL_FAILURE(findAndPress(QStringLiteral("axis of the radius plot (curves)")));
  EXPECT_EQ(window_->focusWidget(), find<QAbstractButton>("view.radiusAxis.logarithmic"));
  // Of what does not apply now it says so.
  window_->action(ActionId::FindAction)->trigger();
  EXPECT_FALSE(window_->findChild<QAction*>(QStringLiteral("setting.construct.lowpass.field"))->isEnabled())
      << "belongs to the Bézier path";
  EXPECT_TRUE(window_->findChild<QAction*>(QStringLiteral("setting.fairing.tolerance.field")) != nullptr);
}

TEST_F(Habits, OneDrawingLeavesNothingToTheNext) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Corners);
  const int usualAngle = find<QSlider>("corners.suggestAngle")->value(),
            usualScale = find<QSlider>("corners.suggestScale")->value();
  find<QSlider>("corners.suggestScale")->setValue(40);
  find<QSlider>("corners.suggestAngle")->setValue(61);
  window_->view().setSelectedRegion(27);
  const QString other = folder_.filePath(QStringLiteral("other.png"));
  ASSERT_TRUE(test::ellipsePage().save(other));
  ASSERT_NO_FATAL_FAILURE(openFile(other));
  EXPECT_EQ(find<QSlider>("corners.suggestScale")->value(), usualScale);
  EXPECT_EQ(find<QSlider>("corners.suggestAngle")->value(), usualAngle);
  EXPECT_FALSE(window_->view().selectedRegion());
}

TEST_F(Habits, TabGoesFromTheDrawingToThePanelsAndTheStatusLineComesLast) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::CleanUp);
  window_->activateWindow();
  auto* canvas = find<CurveCanvas>("canvas");
  canvas->setFocus();
  ASSERT_TRUE(waitUntil([&] { return canvas->hasFocus(); }, 3000));
  QTest::keyClick(canvas, Qt::Key_Tab);
  const QWidget* next = window_->focusWidget();
  ASSERT_NE(next, nullptr);
  EXPECT_TRUE(find<QWidget>("panel.clean-up")->isAncestorOf(next)) << next->objectName().toStdString();
}

}  // namespace
}  // namespace batten
