// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QTest>

#include "tests/ui/window_fixture.h"
#include "ui/panels/panel_parts.h"
#include "ui/panels/shape_window.h"
#include "ui/plots/curve_plots.h"
#include "ui/plots/plot_editing.h"

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
  EXPECT_EQ(session().recipe().fairing.keepExtrema, 6);
  session().undoStack()->undo();
  EXPECT_EQ(session().recipe().fairing.keepExtrema, kKeepSignificant);
}

TEST_F(FairingWindow, TheTargetIsDrawnByDraggingItsPoints) {
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Curvature);
  click("fairing.mode.target");
  ASSERT_TRUE(settle());
  click("fairing.draw");
  ASSERT_EQ(session().recipe().choices.size(), 1u);
  EXPECT_EQ(choice().target, kDrawnTarget);
  const std::vector<ProfilePoint> before = choice().profile;
  ASSERT_GE(before.size(), 2u);
  ASSERT_TRUE(settle());
  QTest::qWait(50);
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
  EXPECT_EQ(used().target, kDrawnTarget);
  EXPECT_EQ(used().profile, choice().profile);
  EXPECT_GT(session().selected()->fairing.neededMm, 0.0);
  session().undoStack()->undo();
  EXPECT_EQ(choice().profile, before);
  click("fairing.forget");
  EXPECT_NE(session().recipe().choices.front().target, kDrawnTarget);
  EXPECT_TRUE(session().recipe().choices.front().profile.empty());
}

TEST_F(FairingWindow, TheTargetIsSplitOnThePlot) {
  window_->findChild<CurvePlots*>()->setTab(PlotTab::Curvature);
  click("fairing.mode.target");
  ASSERT_TRUE(settle());
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
  QTest::qWait(50);
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
  shapes->close();
}

}  // namespace
}  // namespace batten
