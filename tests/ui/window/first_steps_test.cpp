// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody meets who uses the window for the first time: where keys go, what a change shows, what words say.
#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "tests/ui/window_fixture.h"
#include "ui/canvas/layers/chip_layer.h"
#include "ui/canvas/scene/canvas_scene.h"
#include "ui/canvas/scene/comb_runs.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/stages/curves/pin_panel.h"
#include "ui/session/growing_player.h"

namespace batten {
namespace {

using test::waitUntil;

class FirstSteps : public test::WindowFixture {
 protected:
  void round(double mm) {
    Recipe recipe = session().recipe();
    ASSERT_FALSE(recipe.cornerMarks.empty());
    recipe.cornerMarks[0].roundMm = mm;
    session().change(QStringLiteral("Round corner"), recipe);
    ASSERT_TRUE(settle());
  }
  void markCorner(const Vec2& px) {
    Recipe recipe = session().recipe();
    recipe.cornerMarks.push_back({px});
    session().change(QStringLiteral("Mark corner"), recipe);
    ASSERT_TRUE(settle());
  }
};

TEST_F(FirstSteps, KeysGoToTheDrawingWhenWhatHadThemHasGone) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Edges);
  auto* field = find<QLineEdit>("contours.min_length.field");
  field->setFocus();
  ASSERT_TRUE(field->hasFocus());
  window_->setStage(PanelStage::Curves);
  EXPECT_EQ(window_->focusWidget(), find<CurveCanvas>("canvas"));
  // The letter is a tool's again, not half of a number.
  QTest::keyClick(window_->focusWidget(), Qt::Key_K);
  EXPECT_EQ(window_->view().tool(), Tool::Corners);
}

TEST_F(FirstSteps, AButtonThatHasDoneItsWorkDoesNotHandItsKeysToANumber) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Corners);
  auto* all = find<QPushButton>("corners.takeAll");
  ASSERT_TRUE(waitUntil([&] { return all->isEnabled(); }));
  all->setFocus();
  all->click();
  ASSERT_TRUE(waitUntil([&] { return !all->isEnabled(); }));
  EXPECT_TRUE(waitUntil([&] { return qobject_cast<QLineEdit*>(window_->focusWidget()) == nullptr; }));
}

TEST_F(FirstSteps, ARoundingIsSeenWhereItIsSet) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  ASSERT_NO_FATAL_FAILURE(markCorner({200, 100}));
  window_->setStage(PanelStage::Corners);
  EXPECT_FALSE(window_->view().isVisible(Layer::Faired)) << "the sketched curve is what corners are marked on";
  ASSERT_NO_FATAL_FAILURE(round(3.0));
  EXPECT_TRUE(window_->view().isVisible(Layer::Faired));
  session().undoStack()->undo();
  EXPECT_FALSE(window_->view().isVisible(Layer::Faired));
  session().undoStack()->redo();
  window_->setStage(PanelStage::Edges);
  EXPECT_FALSE(window_->view().isVisible(Layer::Faired));
  window_->setStage(PanelStage::Corners);
  EXPECT_TRUE(window_->view().isVisible(Layer::Faired)) << "a rounding from before is seen, too";
  window_->setStage(PanelStage::Fairing);
  EXPECT_TRUE(window_->view().isVisible(Layer::Faired));
  // What is said is said of the curve that is drawn.
  ASSERT_TRUE(settle());
  const TracedCurve* curve = session().selected();
  ASSERT_NE(curve, nullptr);
  ASSERT_NE(curve->faired.controlPointCount(), curve->sketched.controlPointCount());
  const CanvasScene scene(session(), window_->view());
  const auto says = [&](const NurbsCurve& one) {
    return curveText(scene).contains(QStringLiteral(" %1 control points").arg(one.controlPointCount()));
  };
  EXPECT_TRUE(says(curve->faired)) << curveText(scene).toStdString();
  window_->setStage(PanelStage::Curves);
  EXPECT_TRUE(says(curve->sketched)) << curveText(scene).toStdString();
}

TEST_F(FirstSteps, BumpsAreMarkedWhereCurvesAreJudged) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage()));
  for (const PanelStage stage : {PanelStage::Edges, PanelStage::Corners, PanelStage::Export}) {
    window_->setStage(stage);
    EXPECT_FALSE(window_->view().isVisible(Layer::Extrema));
  }
  for (const PanelStage stage : {PanelStage::Curves, PanelStage::Fairing}) {
    window_->setStage(stage);
    EXPECT_TRUE(window_->view().isVisible(Layer::Extrema));
  }
}

TEST_F(FirstSteps, TheHintSpeaksOfTheToolInHand) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Corners);
  const auto* hint = find<QLabel>("status.hint");
  const QString atCorners = hint->text();
  window_->action(ActionId::ToolLines)->trigger();
  EXPECT_EQ(hint->text(), actionInfo(ActionId::ToolLines).help);
  window_->action(ActionId::ToolCorners)->trigger();
  EXPECT_EQ(hint->text(), atCorners);
}

