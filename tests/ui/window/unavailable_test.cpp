// SPDX-License-Identifier: GPL-3.0-or-later
// What is not available does nothing, and says why.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>

#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

class Unavailable : public test::WindowFixture {
 protected:
  void press3InCanvas() {
    auto* canvas = find<CurveCanvas>("canvas");
    canvas->setFocus();
    QTest::keyClick(canvas, Qt::Key_3);
  }
};

TEST_F(Unavailable, DigitsApplyNoTargetWhereNoneIsShownAndSaySo) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::mixedPage()));
  const Recipe before = session().recipe();
  for (const PanelStage stage : {PanelStage::Scan, PanelStage::Threshold, PanelStage::CleanUp, PanelStage::Edges,
                                 PanelStage::Corners, PanelStage::Export}) {
    window_->setStage(stage);
    press3InCanvas();
    EXPECT_EQ(session().recipe(), before) << label(stage).toStdString();
    EXPECT_TRUE(find<QLabel>("status.hint")->text().contains(QStringLiteral("Targets are applied")))
        << label(stage).toStdString();
  }
  window_->setStage(PanelStage::Fairing);
  press3InCanvas();
  EXPECT_NE(session().recipe(), before);
  ASSERT_TRUE(settle());
}

TEST_F(Unavailable, TheFinderSaysWhyAnActionIsNotAvailable) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::mixedPage()));
  const auto saidOf = [this](const QString& letters) {
    window_->action(ActionId::FindAction)->trigger();
    auto* edit = find<QLineEdit>("palette.edit");
    QTest::keyClicks(edit, letters);
    auto* list = find<QListWidget>("palette.list");
    EXPECT_GT(list->count(), 0);
    const QString said = list->count() > 0 ? list->item(0)->data(Qt::AccessibleTextRole).toString() : QString();
    QTest::keyClick(edit, Qt::Key_Escape);
    return said;
  };
  EXPECT_EQ(saidOf(QStringLiteral("Redo")), QStringLiteral("Redo. Nothing was undone."));
  EXPECT_EQ(saidOf(QStringLiteral("Compute again")), QStringLiteral("Compute again. Nothing was stopped."));
  window_->action(ActionId::FindAction)->trigger();
  auto* list = find<QListWidget>("palette.list");
  for (int i = 0; i < list->count(); ++i)
    EXPECT_FALSE(list->item(i)->data(Qt::AccessibleTextRole).toString().contains(QStringLiteral("Not available")))
        << list->item(i)->text().toStdString();
  QTest::keyClick(find<QLineEdit>("palette.edit"), Qt::Key_Escape);
}

TEST_F(Unavailable, WhatIsGreyedSaysWhy) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::mixedPage()));
  Recipe recipe = session().recipe();
  recipe.fairing.mode = FairingMode::Target;
  session().change(QStringLiteral("Fairing"), recipe);
  ASSERT_TRUE(settle());
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    QCoreApplication::processEvents();
    for (const auto* button : find<QWidget>("inspector")->findChildren<QAbstractButton*>()) {
      if (!button->isVisible() || button->isEnabled()) continue;
      EXPECT_FALSE(button->toolTip().isEmpty()) << label(stage).toStdString() << ": " << button->text().toStdString();
    }
  }
}

}  // namespace
}  // namespace batten
