// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QRegularExpression>
#include <QTest>
#include <cmath>

#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/target_advice.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/fairing_figures.h"
#include "ui/panels/targets/shape_view.h"
#include "ui/panels/targets/shape_window.h"
#include "ui/plots/curve_plots.h"
#include "ui/plots/plot_editing.h"
#include "ui/session/edits/fairing_edits.h"

namespace batten {
namespace {

using test::waitUntil;

/// A window on the fairing stage with a page open.
class FairingWindow : public test::WindowFixture {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
    window_->resize(1280, 900);
    ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage()));
    window_->setStage(PanelStage::Fairing);
    session().selectCurve(0);
    ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr; }));
  }
  void click(const char* name) { QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton); }
  FairingParams used() { return session().selected()->fairingUsed; }
  const PieceChoice& choice() { return session().recipe().choices.front(); }
  /// A place of the plot where a press would do what the hint begins with.
  QPoint placeOf(const QString& hint, int fromX = 60) {
    const auto* plot = find<QWidget>("plot");
    const auto* editing = window_->findChild<PlotEditing*>();
    for (int x = fromX; x < plot->width() - 16; ++x)
      for (int y = 4; y < plot->height() - 20; ++y)
        if (editing->hintAt(QPoint(x, y)).startsWith(hint)) return {x, y};
    return {-1, -1};
  }
};

TEST_F(FairingWindow, EndsAndUseOfTheToleranceBelongToTheCurveWhileItIsMeant) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.drawArc(QRectF(80, 60, 480, 240), 20 * 16, 140 * 16);
    painter.drawArc(QRectF(80, 160, 480, 240), 20 * 16, 140 * 16);
  })));
  window_->setStage(PanelStage::Fairing);
  ASSERT_EQ(session().curves().size(), 2u);
  session().selectCurve(0);
  click("fairing.mode.tolerance");
  click("fairing.scope.one");
  click("fairing.hold_start.tangent");
  click("fairing.hold_end.curvature");
  click("fairing.spend.all");
  ASSERT_TRUE(waitUntil([this] { return used().tolerancePolicy == TolerancePolicy::All; }));
  const Recipe& recipe = session().recipe();
  EXPECT_EQ(recipe.fairing.startHold, EndHold{});
  EXPECT_EQ(recipe.fairing.tolerancePolicy, TolerancePolicy::AsNeeded);
  EXPECT_EQ(used().startHold, (EndHold{true, false}));
  EXPECT_EQ(used().endHold, (EndHold{true, true}));
  EXPECT_EQ(session().curves()[1].fairingUsed.endHold, EndHold{});
  // The other curve shows its own, the common ones; back at the first they are as they were set.
  session().selectCurve(1);
  EXPECT_FALSE(find<QAbstractButton>("fairing.hold_end.curvature")->isChecked());
  session().selectCurve(0);
  EXPECT_TRUE(find<QAbstractButton>("fairing.hold_end.curvature")->isChecked());
  click("fairing.useForAll");
  EXPECT_EQ(session().recipe().fairing.endHold, (EndHold{true, true}));
  EXPECT_TRUE(session().recipe().choices.empty());
}

TEST_F(FairingWindow, ThePlotFollowsACurveThatGetsShorter) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  const auto mark = [this](double x, double y) {
    Recipe recipe = session().recipe();
    recipe.cornerMarks = {{{x, y}}};
    session().change(QStringLiteral("mark"), recipe);
    return waitUntil([this] { return !session().isBusy(); });
  };
  const auto* plots = window_->findChild<CurvePlots*>();
  ASSERT_TRUE(mark(400, 300));
  session().selectCurve(0);
  const double before = session().selected()->sketchedFigures.lengthMm;
  ASSERT_TRUE(waitUntil([&] { return std::abs(plots->shownLengths().second - before) < 1e-6; }));
  ASSERT_TRUE(mark(420, 278));
  const double after = session().selected()->sketchedFigures.lengthMm;
  ASSERT_LT(after, 0.97 * before);
  ASSERT_GT(after, 0.85 * before);
  EXPECT_TRUE(waitUntil([&] { return std::abs(plots->shownLengths().second - after) < 1e-6; }));
}

