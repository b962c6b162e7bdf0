// SPDX-License-Identifier: GPL-3.0-or-later
// What a curve is judged by: its comb, its marks, its plot, and whether it is the sketched or the faired one.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "tests/ui/window_fixture.h"
#include "ui/canvas/layers/chip_layer.h"
#include "ui/canvas/scene/compare_overlay.h"
#include "ui/panels/stages/curves/pin_panel.h"
#include "ui/panels/stages/fairing_figures.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/curves/extremum_marks.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/view/judged_view.h"

namespace batten {
namespace {

using test::waitUntil;

class Judging : public test::WindowFixture {
 protected:
  void click(const char* name) { QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton); }
  /// Fairs everything as even as a tolerance allows.
  void fairWithin(const char* mm) {
    window_->setStage(PanelStage::Fairing);
    click("fairing.mode.tolerance");
    click("fairing.spend.all");
    type(find<QLineEdit>("fairing.tolerance.field"), QString::fromLatin1(mm));
    ASSERT_TRUE(settle());
  }
  /// What the canvas shows once all that is computed behind it has come.
  QImage canvasImage() {
    auto* canvas = find<CurveCanvas>("canvas");
    QImage last;
    EXPECT_TRUE(waitUntil([&] {
      QTest::qWait(60);  // between two pictures that are compared: longer than the canvas takes to paint again
      const QImage now = canvas->grab().toImage();
      const bool isSame = now == last;
      last = now;
      return isSame && !session().isWorking();
    }));
    return last;
  }
  /// The palest colour near a place of the page.
  int palest(const QImage& canvas, const Vec2& px, int reach) {
    const QPoint at = find<CurveCanvas>("canvas")->toWidget(px).toPoint();
    int most = 0;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const QColor color = canvas.pixelColor(at + QPoint(x, y));
        most = std::max(most, std::min({color.red(), color.green(), color.blue()}));
      }
    return most;
  }
  /// The bluest colour near a place of the page: blue minus red.
  int bluest(const QImage& canvas, const Vec2& px, int reach = 4) {
    const QPoint at = find<CurveCanvas>("canvas")->toWidget(px).toPoint();
    int most = -255;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const QColor color = canvas.pixelColor(at + QPoint(x, y));
        most = std::max(most, color.blue() - color.red());
      }
    return most;
  }
};

/// A wave with ripples that fairing takes out.
QImage ripplePage() {
  return test::drawnPage({700, 420}, [](QPainter& painter) {
    QPolygonF line;
    for (int i = 0; i <= 600; ++i)
      line.append(QPointF(50.0 + i, 260.0 - 120.0 * std::sin(i / 600.0 * std::numbers::pi) + 2.5 * std::sin(i / 25.0)));
    painter.drawPolyline(line);
  });
}

QImage lineAndRipplesPage() {
  QImage page = ripplePage();
  QPainter painter(&page);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(30, 30, 30), 5.0, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(QPointF(60, 360), QPointF(640, 372));
  return page;
}

TEST_F(Judging, TheFiguresOfFairingStandBelowTheNameOfTheirCurve) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::mixedPage()));
  window_->setStage(PanelStage::Fairing);
  click("fairing.scope.all");
  ASSERT_GT(std::ssize(session().curves()), 1);
  for (const int curve : {0, 1}) {
    session().selectCurve(curve);
    QCoreApplication::processEvents();
    EXPECT_EQ(find<QWidget>("fairing.figures")->accessibleName(), curveName(session(), curve));
  }
}

TEST_F(Judging, InCurvesTheCombIsThatOfTheConstructedCurve) {
  ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
  window_->setStage(PanelStage::Curves);
  const QImage before = canvasImage();
  ASSERT_NO_FATAL_FAILURE(fairWithin("2"));
  ASSERT_LT(session().selected()->fairedFigures.extrema, session().selected()->sketchedFigures.extrema);
  const QImage faired = canvasImage();
  window_->setStage(PanelStage::Curves);
  EXPECT_EQ(canvasImage(), before) << "whatever fairing makes of it later";
  EXPECT_NE(faired, before);
  const PlotData sketch = plotData(session(), PlotTab::Curvature, judgedIn(window_->view()));
  EXPECT_TRUE(std::none_of(sketch.series.begin(), sketch.series.end(),
                           [](const PlotSeries& one) { return one.role == PlotRole::Faired; }));
}

