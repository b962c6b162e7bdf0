// SPDX-License-Identifier: GPL-3.0-or-later
// What the user chooses on the drawing: bumps to keep or take out, lines to leave out, regions to trace.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QLineEdit>
#include <QPixmap>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/curves/method_table.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/curves/extremum_marks.h"

namespace batten {
namespace {

using test::waitUntil;

/// An open stroke whose curvature rises, falls and rises again.
QImage wavePage() {
  return test::drawnPage({700, 420}, [](QPainter& painter) {
    painter.setPen(QPen(QColor(30, 30, 30), 5.0, Qt::SolidLine, Qt::FlatCap));
    QPolygonF line;
    for (int i = 0; i <= 600; ++i)
      line.append(QPointF(50.0 + i, 210.0 - 70.0 * std::sin(i / 600.0 * 3.0 * std::numbers::pi)));
    painter.drawPolyline(line);
  });
}

/// The same with the grain of a scan, so that its curvature is uncertain.
QImage grainyWavePage() {
  QImage page = wavePage();
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0.0, 12.0);
  for (int y = 0; y < page.height(); ++y)
    for (int x = 0; x < page.width(); ++x) {
      uchar& grey = page.scanLine(y)[x];
      grey = static_cast<uchar>(std::clamp(grey + grain(random), 0.0, 255.0));
    }
  return page;
}

/// Two strokes apart.
QImage twoLinesPage() {
  return test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.drawLine(QPointF(60, 100), QPointF(580, 120));
    painter.drawLine(QPointF(60, 300), QPointF(500, 310));
  });
}

class Choices : public test::WindowFixture {
 protected:
  void open(const QImage& page) {
    ASSERT_NO_FATAL_FAILURE(openPage(page));
    window_->setStage(PanelStage::Curves);
    canvas_ = find<CurveCanvas>("canvas");
    ASSERT_NE(canvas_, nullptr);
  }
  QPoint at(const Vec2& px) { return canvas_->toWidget(px).toPoint(); }
  void click(const Vec2& px) { clickCanvas(px); }
  void drag(const std::vector<Vec2>& way) {
    QTest::mousePress(canvas_, Qt::LeftButton, Qt::NoModifier, at(way.front()));
    for (const Vec2& px : way) QTest::mouseMove(canvas_, at(px));
    QTest::mouseRelease(canvas_, Qt::LeftButton, Qt::NoModifier, at(way.back()));
  }
  const ExtremumMark* kept(const std::vector<ExtremumMark>& marks) {
    for (const ExtremumMark& mark : marks)
      if (mark.isKept && mark.isCertain) return &mark;
    return nullptr;
  }

  CurveCanvas* canvas_ = nullptr;
};

TEST_F(Choices, AClickOnAnExtremumTakesItOutAndAnotherBringsItBack) {
  open(wavePage());
  const auto marks = extremumMarks(session(), session().selectedCurve());
  const ExtremumMark* mark = kept(marks);
  ASSERT_NE(mark, nullptr);
  const Vec2 place = mark->px;
  ASSERT_TRUE(mark->note);
  // The mark lies on the curve that is shown; what is kept in the recipe is where the extremum was judged.
  const Vec2 judged = session().output().frame.pointToImage(session().selected()->construct.extrema[*mark->note].point);
  EXPECT_TRUE(mark->text.contains(QStringLiteral("certain")));
  click(place);
  ASSERT_EQ(session().recipe().extremumChoices.size(), 1u);
  EXPECT_FALSE(session().recipe().extremumChoices[0].keep);
  EXPECT_LT((session().recipe().extremumChoices[0].positionPx - judged).norm(), 1e-9);
  ASSERT_TRUE(settle());
  const auto after = extremumMarks(session(), session().selectedCurve());
  const auto gone =
      std::find_if(after.begin(), after.end(), [](const ExtremumMark& m) { return m.wantedToKeep.has_value(); });
  ASSERT_NE(gone, after.end());
  EXPECT_FALSE(gone->isKept);
  EXPECT_FALSE(*gone->wantedToKeep);
  click(gone->px);
  EXPECT_TRUE(session().recipe().extremumChoices.empty()) << "the program decides again";
  ASSERT_TRUE(settle());
  window_->action(ActionId::Undo)->trigger();
  EXPECT_EQ(session().recipe().extremumChoices.size(), 1u);
  window_->action(ActionId::Undo)->trigger();
  EXPECT_TRUE(session().recipe().extremumChoices.empty());
}