TEST_F(FirstSteps, AnOldResultIsNotCalledAFallback) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage()));
  ASSERT_NE(session().selected(), nullptr);
  const CanvasScene scene(session(), window_->view());
  EXPECT_TRUE(curveText(scene).contains(QStringLiteral("fair"))) << curveText(scene).toStdString();
  Recipe recipe = session().recipe();
  recipe.construct.method = ConstructMethod::Typical;
  session().change(QStringLiteral("Method"), recipe);
  ASSERT_TRUE(session().isStale(StageId::Curves)) << "the run cannot have ended before events were handled";
  EXPECT_FALSE(curveText(scene).contains(QStringLiteral("do not fit"))) << curveText(scene).toStdString();
  ASSERT_TRUE(settle());
}

TEST(NumberField, SaysWhatItsSmallestValueMeans) {
  NumberField field;
  field.setRange(-1.0, 99.0);
  field.setMinimumText(QStringLiteral("fewest"));
  field.setValue(-1.0);
  EXPECT_EQ(field.edit()->text(), QStringLiteral("fewest"));
  field.setValue(0.0);
  EXPECT_EQ(field.edit()->text(), QStringLiteral("0"));
  double given = 7.0;
  QObject::connect(&field, &NumberField::committed, [&](double value) { given = value; });
  field.edit()->setText(QStringLiteral("Fewest"));
  QTest::keyClick(field.edit(), Qt::Key_Return);
  EXPECT_EQ(given, -1.0);
  EXPECT_EQ(field.edit()->text(), QStringLiteral("fewest"));
}

TEST_F(FirstSteps, AreasAndLengthsCanBeTypedInMillimetres) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  Recipe recipe = session().recipe();
  recipe.dpi = 254.0;  // 10 px a millimetre
  session().change(QStringLiteral("Resolution"), recipe);
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Threshold);
  const auto type = [&](const char* field, const QString& text) {
    auto* edit = find<QLineEdit>(field);
    edit->setFocus();
    edit->setText(text);
    QTest::keyClick(edit, Qt::Key_Return);
  };
  type("threshold.speck_area.field", QStringLiteral("0.5 mm2"));
  EXPECT_EQ(session().recipe().threshold.speckArea, 50);
  type("threshold.speck_area.field", QStringLiteral("0,3 mm²"));
  EXPECT_EQ(session().recipe().threshold.speckArea, 30);
  type("threshold.speck_area.field", QStringLiteral("40 px2"));
  EXPECT_EQ(session().recipe().threshold.speckArea, 40);
  type("threshold.speck_area.field", QStringLiteral("7 mm"));  // no area
  EXPECT_EQ(session().recipe().threshold.speckArea, 40);
  type("threshold.speck_area.field", QStringLiteral("45"));
  EXPECT_EQ(session().recipe().threshold.speckArea, 45);
  EXPECT_TRUE(
      find<QLineEdit>("threshold.speck_area.field")->parentWidget()->toolTip().contains(QStringLiteral("0.45")));
  window_->setStage(PanelStage::Edges);
  type("contours.min_length.field", QStringLiteral("2.5 mm"));
  EXPECT_EQ(session().recipe().contours.minLengthPx, 25.0);
  ASSERT_TRUE(settle());
}

TEST_F(FirstSteps, ArrowsPassBetweenAutoAndTheFewestSegments) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Curves);
  Recipe recipe = session().recipe();
  recipe.construct.method = ConstructMethod::Bezier;
  session().change(QStringLiteral("Method"), recipe);
  ASSERT_TRUE(settle());
  auto* field = find<QLineEdit>("segments.count.field");
  ASSERT_TRUE(field->isVisible());
  EXPECT_EQ(field->text(), QStringLiteral("auto"));
  const std::pair<Qt::Key, int> steps[] = {
      {Qt::Key_Up, 2}, {Qt::Key_Up, 3}, {Qt::Key_Down, 2}, {Qt::Key_Down, 0}, {Qt::Key_Up, 2}};
  for (const auto& [key, count] : steps) {
    QTest::keyClick(field, key);
    EXPECT_EQ(session().recipe().segments.count, count);
    EXPECT_EQ(field->text(), count == 0 ? QStringLiteral("auto") : QString::number(count));
  }
  const QString help = find<QWidget>("segments.count.row")->toolTip();
  EXPECT_TRUE(help.contains(QStringLiteral("auto (0)"))) << help.toStdString();
  EXPECT_TRUE(find<QWidget>("fairing.keep_extrema.row")->toolTip().contains(QStringLiteral("fewest (-1)")));
  ASSERT_TRUE(settle());
}

