// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes that meet are paired by clicks.
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QPushButton>
#include <QTest>

#include "tests/ui/window_fixture.h"
#include "ui/session/edits/junction_edits.h"
#include "ui/status_line.h"

namespace batten {
namespace {

class Junctions : public test::WindowFixture {
 protected:
  /// A stem that forks evenly at (300, 200), and two lines that cross at (450, 100).
  void open() {
    ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
      painter.drawLine(QPointF(60, 200), QPointF(300, 200));
      painter.drawLine(QPointF(300, 200), QPointF(560, 240));
      painter.drawLine(QPointF(300, 200), QPointF(560, 160));
      painter.drawLine(QPointF(100, 300), QPointF(300, 380));
      painter.drawLine(QPointF(100, 380), QPointF(300, 300));
    })));
    window_->setStage(PanelStage::Edges);
  }
  /// The junction nearest to a place, as it is now.
  const StrokeJunction& at(const Vec2& px) {
    const auto all = junctionsOf(session());
    const StrokeJunction* nearest = nullptr;
    for (const StrokeJunction& one : all)
      if (!nearest || (one.positionPx - px).norm() < (nearest->positionPx - px).norm()) nearest = &one;
    EXPECT_NE(nearest, nullptr);
    static const StrokeJunction none;
    return nearest ? *nearest : none;
  }
  void click(const Vec2& px) {
    clickCanvas(px);
    ASSERT_TRUE(settle());
  }
  std::size_t choices() { return session().recipe().edges.junctions.size(); }
  static constexpr double kForkX = 315.0;
};

TEST_F(Junctions, AClickOnADoubtfulOneTakesTheNextWayUntilItIsTheRuleAgain) {
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(window_->view().isVisible(Layer::Junctions));
  ASSERT_TRUE(at({kForkX, 200}).isDoubtful);
  EXPECT_EQ(doubtfulCount(*session().output().contours), 1);
  const auto pairings = at({kForkX, 200}).pairings;
  ASSERT_EQ(pairings.size(), 4u);
  const auto before = session().output().contours;
  for (std::size_t next = 1; next < pairings.size(); ++next) {
    click(at({kForkX, 200}).positionPx);
    EXPECT_EQ(choices(), 1u);
    EXPECT_EQ(at({kForkX, 200}).pairs, pairings[next]) << next;
    EXPECT_EQ(doubtfulCount(*session().output().contours), 0) << "the user has said";
  }
  EXPECT_EQ(session().curves().size(), 5u) << "the last next leaves all ends open";
  click(at({kForkX, 200}).positionPx);
  EXPECT_EQ(choices(), 0u);
  EXPECT_EQ(at({kForkX, 200}).pairs, pairings[0]);
  ASSERT_EQ(session().output().contours->contours.size(), before->contours.size());
  for (std::size_t i = 0; i < before->contours.size(); ++i)
    EXPECT_EQ(session().output().contours->contours[i].points, before->contours[i].points);
  for (int i = 0; i < 4; ++i) window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(choices(), 0u);
  window_->action(ActionId::Redo)->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(at({kForkX, 200}).pairs, pairings[1]);
}

TEST_F(Junctions, AnyOtherIsPairedWithTheToolAndByTwoBranches) {
  ASSERT_NO_FATAL_FAILURE(open());
  const Vec2 cross = at({200, 340}).positionPx;
  click(cross);
  EXPECT_EQ(choices(), 0u) << "without doubt it has no mark";
  QTest::mouseClick(find<QPushButton>("edges.pair"), Qt::LeftButton);
  EXPECT_EQ(window_->view().tool(), Tool::Junctions);
  click(cross);
  ASSERT_EQ(choices(), 1u);
  EXPECT_EQ(at(cross).pairs, at(cross).pairings[1]);
  window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(settle());

  // Nearer, so that the branches can be told from their junction.
  auto* canvas = find<CurveCanvas>("canvas");
  canvas->zoomActual();
  const StrokeJunction junction = at(cross);
  ASSERT_EQ(junction.pairings[0].size(), 2u);
  const auto [first, second] = junction.pairings[1][0];
  click(junction.branchesPx[first]);
  EXPECT_EQ(choices(), 0u);
  click(junction.branchesPx[second]);
  ASSERT_EQ(choices(), 1u);
  EXPECT_EQ(at(cross).pairs, EndPairs({junction.pairings[1][0]})) << "those that they went on with end here";
  click(junction.branchesPx[second]);
  click(junction.branchesPx[first]);
  EXPECT_TRUE(at(cross).pairs.empty()) << "two that are one come apart";
  auto* byRule = find<QPushButton>("edges.pairByRule");
  ASSERT_TRUE(byRule->isVisible());
  QTest::mouseClick(byRule, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(choices(), 0u);
  EXPECT_EQ(at(cross).pairs, junction.pairings[0]);
  EXPECT_FALSE(byRule->isVisible());
}

TEST_F(Junctions, AChoiceLivesOnWhenAThresholdMovesAndInTheFile) {
  ASSERT_NO_FATAL_FAILURE(open());
  click(at({kForkX, 200}).positionPx);
  const EndPairs asked = at({kForkX, 200}).pairs;
  Recipe moved = session().recipe();
  moved.threshold.strength = 1.3;
  session().change(QStringLiteral("Strength"), moved);
  ASSERT_TRUE(settle());
  EXPECT_EQ(at({kForkX, 200}).choice, 0);
  EXPECT_EQ(at({kForkX, 200}).pairs, asked);
}

TEST_F(Junctions, MarksAreShownInTheirStageUntilTheUserHidesThem) {
  ASSERT_NO_FATAL_FAILURE(open());
  const auto shot = [&] { return find<CurveCanvas>("canvas")->grab().toImage(); };
  const QImage with = shot();
  QTest::mouseClick(find<QCheckBox>("edges.showJunctions"), Qt::LeftButton);
  EXPECT_FALSE(window_->view().isVisible(Layer::Junctions));
  EXPECT_NE(shot(), with);
  click(at({kForkX, 200}).positionPx);
  EXPECT_EQ(choices(), 0u) << "what is hidden is not clicked";
  window_->setStage(PanelStage::Fairing);
  window_->action(ActionId::ToolJunctions)->trigger();
  EXPECT_EQ(window_->stage(), PanelStage::Edges);
}

}  // namespace
}  // namespace batten