TEST_F(Choices, TheMethodTableFollowsWhatIsTakenOut) {
  open(wavePage());
  auto* table = find<MethodTable>("construct.method.row");
  const auto shown = [&] { return table->figures(ConstructMethod::Fair); };
  ASSERT_TRUE(waitUntil([&] { return shown().has_value(); }));
  const auto marks = extremumMarks(session(), session().selectedCurve());
  ASSERT_NE(kept(marks), nullptr);
  const double before = shown()->fromPoints.rms;
  click(kept(marks)->px);
  ASSERT_TRUE(settle());
  const double now = session().selected()->sketchedFigures.fromPoints.rms;
  ASSERT_GT(now, before) << "the line is followed less closely without its bump";
  EXPECT_TRUE(waitUntil([&] { return shown() && shown()->fromPoints.rms == now; }, 20000));
}

TEST_F(Choices, HiddenMarksCannotBeClicked) {
  open(wavePage());
  const auto marks = extremumMarks(session(), session().selectedCurve());
  ASSERT_NE(kept(marks), nullptr);
  window_->action(ActionId::ShowExtrema)->trigger();
  EXPECT_FALSE(window_->view().isVisible(Layer::Extrema));
  click(kept(marks)->px);
  EXPECT_TRUE(session().recipe().extremumChoices.empty());
}

TEST_F(Choices, TheCurvaturePlotTakesTheSameClicks) {
  open(wavePage());
  auto* plots = window_->findChild<CurvePlots*>(QStringLiteral("plots"));
  ASSERT_NE(plots, nullptr);
  plots->setTab(PlotTab::Curvature);
  QCoreApplication::processEvents();
  const auto marks = extremumMarks(session(), session().selectedCurve());
  ASSERT_NE(kept(marks), nullptr);
  auto* plot = plots->findChild<QWidget*>(QStringLiteral("plot"));
  const QPoint place = plots->markPlace(*kept(marks)->note).toPoint();
  ASSERT_TRUE(plot->rect().contains(place));
  QTest::mouseMove(plot, place);
  // With a window system the mouse arrives when the event does.
  EXPECT_TRUE(test::waitUntil([&] { return plot->toolTip().contains(QStringLiteral("certain")); }, 5000));
  QTest::mouseClick(plot, Qt::LeftButton, Qt::NoModifier, place);
  ASSERT_EQ(session().recipe().extremumChoices.size(), 1u);
  EXPECT_FALSE(session().recipe().extremumChoices[0].keep);
}

TEST_F(Choices, AClickLeavesALineOutAndTakesItInAgain) {
  open(twoLinesPage());
  ASSERT_EQ(session().curves().size(), 2u);
  window_->action(ActionId::ToolLines)->trigger();
  click({300, 109});
  ASSERT_TRUE(settle());
  EXPECT_FALSE(session().curves()[0].included);
  EXPECT_TRUE(session().curves()[1].included);
  // The choice belongs to the line, wherever the thresholds put it, and outlives its absence.
  Recipe moved = session().recipe();
  moved.contours.minLengthPx = 500.0;
  session().change(QStringLiteral("shortest line"), moved);
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 1u);
  EXPECT_FALSE(session().curves()[0].included);
  moved.contours.minLengthPx = 450.0;
  session().change(QStringLiteral("shortest line"), moved);
  moved.contours.minLengthPx = 40.0;
  session().change(QStringLiteral("shortest line"), moved);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(session().curves()[0].included);
  click({300, 109});
  ASSERT_TRUE(settle());
  EXPECT_TRUE(session().curves()[0].included);
}