TEST_F(Judging, MethodsAreComparedByTheCurvesThatTheyConstruct) {
  ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
  window_->setStage(PanelStage::Curves);
  click("pin.set");
  ASSERT_NO_FATAL_FAILURE(fairWithin("2"));
  window_->setStage(PanelStage::Curves);
  ASSERT_NE(session().pinnedOf(session().selectedCurve()), nullptr);
  const TracedCurve &before = *session().pinnedOf(session().selectedCurve()), &now = *session().selected();
  ASSERT_NE(now.fairedFigures.extrema, now.sketchedFigures.extrema);
  const Comparison c = compare(before, now);
  EXPECT_EQ(overlaySource(session(), window_->view(), 1.0).judged, Judged::Sketched) << "drawn over them, too";
  EXPECT_LT(c.apartMm, 1e-9) << "the fairing alone has changed";
  EXPECT_EQ(c.now.extrema, before.sketchedFigures.extrema);
  EXPECT_EQ(c.now.energy, c.pinned.energy);
  auto* list = find<QWidget>("panel.curves")->findChild<QListWidget*>(QStringLiteral("curves.list"));
  ASSERT_NE(list, nullptr);
  const QString spoken = list->item(*session().selectedCurve())->data(Qt::AccessibleTextRole).toString();
  EXPECT_TRUE(spoken.contains(QStringLiteral("%1 extr.").arg(now.sketchedFigures.extrema))) << spoken.toStdString();
}

TEST_F(Judging, ASelectedCurveShowsWhichWayItRuns) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage(
      {640, 400}, [](QPainter& painter) { painter.drawArc(QRectF(60, 80, 520, 600), 30 * 16, 120 * 16); })));
  window_->setStage(PanelStage::Curves);
  window_->view().setVisible(Layer::Comb, true);
  const QImage shown = canvasImage();
  const NurbsCurve& curve = session().selected()->sketched;
  const ArcLength arc(curve);
  const auto* canvas = find<CurveCanvas>("canvas");
  const PageFrame& frame = session().output().frame;
  const QPointF apart = canvas->toWidget({100, 0}) - canvas->toWidget({0, 0});
  const double mmPerWidgetPx = frame.lengthToModel(100.0 / apart.x());
  // The border of the arrow is white, the paper of the page a little darker.
  const auto whiteAround = [&](double s) {
    constexpr int kReach = 7;
    const QPoint at = canvas->toWidget(frame.pointToImage(curve.point(arc.parameter(s)))).toPoint();
    int found = 0;
    for (int y = -kReach; y <= kReach; ++y)
      for (int x = -kReach; x <= kReach; ++x) {
        const QColor color = shown.pixelColor(at + QPoint(x, y));
        found += std::min({color.red(), color.green(), color.blue()}) > 250 ? 1 : 0;
      }
    return found;
  };
  constexpr double kBehindStartPx = 17.0;  // in the middle of the arrow
  EXPECT_GT(whiteAround(kBehindStartPx * mmPerWidgetPx), 8);
  EXPECT_EQ(whiteAround(arc.total() - kBehindStartPx * mmPerWidgetPx), 0);
}

TEST_F(Judging, TheMarksOnAFairedCurveAreItsOwn) {
  ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
  const auto sketched = extremumMarks(session(), session().selectedCurve());
  ASSERT_GT(sketched.size(), 4u);
  ASSERT_NO_FATAL_FAILURE(fairWithin("2"));
  const TracedCurve& curve = *session().selected();
  const auto marks = extremumMarks(session(), session().selectedCurve(), Judged::Result);
  EXPECT_EQ(std::ssize(marks), curve.fairedFigures.extrema);
  for (const ExtremumMark& mark : marks) {
    const auto hit = closestPoint(curve.faired, session().output().frame.pointToModel(mark.px));
    EXPECT_LT(hit.distance, 1e-6);
    const double step = 1e-3 * (curve.faired.end() - curve.faired.start());
    const auto before = curvatureSlope(curve.faired, hit.u - step), after = curvatureSlope(curve.faired, hit.u + step);
    ASSERT_TRUE(before && after);
    EXPECT_LT(*before * *after, 0.0) << "the curvature turns back there";
  }
  const PlotData data = plotData(session(), PlotTab::Curvature);
  EXPECT_EQ(data.marks.size(), marks.size());
  // There is nothing to take out of a faired curve: a click where the sketch has a mark changes nothing here.
  ASSERT_TRUE(session().recipe().extremumChoices.empty());
  for (const ExtremumMark& mark : sketched) clickCanvas(mark.px);
  EXPECT_TRUE(session().recipe().extremumChoices.empty());
  window_->setStage(PanelStage::Curves);
  clickCanvas(sketched.front().px);
  EXPECT_EQ(session().recipe().extremumChoices.size(), 1u);
}

