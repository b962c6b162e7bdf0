// SPDX-License-Identifier: GPL-3.0-or-later
// Which line is selected while nobody has selected one, and whose targets are shown.
#include <gtest/gtest.h>

#include <QTest>
#include <algorithm>

#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/plots/plot_series.h"

namespace batten {
namespace {

using test::waitUntil;

const QSize kPage(700, 500);

/// A long angle above a straight line that is longer than each of its sides.
QImage angleAndLinePage() {
  return test::drawnPage(kPage, [](QPainter& painter) {
    painter.drawPolyline(QPolygonF({{60, 300}, {340, 60}, {620, 300}}));
    painter.drawLine(QPointF(80, 440), QPointF(600, 450));
  });
}

/// A corner opens a ring, it does not divide it.
QImage twoRingsPage() {
  return test::drawnPage(kPage, [](QPainter& painter) {
    painter.drawEllipse(QRectF(40, 40, 400, 400));
    painter.drawEllipse(QRectF(500, 160, 160, 160));
  });
}

/// Three arcs below each other; the second is a little shorter than the first and its halves shorter than the third.
QImage threeArcsPage() {
  return test::drawnPage(kPage, [](QPainter& painter) {
    for (const QRectF& box : {QRectF(60, 60, 580, 60), QRectF(80, 200, 530, 60), QRectF(180, 340, 340, 60)}) {
      QPainterPath path(box.bottomLeft());
      path.quadTo(QPointF(box.center().x(), box.top() - 60), box.bottomRight());
      painter.drawPath(path);
    }
  });
}
const Vec2 kOnFirst(350, 60), kOnSecond(345, 200), kOnThird(350, 340);

class Selection : public test::WindowFixture {
 protected:
  void changeMarks(const Vec2& px) {
    Recipe recipe = session().recipe();
    recipe.cornerMarks.push_back({px});
    session().change(QStringLiteral("Mark corner"), recipe);
  }
  /// How far the selected line lies from a place [px].
  double selectedTo(const Vec2& px) {
    const TracedCurve* curve = session().selected();
    if (!curve || !session().output().pieces) return 1e9;
    double best = 1e9;
    for (const PiecePoint& p : session().output().pieces->pieces[curve->piece].points)
      best = std::min(best, (p.at - px).norm());
    return best;
  }
  void clickEyeOfSelected() {
    for (auto* list : window_->findChildren<CurveList*>()) {
      if (!list->isVisible()) continue;
      const QRect row = list->visualItemRect(list->item(session().selectedCurve().value()));
      return QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, QPoint(8, row.center().y()));
    }
    FAIL() << "no list is shown";
  }
};

TEST_F(Selection, MarkingACornerDoesNotSelectAnotherLine) {
  ASSERT_NO_FATAL_FAILURE(openPage(angleAndLinePage()));
  ASSERT_EQ(session().curves().size(), 2u);
  ASSERT_LT(selectedTo({200, 180}), 3.0) << "the angle is the longest line";
  changeMarks({340, 60});
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 3u);
  EXPECT_LT(std::min(selectedTo({200, 180}), selectedTo({480, 180})), 3.0) << "one side of it stays selected";
}

TEST_F(Selection, ALineThatIsLeftOutWhileItsCornerIsMarkedStaysSelected) {
  ASSERT_NO_FATAL_FAILURE(openPage(twoRingsPage()));
  window_->setStage(PanelStage::Curves);
  ASSERT_LT(selectedTo({240, 40}), 5.0) << "the large ring";
  changeMarks({240, 40});
  ASSERT_TRUE(session().isBusy());
  ASSERT_NO_FATAL_FAILURE(clickEyeOfSelected());
  ASSERT_TRUE(settle());
  ASSERT_FALSE(session().recipe().choices.empty());
  ASSERT_NE(session().selected(), nullptr);
  EXPECT_FALSE(session().selected()->included);
  EXPECT_LT(selectedTo({240, 40}), 5.0);
}