TEST_F(FairingWindow, EveryModeHasItsButtonAndItsOwnSetting) {
  const std::pair<const char*, FairingMode> modes[] = {{"fairing.mode.target", FairingMode::Target},
                                                       {"fairing.mode.tolerance", FairingMode::Tolerance},
                                                       {"fairing.mode.monotone", FairingMode::Monotone},
                                                       {"fairing.mode.lowpass", FairingMode::LowPass},
                                                       {"fairing.mode.none", FairingMode::None}};
  for (const auto& [name, mode] : modes) {
    click(name);
    EXPECT_EQ(session().recipe().fairing.mode, mode) << name;
    EXPECT_EQ(find<QWidget>("fairing.keep_extrema.row")->isVisible(), mode == FairingMode::Monotone);
    EXPECT_EQ(find<QWidget>("fairing.lowpass.row")->isVisible(), mode == FairingMode::LowPass);
    ASSERT_TRUE(settle());
    EXPECT_EQ(used().mode, mode);
  }
  click("fairing.mode.monotone");
  auto* field = find<QLineEdit>("fairing.keep_extrema.field");
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("6"));
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(session().recipe().fairing.keepExtrema.count, 6);
  session().undoStack()->undo();
  EXPECT_FALSE(session().recipe().fairing.keepExtrema.count);
}

TEST_F(FairingWindow, TheTargetIsDrawnByDraggingItsPoints) {
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Curvature);
  click("fairing.mode.target");
  ASSERT_TRUE(settle());
  const double needed = session().selected()->fairing.neededMm.value();
  click("fairing.draw");
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  EXPECT_EQ(choice().target, FairingTarget::Drawn);
  const std::vector<ProfilePoint> before = choice().profile;
  ASSERT_GE(before.size(), 2u);
  ASSERT_TRUE(settle());
  EXPECT_LT(session().selected()->fairing.neededMm.value(), 1.1 * needed + 0.5 * used().toleranceMm)
      << "what is drawn first is the target that was followed";
  ASSERT_TRUE(waitUntil([this] { return placeOf(QStringLiteral("Drag the point"), 120).x() > 0; }));
  auto* plot = find<QWidget>("plot");
  const QPoint handle = placeOf(QStringLiteral("Drag the point"), 120) + QPoint(3, 3);
  ASSERT_GT(handle.x(), 0);
  const int steps = session().undoStack()->index();
  QTest::mousePress(plot, Qt::LeftButton, {}, handle);
  QTest::mouseMove(plot, handle + QPoint(0, 6));
  QTest::mouseMove(plot, handle + QPoint(0, 14));
  QTest::mouseRelease(plot, Qt::LeftButton, {}, handle + QPoint(0, 14));
  EXPECT_EQ(session().undoStack()->index(), steps + 1) << "a drag is one step";
  EXPECT_NE(choice().profile, before);
  EXPECT_EQ(choice().profile.size(), before.size());
  ASSERT_TRUE(settle());
  EXPECT_EQ(used().target, FairingTarget::Drawn);
  EXPECT_EQ(used().profile, choice().profile);
  EXPECT_GT(session().selected()->fairing.neededMm.value(), 0.0);
  session().undoStack()->undo();
  EXPECT_EQ(choice().profile, before);
  click("fairing.forget");
  EXPECT_NE(session().recipe().choices.front().target, FairingTarget::Drawn);
  EXPECT_TRUE(session().recipe().choices.front().profile.empty());
}

