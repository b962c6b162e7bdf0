// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QSlider>
#include <string>

#include "tests/ui/window_fixture.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"

namespace batten {
namespace {

using test::waitUntil;

class Layout : public test::WindowFixture {};

TEST_F(Layout, InALowWindowTheDrawingComesFirst) {
  openPage(test::ellipsePage());
  auto* plots = find<QWidget>("plots");
  auto* canvas = find<CurveCanvas>("canvas");
  const int roomy = plots->height();
  EXPECT_TRUE(plots->isVisible());
  window_->resize(1000, 700);
  ASSERT_TRUE(waitUntil([&] { return window_->height() <= 700 && plots->height() < roomy; }, 5000));
  EXPECT_TRUE(plots->isVisible());
  window_->resize(960, 600);
  ASSERT_TRUE(waitUntil([&] { return !plots->isVisible(); }, 5000));
  EXPECT_GT(canvas->height(), 360);
  EXPECT_TRUE(find<QWidget>("targetStrip")->isVisible());
  window_->resize(1280, 860);
  EXPECT_TRUE(waitUntil([&] { return plots->isVisible() && plots->height() == roomy; }, 5000)) << plots->height();
}

TEST_F(Layout, OnlyWhatTheToleranceAllowsIsRecommended) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.fairing.toleranceMm = 0.01;
  session().change(QStringLiteral("Tolerance"), recipe);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([this] { return session().targets() != nullptr && !session().isTargeting(); }));
  const int degree = session().targets()->recommendedDegree;
  ASSERT_GT(degree, 0);
  const auto& outcome = session().targets()->faired[degree - 1];
  ASSERT_TRUE(outcome);
  auto* tile = find<QAbstractButton>(("target." + std::to_string(degree)).c_str());
  EXPECT_EQ(tile->accessibleName().contains(QStringLiteral("recommended")), outcome->report.withinTolerance);
  EXPECT_EQ(tile->accessibleName().contains(QStringLiteral("simplest fit")), !outcome->report.withinTolerance);
}

TEST_F(Layout, EveryPlotNamesItsQuantityAndComesBack) {
  openPage(test::ellipsePage());
  auto* plots = window_->findChild<CurvePlots*>();
  auto* quantity = find<QLabel>("plot.quantity");
  for (const PlotTab tab : {PlotTab::Radius, PlotTab::Derivative, PlotTab::Deviation, PlotTab::Curvature}) {
    plots->setTab(tab);
    EXPECT_TRUE(quantity->text().contains(QStringLiteral("mm"))) << quantity->text().toStdString();
  }
  window_->view().setSuggestionAngleDeg(61);
  find<QSlider>("corners.suggestScale")->setValue(23);
  EXPECT_EQ(window_->view().suggestionScalePx(), 23);
  window_->close();
  openWindow();
  EXPECT_EQ(window_->findChild<CurvePlots*>()->tab(), PlotTab::Curvature);
  EXPECT_EQ(window_->view().suggestionAngleDeg(), 61);
  EXPECT_EQ(find<QSlider>("corners.suggestAngle")->value(), 61);
  EXPECT_EQ(find<QSlider>("corners.suggestScale")->value(), 23);
}

}  // namespace
}  // namespace batten
