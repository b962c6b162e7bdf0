// SPDX-License-Identifier: GPL-3.0-or-later
// The trace mode of ink is painted with a brush.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QTest>
#include <algorithm>

#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

class Painting : public test::WindowFixture {
 protected:
  /// A line at y = 100, and a disc at (320, 260).
  void openInk() {
    ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
      painter.setPen(QPen(QColor(30, 30, 30), 7.0, Qt::SolidLine, Qt::FlatCap));
      painter.drawLine(QPointF(60, 100), QPointF(580, 100));
      painter.setPen(Qt::NoPen);
      painter.setBrush(QColor(30, 30, 30));
      painter.drawEllipse(QPointF(320, 260), 60, 60);
    })));
    window_->setStage(PanelStage::Edges);
    paint_ = find<QAbstractButton>("edges.paint");
    forget_ = find<QAbstractButton>("edges.forgetPainted");
    ASSERT_TRUE(paint_ && forget_);
    EXPECT_FALSE(forget_->isVisible());
    ASSERT_EQ(countOf(ContourKind::Centreline), 1);
    ASSERT_EQ(countOf(ContourKind::Outline), 1);
  }
  std::ptrdiff_t countOf(ContourKind kind) {
    return std::ranges::count(session().output().contours->contours, kind, &Contour::kind);
  }
  void drag(const Vec2& from, const Vec2& to) {
    QCoreApplication::processEvents();
    auto* canvas = find<CurveCanvas>("canvas");
    const QPoint a = canvas->toWidget(from).toPoint(), b = canvas->toWidget(to).toPoint();
    QTest::mousePress(canvas, Qt::LeftButton, {}, a);
    for (int i = 1; i <= 4; ++i) QTest::mouseMove(canvas, a + (b - a) * i / 4);
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, b);
    ASSERT_TRUE(settle());
  }
  const std::vector<PaintedInk>& painted() { return session().recipe().edges.painted; }
  QAbstractButton* paint_ = nullptr;
  QAbstractButton* forget_ = nullptr;
};

TEST_F(Painting, APartOfALineBecomesAnOutlineAndLivesOnWhenThresholdsMove) {
  ASSERT_NO_FATAL_FAILURE(openInk());
  QTest::mouseClick(paint_, Qt::LeftButton);
  EXPECT_EQ(window_->view().tool(), Tool::Paint);
  EXPECT_TRUE(find<QAbstractButton>("edges.brush.outline")->isVisible());
  ASSERT_NO_FATAL_FAILURE(drag({250, 104}, {400, 97}));
  ASSERT_EQ(painted().size(), 1u);
  EXPECT_EQ(painted()[0].mode, EdgeMode::Outline);
  EXPECT_GE(painted()[0].coursePx.size(), 3u);
  EXPECT_EQ(countOf(ContourKind::Centreline), 2) << "what is left of the line";
  EXPECT_EQ(countOf(ContourKind::Outline), 2);
  EXPECT_TRUE(forget_->isVisible());
  // Other ink than before: the choice holds for it.
  Recipe darker = session().recipe();
  darker.filter.coefficient = 3;
  session().change(QStringLiteral("Coefficient"), darker);
  ASSERT_TRUE(settle());
  EXPECT_EQ(countOf(ContourKind::Outline), 2);
  // In the recipe, and back.
  const Recipe kept = session().recipeToSave();
  session().restore(path_, kept);
  ASSERT_TRUE(test::waitUntil([&] { return session().wasRestored() && !session().isBusy(); }));
  EXPECT_EQ(countOf(ContourKind::Outline), 2);
  QTest::mouseClick(forget_, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(painted().empty());
  EXPECT_EQ(countOf(ContourKind::Outline), 1);
  window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(countOf(ContourKind::Outline), 2);
}

TEST_F(Painting, TheBrushTakesBackAndForgetsTheClicksUnderIt) {
  ASSERT_NO_FATAL_FAILURE(openInk());
  // A click has turned the line over as a whole.
  clickCanvas({150, 100});
  QTest::mouseClick(find<QAbstractButton>("edges.way.outline"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(countOf(ContourKind::Centreline), 0);
  ASSERT_EQ(session().recipe().edges.choices.size(), 1u);
  window_->action(ActionId::ToolPaint)->trigger();
  QTest::mouseClick(find<QAbstractButton>("edges.brush.centreline"), Qt::LeftButton);
  EXPECT_EQ(window_->view().paintedMode(), EdgeMode::Centreline);
  ASSERT_NO_FATAL_FAILURE(drag({40, 100}, {600, 100}));
  EXPECT_TRUE(session().recipe().edges.choices.empty()) << "it lay under the brush";
  EXPECT_EQ(countOf(ContourKind::Centreline), 1);
  EXPECT_EQ(session().undoStack()->undoText(), QStringLiteral("Paint centre line"));
  QTest::mouseClick(find<QAbstractButton>("edges.brush.page"), Qt::LeftButton);
  ASSERT_NO_FATAL_FAILURE(drag({40, 100}, {600, 100}));
  EXPECT_EQ(painted().size(), 2u);
  EXPECT_EQ(countOf(ContourKind::Centreline), 1) << "as the page has it";
  for (int i = 0; i < 2; ++i) window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().edges.choices.size(), 1u);
  EXPECT_EQ(countOf(ContourKind::Centreline), 0);
}

TEST_F(Painting, KeysChangeTheBrushAndEscLeavesTheInk) {
  ASSERT_NO_FATAL_FAILURE(openInk());
  window_->action(ActionId::ToolPaint)->trigger();
  auto* canvas = find<CurveCanvas>("canvas");
  canvas->setFocus();
  const double before = window_->view().brushPx();
  QTest::keyClick(canvas, Qt::Key_BracketRight);
  EXPECT_GT(window_->view().brushPx(), before);
  for (int i = 0; i < 30; ++i) QTest::keyClick(canvas, Qt::Key_BracketLeft);
  EXPECT_EQ(window_->view().brushPx(), 2.0);
  const QPoint a = canvas->toWidget({200, 100}).toPoint();
  QTest::mousePress(canvas, Qt::LeftButton, {}, a);
  QTest::mouseMove(canvas, a + QPoint(60, 0));
  QTest::keyClick(canvas, Qt::Key_Escape);
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, a + QPoint(60, 0));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(painted().empty());
}

}  // namespace
}  // namespace batten