TEST_F(Judging, ACurveThatFairingLeavesIsShownAsAResultAndExplained) {
  ASSERT_NO_FATAL_FAILURE(openPage(lineAndRipplesPage()));
  ASSERT_EQ(session().curves().size(), 2u);
  ASSERT_NO_FATAL_FAILURE(fairWithin("2"));
  const int line = session().curves()[0].construct.isLine ? 0 : 1;
  ASSERT_TRUE(session().curves()[line].construct.isLine);
  session().selectCurve(line);
  EXPECT_TRUE(curveText(CanvasScene(session(), window_->view())).contains(QStringLiteral("unchanged by fairing")));
  session().selectCurve(1 - line);
  const QListWidget* list = nullptr;
  for (auto* one : window_->findChildren<QListWidget*>(QStringLiteral("curves.list")))
    if (one->isVisible()) list = one;
  ASSERT_NE(list, nullptr);
  const QString spoken = list->item(line)->data(Qt::AccessibleTextRole).toString();
  EXPECT_TRUE(spoken.contains(QStringLiteral("unchanged"))) << spoken.toStdString();
  const CurveFigures& still = session().curves()[line].fairedFigures;
  EXPECT_TRUE(spoken.contains(QStringLiteral("%1 extr. · %2 pts").arg(still.extrema).arg(still.controlPoints)))
      << "its figures are told all the same: " << spoken.toStdString();
  EXPECT_TRUE(list->item(line)->toolTip().contains(QStringLiteral("exact line")));
  EXPECT_TRUE(fairingNote(session().curves()[line]).text.contains(QStringLiteral("exact line")));
  EXPECT_FALSE(list->item(1 - line)->toolTip().contains(QStringLiteral("unchanged by")));
  for (const PanelStage stage : {PanelStage::Fairing, PanelStage::Export}) {
    window_->setStage(stage);
    EXPECT_GT(bluest(canvasImage(), {350, 366}), 60) << label(stage).toStdString();
  }
}

TEST_F(Judging, FoundLinesAreSeenOnBlackInk) {
  constexpr int kPalerThanGrey = 95;  // the grey of a sketched line is 88
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.setPen(QPen(Qt::black, 16.0, Qt::SolidLine, Qt::FlatCap));
    painter.drawArc(QRectF(80, 60, 480, 240), 20 * 16, 140 * 16);
    painter.drawArc(QRectF(80, 160, 480, 240), 20 * 16, 140 * 16);
  })));
  ASSERT_EQ(session().curves().size(), 2u);
  for (const auto& [stage, areSketchedShown] :
       {std::pair(PanelStage::Edges, true), std::pair(PanelStage::Corners, true), std::pair(PanelStage::Curves, true),
        std::pair(PanelStage::Fairing, true), std::pair(PanelStage::Fairing, false),
        std::pair(PanelStage::Export, true)}) {
    window_->setStage(stage);
    window_->view().setVisible(Layer::Curve, areSketchedShown);
    for (int selected = 0; selected < 2; ++selected) {
      session().selectCurve(selected);
      const QImage shown = canvasImage();
      for (const TracedCurve& curve : session().curves()) {
        const NurbsCurve& line = curve.sketched;
        const Vec2 px = session().output().frame.pointToImage(line.point(0.5 * (line.start() + line.end())));
        EXPECT_GT(bluest(shown, px, 2), 60) << label(stage).toStdString();
        EXPECT_GT(palest(shown, px, 3), kPalerThanGrey)
            << "a border keeps it apart from the ink: " << label(stage).toStdString();
      }
    }
  }
}