TEST_F(FirstSteps, AHiddenCombShowsNoQuillUnderTheMouse) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::ellipsePage()));
  window_->setStage(PanelStage::Curves);
  Recipe recipe = session().recipe();
  recipe.construct.method = ConstructMethod::Typical;
  recipe.construct.typical = TypicalMode::Growing;
  session().change(QStringLiteral("Method"), recipe);
  ASSERT_TRUE(settle());
  ASSERT_NE(session().selected(), nullptr);
  auto* canvas = find<CurveCanvas>("canvas");
  const auto shown = [&](bool comb, double share) {
    window_->view().setVisible(Layer::Comb, comb);
    session().setCursor(share * session().selected()->sketchedFigures.lengthMm);
    return canvas->grab().toImage();
  };
  ASSERT_TRUE(waitUntil([&] { return shown(true, 0.3) != shown(false, 0.3); })) << "the comb is drawn";
  auto* open = find<QPushButton>("growing.open");
  QTest::mouseClick(open, Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return session().growing().isOpen() && !session().growing().isComputing(); }));
  EXPECT_NE(shown(true, 0.3), shown(true, 0.6)) << "the place under the mouse is marked";
  EXPECT_EQ(shown(true, 0.3), shown(false, 0.3));
  QTest::mouseClick(open, Qt::LeftButton);
  EXPECT_NE(shown(true, 0.3), shown(false, 0.3));
}

TEST(PinPanel, WritesUnevennessInFewDigits) {
  EXPECT_EQ(unevennessText(0.5), QStringLiteral("0.5"));
  EXPECT_EQ(unevennessText(37.21), QStringLiteral("37.2"));
  EXPECT_EQ(unevennessText(999.7), QStringLiteral("1.00 · 10³"));
  EXPECT_EQ(unevennessText(1234.0), QStringLiteral("1.23 · 10³"));
  EXPECT_EQ(unevennessText(9999.4), QStringLiteral("1.00 · 10⁴"));
  EXPECT_EQ(unevennessText(9999.7), QStringLiteral("1.00 · 10⁴"));
  EXPECT_EQ(unevennessText(2.79e7), QStringLiteral("2.79 · 10⁷"));
}

/// A comb over a straight line along x whose curvature is given.
std::vector<CombPoint> combOf(const std::vector<double>& kappa) {
  std::vector<CombPoint> points(kappa.size());
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    points[i].px = Vec2(double(i), 0.0);
    points[i].outPx = Vec2(0.0, -1.0);
    points[i].kappa = kappa[i];
    points[i].s = double(i);
  }
  return points;
}

TEST(CombRuns, ASharpPlaceIsOneCutQuill) {
  std::vector<double> kappa(200, 0.1);
  kappa[100] = 5.0;
  kappa[101] = 7.0;
  kappa[102] = -6.0;
  const CombScale scale = combScaleFor({0.1, 100.0, 200.0, 2}, 1.0, 1000.0);
  EXPECT_NEAR(scale.pxPerKappa, 130.0, 1e-9) << "at 0.1 / mm 0.13 of the extent";
  const auto points = combOf(kappa);
  const auto runs = combRuns(points, scale);
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_FALSE(runs[0].isCut);
  EXPECT_TRUE(runs[1].isCut && runs[1].isSpike);
  EXPECT_EQ(runs[1].peak, 101u);
  EXPECT_TRUE(runs[2].isCut && runs[2].isSpike) << "to the other side it is another one";
  EXPECT_FALSE(runs[3].isCut);
  std::size_t next = 0;
  for (const CombRun& run : runs) {
    EXPECT_EQ(run.first, next);
    next = run.last + 1;
  }
  EXPECT_EQ(next, points.size());
  const CombPoint crossing = combCrossing(points[99], points[100], scale);
  EXPECT_NEAR(std::abs(scale.heightOf(crossing.kappa)), scale.limitPx, 1e-9);
  EXPECT_GT(crossing.px.x(), 99.0);
  EXPECT_LT(crossing.px.x(), 100.0);
}

TEST(CombRuns, AnEvenCombIsNeverCutAndALowerOneShowsMore) {
  const auto points = combOf(std::vector<double>(50, 0.02));
  const CombedCurve smooth{0.02, 400.0, 500.0, 1};
  const auto whole = combRuns(points, combScaleFor(smooth, 1.0, 1000.0));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_FALSE(whole[0].isCut);
  const CombScale usual = combScaleFor(smooth, 1.0, 1000.0), low = combScaleFor(smooth, 0.2, 1000.0);
  EXPECT_TRUE(usual.cuts(0.08));
  EXPECT_FALSE(low.cuts(0.08));
  EXPECT_LE(combScaleFor(smooth, 20.0, 300.0).limitPx, 120.0) << "never more than two fifths of the view";
  EXPECT_EQ(combScaleFor({0.0, 400.0, 500.0, 1}, 1.0, 1000.0).pxPerKappa, 0.0);
  EXPECT_TRUE(combRuns({}, usual).empty());
}

TEST(CombRuns, ALineOfManyBendsHasALowerComb) {
  const CombScale plain = combScaleFor({0.1, 400.0, 1200.0, 4}, 1.0, 1000.0);
  const CombScale wavy = combScaleFor({0.1, 400.0, 1200.0, 60}, 1.0, 1000.0);
  EXPECT_NEAR(plain.pxPerKappa * 0.1, 0.13 * 400.0, 1e-9);
  EXPECT_NEAR(wavy.pxPerKappa * 0.1, 1200.0 / 61.0, 1e-9) << "a quill about as long as a bend";
  EXPECT_GT(combScaleFor({0.1, 400.0, 1200.0, 5000}, 1.0, 1000.0).pxPerKappa, 0.0);
}

}  // namespace
}  // namespace batten
