// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QLabel>
#include <QListWidget>
#include <QRegularExpression>
#include <cmath>
#include <numbers>

#include "tests/ui/window_fixture.h"
#include "ui/new_drawing_dialog.h"
#include "ui/panels/stages/curves/curve_list.h"

namespace batten {
namespace {

using test::waitUntil;

/// How fair curves are, where the window says it.
class Fairness : public test::WindowFixture {
 protected:
  /// The list that is shown.
  CurveList* list() {
    for (auto* one : window_->findChildren<CurveList*>())
      if (one->isVisible()) return one;
    return nullptr;
  }
  QString badge(int row) { return list()->item(row)->data(CurveList::kBadgeRole).toString(); }
  double similarity(int row) { return badge(row).mid(2).toDouble(); }
  bool areAllKnown(int rows) {
    if (list() == nullptr || list()->count() != rows) return false;
    for (int i = 0; i < rows; ++i)
      if (badge(i).isEmpty()) return false;
    return true;
  }
  void beginPage() {
    window_->beginDrawing(NewDrawingDialog::recipeFor({200, 120}, 127.0));
    ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  }
  void moveTo(const Vec2& px) {
    auto* canvas = find<CurveCanvas>("canvas");
    QMouseEvent move(QEvent::MouseMove, canvas->toWidget(px), canvas->mapToGlobal(canvas->toWidget(px)), Qt::NoButton,
                     Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas, &move);
  }
  /// A line from left to right with this many waves, drawn with the pen.
  void draw(double top, double waves, double height) {
    auto* canvas = find<CurveCanvas>("canvas");
    const auto at = [&](double t) {
      return Vec2(100.0 + 700.0 * t, top + 60.0 * t * t + height * std::sin(2.0 * std::numbers::pi * waves * t));
    };
    QTest::mousePress(canvas, Qt::LeftButton, {}, canvas->toWidget(at(0.0)).toPoint());
    for (int i = 1; i <= 80; ++i) moveTo(at(i / 80.0));
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, canvas->toWidget(at(1.0)).toPoint());
    ASSERT_TRUE(settle());
  }
};

TEST_F(Fairness, EveryListedCurveHasABadgeWithItsFigures) {
  ASSERT_NO_FATAL_FAILURE(beginPage());
  ASSERT_NO_FATAL_FAILURE(draw(120.0, 0.0, 0.0));
  ASSERT_NO_FATAL_FAILURE(draw(320.0, 3.0, 25.0));
  window_->setStage(PanelStage::Curves);
  ASSERT_TRUE(waitUntil([this] { return areAllKnown(2); }));
  EXPECT_TRUE(badge(0).startsWith(QStringLiteral("M "))) << "S is of targets";
  EXPECT_GT(similarity(0), similarity(1)) << "three waves are less fair than one bow";
  EXPECT_GT(similarity(0), 0.8);
  for (int i = 0; i < 2; ++i) {
    const CurveFigures& figures = session().curves()[i].sketchedFigures;
    const QString tip = list()->item(i)->toolTip();
    EXPECT_TRUE(tip.contains(QStringLiteral("extrema of the curvature: %1").arg(figures.extrema))) << tip.toStdString();
    EXPECT_TRUE(tip.contains(QStringLiteral("control points: %1").arg(figures.controlPoints))) << tip.toStdString();
    EXPECT_TRUE(list()->item(i)->data(Qt::AccessibleTextRole).toString().contains(QStringLiteral("Monotone: M")));
  }
}

TEST_F(Fairness, TheBadgeIsDrawnAndFollowsTheCurve) {
  ASSERT_NO_FATAL_FAILURE(beginPage());
  ASSERT_NO_FATAL_FAILURE(draw(320.0, 3.0, 25.0));
  window_->setStage(PanelStage::Curves);
  ASSERT_TRUE(waitUntil([this] { return areAllKnown(1); }));
  const double before = similarity(0);
  const QImage with = list()->grab().toImage();
  list()->item(0)->setData(CurveList::kBadgeRole, QString());
  EXPECT_NE(list()->grab().toImage(), with) << "nothing of it is seen";
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  window_->view().setTool(Tool::Pen);
  ASSERT_NO_FATAL_FAILURE(draw(320.0, 0.0, 0.0));
  window_->setStage(PanelStage::Curves);
  ASSERT_TRUE(waitUntil([this, before] { return areAllKnown(1) && similarity(0) > before; }));
}

TEST_F(Fairness, IsToldWhileThePenDraws) {
  ASSERT_NO_FATAL_FAILURE(beginPage());
  auto* canvas = find<CurveCanvas>("canvas");
  auto* hint = find<QLabel>("status.hint");
  const auto at = [](double t) { return Vec2(100.0 + 600.0 * t, 120.0 + 200.0 * t * t); };
  QTest::mousePress(canvas, Qt::LeftButton, {}, canvas->toWidget(at(0.0)).toPoint());
  for (int i = 1; i <= 30; ++i) moveTo(at(i / 60.0));
  ASSERT_TRUE(waitUntil([hint] { return hint->text().startsWith(QStringLiteral("M ")); }));
  EXPECT_TRUE(hint->text().contains(QStringLiteral("extrema: "))) << hint->text().toStdString();
  EXPECT_TRUE(hint->text().contains(QStringLiteral("control points: ")));
  EXPECT_TRUE(session().curves().empty()) << "the line is not in the drawing yet";
  for (int i = 31; i <= 60; ++i) moveTo(at(i / 60.0));
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, canvas->toWidget(at(1.0)).toPoint());
  ASSERT_TRUE(settle());
  EXPECT_FALSE(hint->text().startsWith(QStringLiteral("M "))) << hint->text().toStdString();
  EXPECT_EQ(session().curves().size(), 1u);
}

TEST_F(Fairness, OfAStrokeAcrossALongPageIsThatOfTheWholeStroke) {
  constexpr double kWavePx = 900.0, kWaves = 12.0;
  window_->beginDrawing(NewDrawingDialog::recipeFor({2400, 120}, 127.0));
  ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  auto* canvas = find<CurveCanvas>("canvas");
  auto* hint = find<QLabel>("status.hint");
  const auto at = [](double t) {
    return Vec2(200.0 + kWavePx * kWaves * t, 300.0 + 150.0 * std::sin(2.0 * std::numbers::pi * kWaves * t));
  };
  QTest::mousePress(canvas, Qt::LeftButton, {}, canvas->toWidget(at(0.0)).toPoint());
  for (int i = 1; i <= 600; ++i) moveTo(at(i / 600.0));
  const auto told = [hint] {
    static const QRegularExpression count(QStringLiteral("extrema: (\\d+)"));
    return count.match(hint->text()).captured(1).toInt();
  };
  EXPECT_TRUE(waitUntil([&] { return told() >= 2 * static_cast<int>(kWaves) - 2; })) << hint->text().toStdString();
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, canvas->toWidget(at(1.0)).toPoint());
  ASSERT_TRUE(settle());
}

}  // namespace
}  // namespace batten