TEST_F(Judging, ThePlotRunsAsTheCurveLiesAndCanBeTurned) {
  for (const bool isLeftToRight : {true, false}) {
    ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
    window_->setStage(PanelStage::Fairing);
    // The pen's lines run as they were drawn.
    window_->action(ActionId::ToolPen)->trigger();
    auto* canvas = find<CurveCanvas>("canvas");
    const auto at = [&](double t) {
      const double x = isLeftToRight ? 100.0 + 400.0 * t : 500.0 - 400.0 * t;
      return canvas->toWidget({x, 380.0 - 30.0 * std::sin(3.0 * t)}).toPoint();
    };
    QTest::mousePress(canvas, Qt::LeftButton, {}, at(0));
    for (int i = 1; i <= 40; ++i) QTest::mouseMove(canvas, at(i / 40.0));
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, at(1));
    ASSERT_TRUE(settle());
    ASSERT_NE(session().selected(), nullptr);
    window_->setStage(PanelStage::Fairing);
    const auto* plots = window_->findChild<CurvePlots*>();
    EXPECT_TRUE(waitUntil([&] { return plots->runsLeft() != isLeftToRight; }, 5000));
    click("plot.reverse");
    EXPECT_EQ(plots->runsLeft(), isLeftToRight);
    click("plot.reverse");
    EXPECT_EQ(plots->runsLeft(), !isLeftToRight);
  }
}

TEST_F(Judging, ARadiusTooLargeToShowLeavesThePlot) {
  ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
  for (const bool isLinear : {false, true}) {
    const PlotData data = plotData(session(), PlotTab::Radius, Judged::Sketched, isLinear);
    ASSERT_EQ(data.series.front().role, PlotRole::Sketched);
    const auto& points = data.series.front().points;
    const auto above = std::ranges::count_if(points, [&](const PlotPoint& p) { return p.value > data.high; });
    EXPECT_GT(above, 0) << "the ripple has inflections, where the radius is infinite";
    EXPECT_LT(above, std::ssize(points) / 2);
    for (std::size_t i = 1; i < points.size(); ++i)
      EXPECT_FALSE(points[i].value <= data.high && points[i].value == points[i - 1].value)
          << "a flat line that looks like an arc at " << points[i].s;
    const PlotData curvatures = plotData(session(), PlotTab::Curvature, Judged::Sketched);
    const auto& kappa = curvatures.series.front().points;
    for (std::size_t i = 1; i < kappa.size(); ++i) {
      if (kappa[i].value * kappa[i - 1].value >= 0.0) continue;
      EXPECT_TRUE(std::ranges::any_of(
          points,
          [&](const PlotPoint& p) { return p.s >= kappa[i - 1].s && p.s <= kappa[i].s && p.value > data.high; }))
          << "an inflection that looks like an arc at " << kappa[i].s;
    }
  }
}

TEST_F(Judging, ThePlotOfTheSlopeIsTheDerivativeOfTheCurvature) {
  ASSERT_NO_FATAL_FAILURE(openPage(ripplePage()));
  window_->setStage(PanelStage::Curves);
  click("plot.slope");
  EXPECT_TRUE(find<QLabel>("plot.quantity")->text().contains(QStringLiteral("dκ/ds")));
  const auto seriesOf = [this](PlotTab tab) {
    const PlotData data = plotData(session(), tab, Judged::Sketched);
    for (const PlotSeries& series : data.series)
      if (series.role == PlotRole::Sketched) return series;
    return PlotSeries{};
  };
  const PlotSeries kappa = seriesOf(PlotTab::Curvature), slope = seriesOf(PlotTab::CurvatureSlope);
  ASSERT_EQ(kappa.points.size(), slope.points.size());
  double largest = 0.0;
  for (const PlotPoint& point : slope.points) largest = std::max(largest, std::abs(point.value));
  ASSERT_GT(largest, 0.0);
  // Between two samples the curvature rises by the integral of its slope (trapezoids).
  double rise = 0.0;
  for (std::size_t i = 1; i < slope.points.size(); ++i) {
    const PlotPoint &before = slope.points[i - 1], &now = slope.points[i];
    rise += 0.5 * (now.value + before.value) * (now.s - before.s);
    EXPECT_NEAR(rise, kappa.points[i].value - kappa.points[0].value, 0.02 * largest * slope.points.back().s) << i;
  }
  click("plot.speed");
  EXPECT_TRUE(find<QLabel>("plot.quantity")->text().contains(QStringLiteral("|R′(u)|")));
  const PlotData speed = plotData(session(), PlotTab::Speed, Judged::Sketched);
  EXPECT_GE(speed.high - speed.low, 0.1 * std::abs(0.5 * (speed.high + speed.low)) * (1 - 1e-9))
      << "even looks even, not like its last digits";
}

