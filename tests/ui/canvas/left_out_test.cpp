// SPDX-License-Identifier: GPL-3.0-or-later
// Whose choice is whose: lines that run close together, break up, go and come back.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QTest>

#include "core/pipeline/run/piece_choices.h"
#include "tests/ui/window_fixture.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/status_line.h"

namespace batten {
namespace {

class LeftOut : public test::WindowFixture {
 protected:
  /// Three strokes of which the upper two run 12 px apart.
  void open() {
    ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
      painter.setPen(QPen(QColor(30, 30, 30), 4.0, Qt::SolidLine, Qt::FlatCap));
      painter.drawLine(QPointF(60, 100), QPointF(580, 100));
      painter.drawLine(QPointF(60, 112), QPointF(560, 112));
      painter.drawLine(QPointF(60, 300), QPointF(500, 310));
    })));
    window_->setStage(PanelStage::Curves);
    ASSERT_EQ(session().curves().size(), 3u);
    window_->action(ActionId::ToolLines)->trigger();
  }
  void click(const Vec2& px) {
    clickCanvas(px);
    ASSERT_TRUE(settle());
  }
  /// Whether the curve nearest to a height on the page counts.
  bool isIncluded(double y) {
    bool included = false;
    double nearest = 1e9;
    for (const TracedCurve& curve : session().curves()) {
      const double away = std::abs(anchorOf(session().output().pieces->pieces[curve.piece]).y() - y);
      if (away < nearest) nearest = away, included = curve.included;
    }
    return included;
  }
  void change(const std::function<void(Recipe&)>& edit) {
    Recipe recipe = session().recipe();
    edit(recipe);
    session().change(QStringLiteral("change"), recipe);
    ASSERT_TRUE(settle());
  }
};

TEST_F(LeftOut, OfTwoLinesCloseTogetherTheOneThatIsClicked) {
  ASSERT_NO_FATAL_FAILURE(open());
  click({300, 99});
  EXPECT_FALSE(isIncluded(100));
  EXPECT_TRUE(isIncluded(112));
  click({300, 113});
  EXPECT_FALSE(isIncluded(100));
  EXPECT_FALSE(isIncluded(112)) << "both are out";
  click({300, 99});
  EXPECT_TRUE(isIncluded(100));
  EXPECT_FALSE(isIncluded(112));
  for (int curve = 0; curve < 3; ++curve) {
    const PieceChoice* choice = choiceOf(session(), curve);
    EXPECT_EQ(session().curves()[curve].included, !choice || choice->included) << curve;
  }
}

TEST_F(LeftOut, AChoiceWithoutItsLineIsToldOfAndCanBeForgotten) {
  ASSERT_NO_FATAL_FAILURE(open());
  auto* waiting = find<QLabel>("curves.waiting");
  EXPECT_FALSE(waiting->isVisible());
  click({300, 306});
  ASSERT_FALSE(isIncluded(305));
  EXPECT_FALSE(waiting->isVisible());
  change([](Recipe& recipe) { recipe.contours.minLengthPx = 480.0; });
  ASSERT_EQ(session().curves().size(), 2u);
  EXPECT_TRUE(waiting->isVisible());
  EXPECT_TRUE(waiting->text().contains(QStringLiteral("1 choice"))) << waiting->text().toStdString();
  change([](Recipe& recipe) { recipe.contours.minLengthPx = 40.0; });
  EXPECT_FALSE(waiting->isVisible());
  EXPECT_FALSE(isIncluded(305)) << "nothing was lost";
  change([](Recipe& recipe) { recipe.contours.minLengthPx = 480.0; });
  QTest::mouseClick(find<QAbstractButton>("curves.forgetWaiting"), Qt::LeftButton);
  EXPECT_TRUE(session().recipe().choices.empty());
  ASSERT_TRUE(settle());
  EXPECT_FALSE(waiting->isVisible());
}

TEST_F(LeftOut, APartOfALineThatWasCutIsChosenAlone) {
  ASSERT_NO_FATAL_FAILURE(open());
  click({300, 306});
  change([](Recipe& recipe) { recipe.cornerMarks = {{Vec2(200, 303)}}; });
  ASSERT_EQ(session().curves().size(), 4u);
  const auto out = [&] {
    return std::count_if(session().curves().begin(), session().curves().end(),
                         [](const TracedCurve& curve) { return !curve.included; });
  };
  EXPECT_EQ(out(), 2) << "both parts share the choice";
  click({100, 302});
  EXPECT_EQ(out(), 1);
  change([](Recipe& recipe) { recipe.cornerMarks.clear(); });
  EXPECT_EQ(out(), 1) << "whole again, the line is out as before";
}

TEST_F(LeftOut, BridgesAreShownWhereThereAreAnyUntilTheUserHidesThem) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.setPen(QPen(QColor(30, 30, 30), 5.0, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(QPointF(60, 100), QPointF(300, 100));
    painter.drawLine(QPointF(312, 100), QPointF(580, 100));
  })));
  ASSERT_EQ(bridgeCount(*session().output().contours), 1);
  const auto shows = [&] { return window_->view().isVisible(Layer::Strokes); };
  EXPECT_FALSE(shows());
  window_->setStage(PanelStage::Edges);
  EXPECT_TRUE(shows());
  change([](Recipe& recipe) { recipe.edges.gapFactor = 0.0; });
  EXPECT_FALSE(shows()) << "none is left";
  change([](Recipe& recipe) { recipe.edges.gapFactor = 4.0; });
  EXPECT_TRUE(shows());
  window_->action(ActionId::ShowStrokes)->trigger();
  window_->setStage(PanelStage::Curves);
  window_->setStage(PanelStage::Edges);
  EXPECT_FALSE(shows()) << "the user's own choice stays";
}

TEST_F(LeftOut, TheHintOfTheFirstStageIsOneForAnOpenDrawing) {
  auto* status = window_->findChild<StatusLine*>();
  ASSERT_NE(status, nullptr);
  const auto says = [&](const char* text) {
    const auto labels = status->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](const QLabel* label) { return label->text().contains(QLatin1String(text)); });
  };
  EXPECT_TRUE(says("Drop a drawing"));
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  EXPECT_FALSE(says("Drop a drawing"));
  EXPECT_TRUE(says("resolution"));
}

}  // namespace
}  // namespace batten