TEST_F(FairingWindow, TheTargetIsSplitOnThePlot) {
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Curvature);
  click("fairing.mode.target");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr; }));
  EXPECT_EQ(session().targets()->splits.size(), 4u) << "the natural spans of an ellipse";
  click("fairing.unsplit");
  ASSERT_TRUE(settle());
  EXPECT_EQ(choice().spans, TargetSpans::Whole);
  ASSERT_TRUE(waitUntil([this] { return session().targets() && session().targets()->splits.empty(); }));
  auto* plot = find<QWidget>("plot");
  QTest::mouseClick(plot, Qt::RightButton, {}, QPoint(plot->width() / 3, 30));
  auto* menu = find<QMenu>("plot.menu");
  ASSERT_NE(menu, nullptr);
  menu->findChild<QAction*>(QStringLiteral("plot.split"))->trigger();
  menu->close();
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  ASSERT_EQ(choice().splitsPx.size(), 1u);
  ASSERT_TRUE(settle());
  ASSERT_EQ(used().targets.splits.size(), 1u);
  const double share = (plot->width() / 3.0 - 54.0) / (plot->width() - 70.0);
  EXPECT_NEAR(used().targets.splits[0], share, 0.01);
  ASSERT_TRUE(waitUntil([this] { return placeOf(QStringLiteral("Drag the split")).x() > 0; }));
  const QPoint grip = placeOf(QStringLiteral("Drag the split")) + QPoint(4, 0);
  ASSERT_GT(grip.x(), 0);
  QTest::mousePress(plot, Qt::LeftButton, {}, grip);
  QTest::mouseMove(plot, grip + QPoint(60, 0));
  QTest::mouseRelease(plot, Qt::LeftButton, {}, grip + QPoint(60, 0));
  ASSERT_TRUE(settle());
  EXPECT_NEAR(used().targets.splits[0], share + 60.0 / (plot->width() - 70.0), 0.02);
  click("fairing.unsplit");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(used().targets.splits.empty());
  session().undoStack()->undo();
  EXPECT_EQ(choice().splitsPx.size(), 1u);
  // A click on a split joins the spans beside it.
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([this] { return placeOf(QStringLiteral("Drag the split")).x() > 0; }));
  const QPoint join = placeOf(QStringLiteral("Drag the split")) + QPoint(4, 0);
  ASSERT_GT(join.x(), 0);
  QTest::mouseClick(plot, Qt::LeftButton, {}, join);
  EXPECT_TRUE(choice().splitsPx.empty());
  EXPECT_EQ(choice().spans, TargetSpans::Whole);
  click("fairing.split");
  ASSERT_TRUE(settle());
  EXPECT_EQ(used().targets.spans, TargetSpans::Natural);
}

TEST_F(FairingWindow, ASpanOfTheCurveHasATargetOfItsOwn) {
  ASSERT_TRUE(settle());
  session().pointAtSpan(0.3);
  ASSERT_TRUE(waitUntil([this] { return session().targets() && session().targets()->span; }));
  const ProfileSpan span = *session().targets()->span;
  EXPECT_LT(span.from, 0.3);
  EXPECT_GT(span.to, 0.3);
  EXPECT_LT(span.to - span.from, 0.4) << "about a quarter of the ellipse";
  find<QAbstractButton>("target.3")->click();
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  ASSERT_EQ(choice().spanTargets.size(), 1u);
  EXPECT_EQ(choice().spanTargets[0].degree, 3);
  ASSERT_EQ(used().spanTargets.size(), 1u);
  EXPECT_GT(used().spanTargets[0].at, span.from);
  EXPECT_LT(used().spanTargets[0].at, span.to);
  EXPECT_TRUE(find<QAbstractButton>("target.3")->accessibleName().contains(QStringLiteral("chosen")));
  // Another one for the same span takes its place.
  find<QAbstractButton>("target.5")->click();
  ASSERT_TRUE(settle());
  ASSERT_EQ(choice().spanTargets.size(), 1u);
  EXPECT_EQ(choice().spanTargets[0].degree, 5);
  click("fairing.whole");
  EXPECT_FALSE(session().pointedSpan());
  ASSERT_TRUE(waitUntil([this] { return session().targets() && !session().targets()->span; }));
  find<QAbstractButton>("target.4")->click();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(used().spanTargets.empty());
  EXPECT_EQ(used().target, FairingTarget::Degree4);
}