TEST_F(Choices, TheSelectedLineIsFollowedInAWayOfItsOwn) {
  open(twoLinesPage());
  window_->setStage(PanelStage::Edges);
  auto* outline = find<QAbstractButton>("edges.way.outline");
  auto* page = find<QAbstractButton>("edges.way.page");
  click({300, 109});
  ASSERT_TRUE(outline->isVisible());
  EXPECT_TRUE(page->isChecked());
  const auto kinds = [&] {
    std::vector<ContourKind> all;
    for (const Contour& c : session().output().contours->contours) all.push_back(c.kind);
    std::sort(all.begin(), all.end());
    return all;
  };
  QTest::mouseClick(outline, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(kinds(), (std::vector{ContourKind::Outline, ContourKind::Centreline}));
  EXPECT_TRUE(outline->isChecked()) << "the line stays selected";
  // The choice outlives its line.
  Recipe moved = session().recipe();
  moved.contours.minLengthPx = 3000.0;
  session().change(QStringLiteral("shortest line"), moved);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(outline->isVisible());
  moved.contours.minLengthPx = 40.0;
  session().change(QStringLiteral("shortest line"), moved);
  ASSERT_TRUE(settle());
  EXPECT_EQ(kinds(), (std::vector{ContourKind::Outline, ContourKind::Centreline}));
  click({300, 107});
  ASSERT_TRUE(page->isVisible());
  QTest::mouseClick(page, Qt::LeftButton);
  EXPECT_TRUE(session().recipe().edges.choices.empty());
  ASSERT_TRUE(settle());
  EXPECT_EQ(kinds(), (std::vector{ContourKind::Centreline, ContourKind::Centreline}));
  window_->action(ActionId::Undo)->trigger();
  EXPECT_EQ(session().recipe().edges.choices.size(), 1u);
}

TEST_F(Choices, ARectangleAndALassoTraceWhatLiesInside) {
  open(twoLinesPage());
  window_->action(ActionId::ToolRectangle)->trigger();
  drag({{30, 60}, {200, 100}, {320, 160}});
  ASSERT_EQ(session().recipe().regions.size(), 1u);
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 1u);
  ASSERT_TRUE(session().output().contours);
  for (const ContourPoint& p : session().output().contours->contours[0].points) EXPECT_LT(p.at.x(), 321.5);
  EXPECT_TRUE(window_->action(ActionId::ClearRegions)->isEnabled());

  window_->action(ActionId::ToolLasso)->trigger();
  drag({{40, 260}, {300, 250}, {520, 280}, {520, 340}, {300, 350}, {40, 345}});
  ASSERT_EQ(session().recipe().regions.size(), 2u);
  EXPECT_GE(session().recipe().regions[1].cornersPx.size(), 5u);
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().curves().size(), 2u);

  drag({{400, 20}, {401, 21}});  // hardly a drag: nothing
  EXPECT_EQ(session().recipe().regions.size(), 2u);
  window_->action(ActionId::ClearRegions)->trigger();
  EXPECT_TRUE(session().recipe().regions.empty());
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().curves().size(), 2u);
  EXPECT_FALSE(window_->action(ActionId::ClearRegions)->isEnabled());
  window_->action(ActionId::Undo)->trigger();
  EXPECT_EQ(session().recipe().regions.size(), 2u);
}

TEST_F(Choices, MergedStrokesShowTheirRoomWhileEdgesAreWorkedOn) {
  open(twoLinesPage());
  const auto shows = [&] { return window_->view().isVisible(Layer::Strokes); };
  const auto merge = [&](double widths) {
    Recipe recipe = session().recipe();
    recipe.edges.mergeWidths = widths;
    session().change(QStringLiteral("Merge strokes"), recipe);
  };
  window_->setStage(PanelStage::Edges);
  EXPECT_FALSE(shows());
  merge(4.0);
  EXPECT_TRUE(shows());
  window_->setStage(PanelStage::Curves);
  EXPECT_FALSE(shows());
  window_->setStage(PanelStage::Edges);
  EXPECT_TRUE(shows());
  merge(0.0);
  EXPECT_FALSE(shows());
  merge(4.0);
  window_->action(ActionId::ShowStrokes)->trigger();  // the user's own choice stays
  EXPECT_FALSE(shows());
  merge(5.0);
  EXPECT_FALSE(shows());
}

TEST_F(Choices, ThresholdsShowTheInkBeforeTheCleanUpAndTheCleanUpWhatItLeaves) {
  open(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.fillRect(60, 100, 500, 2, QColor(30, 30, 30));
    painter.fillRect(60, 200, 500, 9, QColor(30, 30, 30));
  }));
  // Whether the mask's colour lies on a place of the picture; ink itself is grey.
  const auto isInk = [this](const Vec2& px) {
    const QPixmap shot = canvas_->grab();
    const QColor colour = shot.toImage().pixelColor((canvas_->toWidget(px) * shot.devicePixelRatio()).toPoint());
    return colour.saturation() > 60;
  };
  window_->setStage(PanelStage::CleanUp);
  EXPECT_TRUE(waitUntil([&] { return isInk({300, 204.5}) && isInk({300, 101}); })) << "thin strokes are spared";
  type(find<QLineEdit>("filter.max_change.field"), QStringLiteral("0"));
  EXPECT_TRUE(waitUntil([&] { return isInk({300, 204.5}) && !isInk({300, 101}); })) << "as in the paper";
  window_->setStage(PanelStage::Threshold);
  EXPECT_TRUE(waitUntil([&] { return isInk({300, 204.5}) && isInk({300, 101}); }));
}

TEST_F(Choices, EveryNewLayerPaintsWithoutChangingTheRecipe) {
  open(grainyWavePage());
  const Recipe before = session().recipe();
  canvas_->setFocus();
  for (const ActionId id : {ActionId::ShowStrokes, ActionId::ShowNoise, ActionId::ShowExtrema}) {
    // What a layer shows may still be made in the background.
    const auto changesThePicture = [&] {
      const QImage one = canvas_->grab().toImage();
      window_->action(id)->trigger();
      if (canvas_->grab().toImage() != one) return true;
      window_->action(id)->trigger();
      return false;
    };
    EXPECT_TRUE(waitUntil(changesThePicture)) << window_->action(id)->objectName().toStdString();
  }
  EXPECT_EQ(session().recipe(), before);
}

}  // namespace
}  // namespace batten