TEST_F(Selection, OpeningARecipeSelectsTheLongestLineAgain) {
  ASSERT_NO_FATAL_FAILURE(openPage(threeArcsPage()));
  window_->setStage(PanelStage::Curves);
  ASSERT_EQ(session().curves().size(), 3u);
  ASSERT_LT(selectedTo(kOnFirst), 12.0);
  // Without the first line, and with the second in two: the third is the longest.
  Recipe recipe = session().recipe();
  recipe.regions = {rectangleRegion({0, 140}, {700, 500})};
  recipe.cornerMarks = {{kOnSecond}};
  QFile file(folder_.filePath(QStringLiteral("other.recipe.json")));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(recipeToJson(recipe)));
  file.close();
  window_->openPath(file.fileName());
  ASSERT_TRUE(waitUntil([&] { return !session().recipe().regions.empty(); }));
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 3u);
  EXPECT_LT(selectedTo(kOnThird), 12.0);
  // Nobody has selected it yet.
  ASSERT_NO_FATAL_FAILURE(clickEyeOfSelected());
  ASSERT_TRUE(settle());
  ASSERT_NE(session().selected(), nullptr);
  EXPECT_LT(selectedTo(kOnSecond), 12.0);
}

TEST_F(Selection, TilesOfALineThatIsGoneAreNotShownForAnother) {
  ASSERT_NO_FATAL_FAILURE(openPage(angleAndLinePage()));
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
  const auto before = session().targets();
  bool wasShown = false;
  QObject::connect(&session(), &EditorSession::runFinished, window_.get(),
                   [&] { wasShown = wasShown || session().targets() == before; });
  changeMarks({340, 60});
  ASSERT_TRUE(settle());
  EXPECT_FALSE(wasShown);
  ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
}

TEST_F(Selection, TilesOfALineAreNotShownForOneOfAboutItsLength) {
  ASSERT_NO_FATAL_FAILURE(openPage(threeArcsPage()));
  window_->setStage(PanelStage::Fairing);
  ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
  const auto before = session().targets();
  const double length = session().selected()->sketchedFigures.lengthMm;
  bool wasShown = false;
  QObject::connect(&session(), &EditorSession::runFinished, window_.get(),
                   [&] { wasShown = wasShown || session().targets() == before; });
  ASSERT_NO_FATAL_FAILURE(clickEyeOfSelected());
  ASSERT_TRUE(settle());
  ASSERT_LT(selectedTo(kOnSecond), 12.0) << "the next longest is selected";
  ASSERT_GT(session().selected()->sketchedFigures.lengthMm, 0.85 * length);
  EXPECT_FALSE(wasShown);
  ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
  EXPECT_NE(session().targets(), before);
}

TEST_F(Selection, AListedCurveThatTurnsSharplyWarnsUntilItsCornersAreMarked) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  const auto* list = window_->findChild<CurveList*>(QStringLiteral("curves.list"));
  ASSERT_NE(list, nullptr);
  ASSERT_EQ(list->count(), 1);
  const QString tip = list->item(0)->toolTip();
  EXPECT_TRUE(tip.contains(QStringLiteral("sharply at 2 places"))) << tip.toStdString();
  EXPECT_TRUE(list->item(0)->data(Qt::AccessibleTextRole).toString().contains(tip.section(QLatin1Char('\n'), 0, 0)));
  changeMarks({200, 100});
  changeMarks({400, 300});
  ASSERT_TRUE(settle());
  ASSERT_EQ(list->count(), 3);
  for (int i = 0; i < list->count(); ++i)
    EXPECT_FALSE(list->item(i)->toolTip().contains(QStringLiteral("sharply"))) << i;
}

// A bend in a long line is less than a hundredth of its length, and so are the values next to its peak.
TEST_F(Selection, ThePlotHoldsTheMarksOfNarrowPeaks) {
  openPage(test::drawnPage({3200, 500}, [](QPainter& painter) {
    QPainterPath path(QPointF(40, 60));
    path.lineTo(1580, 60);
    path.quadTo(1600, 60, 1618.5, 67.6);
    path.lineTo(2500, 430);
    painter.drawPath(path);
  }));
  ASSERT_NE(session().selected(), nullptr);
  const PlotData data = plotData(session(), PlotTab::Curvature);
  ASSERT_FALSE(data.marks.empty()) << session().selected()->construct.note;
  for (const ExtremumMark& mark : data.marks) {
    EXPECT_GT(mark.kappa, data.low);
    EXPECT_LT(mark.kappa, data.high);
  }
}

}  // namespace
}  // namespace batten