TEST_F(FairingWindow, ShapesAreComparedAndTheTableShowsAllSixProfiles) {
  click("fairing.compare");
  auto* shapes = find<ShapeWindow>("shapes");
  ASSERT_NE(shapes, nullptr);
  EXPECT_TRUE(shapes->isVisible());
  const auto* figures = shapes->findChild<FigureTable*>(QStringLiteral("shapes.figures"));
  const auto* table = shapes->findChild<FigureTable*>(QStringLiteral("shapes.table"));
  ASSERT_EQ(table->rows().size(), 6u);
  const auto& target = session().targets()->targets.profiles[3];
  EXPECT_EQ(table->rows()[3].cells[0].text, QString::number(target.similarity, 'f', 5));
  auto* first = shapes->findChild<QComboBox*>(QStringLiteral("shapes.first"));
  auto* second = shapes->findChild<QComboBox*>(QStringLiteral("shapes.second"));
  ASSERT_GT(first->count(), 1);
  second->setCurrentIndex(first->currentIndex());
  EXPECT_EQ(figures->rows()[0].cells[0].text, QStringLiteral("1.0000")) << "a curve is like itself";
  const auto* view = shapes->findChild<ShapeView*>();
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(view->accessibleName(), QStringLiteral("Radius over arc length"));
  EXPECT_TRUE(QRegularExpression(QStringLiteral("^From .*[0-9] to .*[0-9] times the mean\\.$"))
                  .match(view->accessibleDescription())
                  .hasMatch())
      << view->accessibleDescription().toStdString();
  const QImage picture = shapes->findChild<ShapeView*>()->grab().toImage();
  int coloured = 0;
  for (int x = 0; x < picture.width(); ++x)
    for (int y = 0; y < picture.height(); ++y) coloured += picture.pixelColor(x, y).hsvSaturation() > 120 ? 1 : 0;
  EXPECT_GT(coloured, picture.width() / 2) << "the curves are drawn";
  shapes->findChild<QAbstractButton*>(QStringLiteral("shapes.quantity.curvature"))->click();
  EXPECT_EQ(view->accessibleName(), QStringLiteral("Curvature over arc length"));
  shapes->close();
}

/// A spiral drawn by a trembling hand.
QImage spiralPage() {
  QImage page(QSize(640, 480), QImage::Format_Grayscale8);
  page.fill(245);
  page.setDotsPerMeterX(11811);
  page.setDotsPerMeterY(11811);
  QPolygonF line;
  for (double angle = 0.0; angle < 3.6; angle += 0.01) {
    const double radius = 120.0 + 35.0 * angle + 2.0 * std::sin(9.0 * angle);
    line << QPointF(340.0 + radius * std::cos(angle), 250.0 - radius * std::sin(angle));
  }
  QPainter painter(&page);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(30, 30, 30), 5.0, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
  painter.drawPolyline(line);
  return page;
}

TEST_F(FairingWindow, TilesAndTableRecommendAlike) {
  ASSERT_NO_FATAL_FAILURE(openPage(spiralPage()));
  click("fairing.mode.target");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
  click("fairing.compare");
  const auto* shapes = find<ShapeWindow>("shapes");
  const auto* table = shapes->findChild<FigureTable*>(QStringLiteral("shapes.table"));
  const auto* words = shapes->findChild<QLabel*>(QStringLiteral("shapes.recommendation"));
  // Of the largest tolerance and the least, one allows it and one does not.
  for (const bool allowed : {true, false}) {
    type(find<QLineEdit>("fairing.tolerance.field"), allowed ? QStringLiteral("20") : QStringLiteral("0.001"));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(waitUntil([&] { return session().targets() && !session().isTargeting(); }));
    const int nearest =
        session().targets()->recommendedDegree.value_or(0);  // the spans go by the tolerance, and it by the spans
    ASSERT_GT(nearest, 0);
    const auto* tile = window_->findChild<QAbstractButton*>(QStringLiteral("target.%1").arg(nearest));
    const auto isTicked = [&] { return table->rows()[std::size_t(nearest - 1)].name.contains(QStringLiteral("✓")); };
    EXPECT_EQ(isAdvisable(*session().targets(), nearest, session().recipe().fairing.toleranceMm), allowed);
    EXPECT_EQ(tile->accessibleName().contains(QStringLiteral(", recommended")), allowed);
    EXPECT_FALSE(tile->accessibleName().contains(QStringLiteral("simplest fit"))) << "what does not fit is no fit";
    EXPECT_EQ(isTicked(), allowed);
    EXPECT_EQ(words->text().contains(QStringLiteral("not recommended")), !allowed) << words->text().toStdString();
  }
}