TEST_F(Judging, ASpeedThatIsEvenLooksEven) {
  ASSERT_NO_FATAL_FAILURE(openPage(
      test::drawnPage({640, 400}, [](QPainter& painter) { painter.drawLine(QPointF(60, 200), QPointF(580, 214)); })));
  const PlotData speed = plotData(session(), PlotTab::Speed, Judged::Sketched);
  ASSERT_EQ(speed.series.front().role, PlotRole::Sketched);
  double least = speed.series.front().points.front().value, most = least;
  for (const PlotPoint& point : speed.series.front().points) {
    least = std::min(least, point.value);
    most = std::max(most, point.value);
  }
  ASSERT_LT(most - least, 0.01 * most);
  EXPECT_GE(speed.high - speed.low, 0.09 * most) << "not like its last digits";
}

// Where the coefficient falls to 0 some lines of the sample are traced the other way round.
TEST_F(Judging, ADrawnTargetStaysWithItsLineWhenTheLineTurnsRound) {
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  window_->setStage(PanelStage::Fairing);
  const auto endsOf = [this](std::size_t i) {
    const NurbsCurve& curve = session().curves()[i].sketched;
    const PageFrame& frame = session().output().frame;
    return std::pair<Vec2, Vec2>(frame.pointToImage(curve.point(curve.start())),
                                 frame.pointToImage(curve.point(curve.end())));
  };
  const auto all = [&] {
    std::vector<std::pair<Vec2, Vec2>> ends;
    for (std::size_t i = 0; i < session().curves().size(); ++i) ends.push_back(endsOf(i));
    return ends;
  };
  const auto setCoefficient = [this](const char* value) {
    window_->setStage(PanelStage::CleanUp);
    type(find<QLineEdit>("filter.coefficient.field"), QString::fromLatin1(value));
    window_->setStage(PanelStage::Fairing);
    return settle();
  };
  const auto before = all();
  ASSERT_TRUE(setCoefficient("0"));
  const auto after = all();
  std::optional<std::size_t> turned;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (const auto& [start, end] : after)
      if (!turned && (before[i].first - before[i].second).norm() > 100.0 && (before[i].first - end).norm() < 10.0 &&
          (before[i].second - start).norm() < 10.0)
        turned = i;
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  if (!turned) GTEST_SKIP() << "no line of the sample turns round";
  session().selectCurve(static_cast<int>(*turned));
  ASSERT_TRUE(waitUntil([this] { return !session().isWorking() && session().targets(); }));
  click("fairing.scope.one");
  click("fairing.mode.target");
  click("fairing.draw");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(isTargetDrawn(session()));
  const double needed = session().selected()->fairing.neededMm.value();
  const std::vector<ProfilePoint> drawn = fairingAsked(session()).profile;
  ASSERT_TRUE(setCoefficient("0"));
  ASSERT_TRUE(isTargetDrawn(session()));
  const std::vector<ProfilePoint> now = fairingAsked(session()).profile;
  ASSERT_EQ(now.size(), drawn.size());
  EXPECT_EQ(now.front().kappa, -drawn.back().kappa);
  EXPECT_EQ(session().selected()->fairingUsed.profile, now) << "the plot shows what the run follows";
  EXPECT_LT(session().selected()->fairing.neededMm.value(), 1.5 * needed + 0.3);
}

}  // namespace
}  // namespace batten
