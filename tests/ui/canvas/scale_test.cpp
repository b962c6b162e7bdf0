// SPDX-License-Identifier: GPL-3.0-or-later
// The right size: measured on the drawing, by the paper, by the width.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QUndoStack>

#include "tests/ui/rendered_scan.h"
#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

using test::waitUntil;

class TrueSize : public test::WindowFixture {
 protected:
  void drag(const Vec2& from, const Vec2& to, Qt::KeyboardModifiers keys = {}) {
    QCoreApplication::processEvents();
    auto* canvas = find<CurveCanvas>("canvas");
    const QPoint a = canvas->toWidget(from).toPoint(), b = canvas->toWidget(to).toPoint();
    QTest::mousePress(canvas, Qt::LeftButton, keys, a);
    QTest::mouseMove(canvas, (a + b) / 2);
    QTest::mouseMove(canvas, b);
    QTest::mouseRelease(canvas, Qt::LeftButton, keys, b);
  }
  /// What a line between two places of the picture measures on the screen's grid.
  double onScreen(const Vec2& from, const Vec2& to) {
    auto* canvas = find<CurveCanvas>("canvas");
    return (canvas->toImage(canvas->toWidget(from).toPoint()) - canvas->toImage(canvas->toWidget(to).toPoint())).norm();
  }
};

TEST_F(TrueSize, AKnownLengthIsMeasuredOnTheDrawing) {
  openPage(test::ellipsePage());
  window_->action(ActionId::ToolScale)->trigger();
  EXPECT_EQ(window_->stage(), PanelStage::Scan);
  auto* length = find<QLineEdit>("scale.length");
  EXPECT_FALSE(length->isVisible());
  drag({100, 200}, {500, 200});
  ASSERT_TRUE(waitUntil([&] { return length->isVisible(); }));
  EXPECT_TRUE(length->hasFocus()) << "its length is asked for";
  EXPECT_FALSE(session().recipe().dpi) << "nothing is known before it is typed";
  const double px = onScreen({100, 200}, {500, 200});
  find<QComboBox>("scale.unit")->setCurrentIndex(2);
  type(length, QStringLiteral("4"));
  ASSERT_TRUE(session().recipe().scaleLine);
  EXPECT_NEAR(*session().recipe().dpi, px / 4.0, 1e-6);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 101.6, 1e-9);
  const QString status = find<QLabel>("status.scale")->toolTip();
  EXPECT_TRUE(status.contains(QStringLiteral(" mm"))) << status.toStdString();
  // An end that is dragged keeps the length.
  drag({500, 200}, {300, 200});
  ASSERT_TRUE(session().recipe().scaleLine);
  EXPECT_NEAR(*session().recipe().dpi, onScreen({100, 200}, {300, 200}) / 4.0, 1.0);
  session().undoStack()->undo();
  EXPECT_NEAR(*session().recipe().dpi, px / 4.0, 1e-6);
  session().undoStack()->undo();
  EXPECT_FALSE(session().recipe().dpi);
  EXPECT_FALSE(session().recipe().scaleLine);
  ASSERT_TRUE(settle());
}

TEST_F(TrueSize, AUnitMayBeTypedOrPickedBehindTheNumber) {
  openPage(test::ellipsePage());
  window_->action(ActionId::ToolScale)->trigger();
  drag({100, 200}, {500, 200});
  auto* length = find<QLineEdit>("scale.length");
  ASSERT_TRUE(waitUntil([&] { return length->isVisible(); }));
  auto* unit = find<QComboBox>("scale.unit");
  unit->setCurrentIndex(0);
  type(length, QStringLiteral("4 in"));
  ASSERT_TRUE(session().recipe().scaleLine);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 101.6, 1e-9);
  unit->setCurrentIndex(2);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 101.6, 1e-9) << "a unit that was typed counts";
  unit->setCurrentIndex(0);
  type(length, QStringLiteral("12"));
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 12.0, 1e-9);
  unit->setCurrentIndex(1);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 120.0, 1e-9) << "the number that was typed stands";
  EXPECT_EQ(length->text(), QStringLiteral("12.00"));
  // What was not typed just now is shown in the other unit.
  session().undoStack()->undo();
  unit->setCurrentIndex(0);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 12.0, 1e-9);
  unit->setCurrentIndex(1);
  EXPECT_NEAR(session().recipe().scaleLine->lengthMm, 12.0, 1e-9);
  EXPECT_EQ(length->text(), QStringLiteral("1.20"));
  ASSERT_TRUE(settle());
}

TEST_F(TrueSize, TwoClicksDoAsADragAndEscapeTakesThemBack) {
  openPage(test::ellipsePage());
  find<QAbstractButton>("scale.measure")->click();
  auto* length = find<QLineEdit>("scale.length");
  clickCanvas({100, 100});
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Escape);
  clickCanvas({100, 150});
  auto* canvas = find<CurveCanvas>("canvas");
  QTest::mouseMove(canvas, canvas->toWidget({300, 150}).toPoint());
  clickCanvas({400, 150});
  ASSERT_TRUE(waitUntil([&] { return length->isVisible(); }));
  type(length, QStringLiteral("30"));
  ASSERT_TRUE(session().recipe().scaleLine);
  EXPECT_NEAR(*session().recipe().dpi, onScreen({100, 150}, {400, 150}) * 25.4 / 30.0, 1e-6);
  // A resolution that is typed later is another word on the same thing.
  type(find<QLineEdit>("scan.dpi"), QStringLiteral("300"));
  EXPECT_EQ(session().recipe().dpi, 300.0);
  EXPECT_FALSE(session().recipe().scaleLine);
  ASSERT_TRUE(settle());
}

TEST_F(TrueSize, PaperAndWidthSayItToo) {
  openPage(test::ellipsePage({594, 420}));
  auto* paper = find<QComboBox>("scale.paper");
  paper->setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(paper, Qt::Key_Down);
  ASSERT_EQ(paper->currentText(), QStringLiteral("A4"));
  EXPECT_NEAR(*session().recipe().dpi, 50.8, 1e-9);
  const auto* status = find<QLabel>("status.scale");
  EXPECT_TRUE(status->toolTip().contains(QStringLiteral("297.0 × 210.0 mm"))) << status->toolTip().toStdString();
  EXPECT_FALSE(status->text().contains(QStringLiteral("mm"))) << "the chip on the drawing says it";
  type(find<QLineEdit>("scale.width"), QStringLiteral("594"));
  EXPECT_NEAR(*session().recipe().dpi, 25.4, 1e-9);
  type(find<QLineEdit>("scale.width"), QStringLiteral("10 in"));
  EXPECT_NEAR(*session().recipe().dpi, 59.4, 1e-9);
  ASSERT_TRUE(settle());
}

TEST_F(TrueSize, APaperOfAnotherShapeIsSaid) {
  openPage(test::ellipsePage({640, 640}));
  auto* paper = find<QComboBox>("scale.paper");
  paper->setFocus();
  QTest::keyClick(paper, Qt::Key_Down);
  EXPECT_TRUE(find<QLabel>("scale.note")->text().contains(QStringLiteral("not a whole sheet of A6")))
      << find<QLabel>("scale.note")->text().toStdString();
  ASSERT_TRUE(settle());
}

}  // namespace
}  // namespace batten