TEST(TargetAdvice, NothingIsRecommendedThatAddsBumpsDoesNotMoveOrIsUnlike) {
  const auto isAdvised = [](int before, int after, double movedMm, bool withinTolerance = true,
                            double similarity = 0.99) {
    TargetOutcomes outcomes;
    outcomes.targets.profiles[2].similarity = similarity;
    outcomes.faired[2].emplace();
    FairingReport& report = outcomes.faired[2]->report;
    report.extremaBefore = before;
    report.extremaAfter = after;
    report.maxDeviationMm = movedMm;
    report.withinTolerance = withinTolerance;
    return isAdvisable(outcomes, 3, 0.1);
  };
  EXPECT_TRUE(isAdvised(4, 4, 0.05));
  EXPECT_TRUE(isAdvised(4, 2, 0.05));
  EXPECT_FALSE(isAdvised(4, 2, 0.00001)) << "bumps do not go without a move";
  EXPECT_FALSE(isAdvised(602, 600, 0.001, true, -0.09));
  EXPECT_TRUE(isAdvised(9, 0, 0.05, true, 0.42)) << "waves that go leave other radii behind";
  EXPECT_FALSE(isAdvised(4, 4, 0.00001));
  EXPECT_FALSE(isAdvised(4, 5, 0.05));
  EXPECT_FALSE(isAdvised(4, 2, 0.11));
  EXPECT_FALSE(isAdvised(4, 2, 0.05, false));
  EXPECT_FALSE(isAdvisable(TargetOutcomes{}, 3, 0.1));
}

TEST(FairingNote, ATargetThatIsTooFarGetsOneAdvice) {
  TracedCurve curve;
  curve.sketched = curve.faired = NurbsCurve::make(1, {0.0, 0.0, 1.0, 1.0}, {Vec2(0, 0), Vec2(10, 0)}).value();
  curve.fairingUsed.mode = FairingMode::Target;
  curve.fairingUsed.target = FairingTarget::Drawn;
  curve.fairing.note = "Unchanged: fairing would add curvature extrema. Raise the tolerance.";
  curve.fairing.withinTolerance = false;
  curve.fairing.neededMm = 5.02;
  const FairingNote far = fairingNote(curve);
  EXPECT_FALSE(far.text.contains(QStringLiteral("aise"))) << far.text.toStdString();
  EXPECT_TRUE(far.text.contains(QStringLiteral("5.02 mm"))) << far.text.toStdString();
  EXPECT_EQ(far.text.count(QStringLiteral("choose")), 1) << far.text.toStdString();
  EXPECT_FALSE(far.neededMm);
  // Near enough, the tolerance is what helps.
  curve.fairing.neededMm = mostSensibleToleranceMm(curve.sketched);
  curve.fairingUsed.toleranceMm = 0.5 * *curve.fairing.neededMm;
  EXPECT_TRUE(fairingNote(curve).text.contains(QStringLiteral("Raise the tolerance")));
  EXPECT_TRUE(fairingNote(curve).neededMm);
}

TEST_F(FairingWindow, ADrawnTargetThatIsTooFarIsNotToBeReachedByTheTolerance) {
  for (const double curvature : {0.5, -0.2, -0.5}) {
    drawTarget(session(), {{0.0, curvature}, {0.5, -curvature}, {1.0, curvature}});
    ASSERT_TRUE(settle());
    const std::string listed = session().selected()->fairing.note,
                      panel = fairingNote(*session().selected()).text.toStdString();
    for (const std::string& text : {listed, panel}) {
      const bool raises = text.find("Raise") != std::string::npos, chooses = text.find("choose") != std::string::npos;
      EXPECT_FALSE(raises && chooses) << text;
    }
    if (panel.find("choose") != std::string::npos) {
      EXPECT_EQ(listed.find("Raise"), std::string::npos) << listed;
    }
  }
}

}  // namespace
}  // namespace batten
