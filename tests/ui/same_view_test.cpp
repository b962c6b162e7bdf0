// SPDX-License-Identifier: GPL-3.0-or-later
// What the drawing keeps from stage to stage, and what lies over it.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QMenu>
#include <QPainter>
#include <QPainterPath>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/ui/window_fixture.h"
#include "ui/plots/plot_series.h"
#include "ui/session/curve_names.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

using test::waitUntil;

class SameView : public test::WindowFixture {
 protected:
  QPointF placeOf(const Vec2& px) { return find<CurveCanvas>("canvas")->toWidget(px); }
  /// Pixels of the canvas that have about a colour.
  int count(const QColor& colour) {
    QTest::qWait(150);  // longer than the canvas takes to paint again
    const QImage all = find<CurveCanvas>("canvas")->grab().toImage();
    constexpr int kNear = 24;  // of 255, in each channel
    int found = 0;
    for (int y = 0; y < all.height(); ++y)
      for (int x = 0; x < all.width(); ++x) {
        const QColor one = all.pixelColor(x, y);
        found += std::abs(one.red() - colour.red()) < kNear && std::abs(one.green() - colour.green()) < kNear &&
                         std::abs(one.blue() - colour.blue()) < kNear
                     ? 1
                     : 0;
      }
    return found;
  }
};

TEST_F(SameView, ThePageKeepsItsSizeAndPlaceFromStageToStage) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  for (const QSize size : {QSize(1366, 768), QSize(1920, 1080)}) {
    window_->resize(size);
    ASSERT_TRUE(waitUntil([&] { return window_->size() == size; }, 5000));
    for (const bool isZoomed : {false, true}) {
      window_->setStage(PanelStage::Curves);
      ASSERT_TRUE(settleLayout());
      window_->action(ActionId::ZoomFit)->trigger();
      if (isZoomed) window_->action(ActionId::ZoomIn)->trigger();
      const double zoom = find<CurveCanvas>("canvas")->zoom();
      const QPointF place = placeOf({0, 0});
      for (const PanelStage stage : kPanelStages) {
        window_->setStage(stage);
        ASSERT_TRUE(settleLayout());
        EXPECT_EQ(find<CurveCanvas>("canvas")->zoom(), zoom) << label(stage).toStdString() << ", " << isZoomed;
        EXPECT_EQ(placeOf({0, 0}), place) << label(stage).toStdString() << ", " << isZoomed;
      }
    }
  }
}

TEST_F(SameView, APinnedResultIsDrawnOnlyWhereCurvesAreCompared) {
  const QColor violet(132, 58, 186);
  constexpr std::array kOthers = {PanelStage::Edges, PanelStage::Corners, PanelStage::Export};
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  std::vector<int> before;
  for (const PanelStage stage : kOthers) {
    window_->setStage(stage);
    before.push_back(count(violet));
  }
  window_->setStage(PanelStage::Curves);
  EXPECT_EQ(count(violet), 0);
  session().pin();
  EXPECT_TRUE(waitUntil([&] { return count(violet) > 20; }, 5000));
  for (std::size_t i = 0; i < kOthers.size(); ++i) {
    window_->setStage(kOthers[i]);
    EXPECT_EQ(count(violet), before[i]) << label(kOthers[i]).toStdString();
  }
  window_->setStage(PanelStage::Fairing);
  EXPECT_TRUE(waitUntil([&] { return count(violet) > 20; }, 5000));
}

TEST_F(SameView, OneButtonOfAScreenHasTheAccent) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    QCoreApplication::processEvents();
    const auto buttons = window_->findChildren<QAbstractButton*>();
    const auto primary = std::ranges::count_if(
        buttons, [](const auto* one) { return one->isVisible() && one->property("primary").toBool(); });
    EXPECT_EQ(primary, 1) << label(stage).toStdString();
  }
}

TEST_F(SameView, NoBadgeLiesOverTheRegions) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage({900, 300})));
  window_->resize(1280, 860);
  window_->setStage(PanelStage::Threshold);
  ASSERT_TRUE(settleLayout());
  auto* canvas = find<CurveCanvas>("canvas");
  const QRect page(placeOf({0, 0}).toPoint(), placeOf({900, 300}).toPoint());
  ASSERT_GT(page.right(), canvas->width() - 60) << "the corner of the view lies on the page";
  const QImage before = canvas->grab().toImage();
  Recipe recipe = session().recipe();
  recipe.fairing.mode = FairingMode::Tolerance;
  recipe.fairing.toleranceMm = 0.31;
  session().change(QStringLiteral("Fairing"), recipe);
  session().cancel();
  ASSERT_TRUE(waitUntil([this] { return !session().isBusy(); }));
  if (!session().isStale(StageId::Faired)) return;  // the run was faster
  const QImage after = canvas->grab().toImage();
  EXPECT_NE(after, before) << "it is said that the work was stopped";
  EXPECT_EQ(after.copy(page), before.copy(page));
}

TEST_F(SameView, TheMarksOfTheDrawingHaveAKey) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  auto* button = find<QToolButton>("keyButton");
  ASSERT_TRUE(button->isVisible());
  QString said;
  QTimer::singleShot(200, [&] {
    if (auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())) {
      for (const auto* one : menu->findChildren<QWidget*>()) said += one->accessibleDescription();
      menu->close();
    }
  });
  QTest::mouseClick(button, Qt::LeftButton);
  for (const char* mark : {"Curvature extremum", "Inflection", "Marked corner", "Split", "Start and direction"})
    EXPECT_TRUE(said.contains(QString::fromLatin1(mark))) << mark;
}

TEST_F(SameView, NoSpecksAtTheUpperEdgeOfTheRadius) {
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  window_->setStage(PanelStage::Fairing);
  for (int i = 0; i < static_cast<int>(session().curves().size()); ++i) {
    session().selectCurve(i);
    ASSERT_TRUE(waitUntil([this] { return session().targets() && !session().isTargeting(); }));
    const PlotData data = plotData(session(), PlotTab::Radius);
    ASSERT_TRUE(data.logarithmic);
    const double edge = data.high * std::pow(data.low / data.high, 0.05);
    for (const PlotSeries& series : data.series) {
      const auto isSeen = [&](const PlotPoint& point) { return point.value < data.high; };
      for (auto from = series.points.begin(); from != series.points.end();) {
        from = std::find_if(from, series.points.end(), isSeen);
        const auto to = std::find_if_not(from, series.points.end(), isSeen);
        if (from != series.points.begin() && to != series.points.end()) {
          const auto lowest =
              std::min_element(from, to, [](const PlotPoint& a, const PlotPoint& b) { return a.value < b.value; });
          EXPECT_LT(lowest->value, edge) << curveName(session(), i).toStdString() << " at " << from->s << " mm";
        }
        from = to;
      }
    }
  }
}

/// As WCAG has it.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& colour) {
    const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Contrast, LinesOfTargetsAreSeenInBothThemes) {
  for (const Theme* theme : {&lightTheme(), &darkTheme()}) EXPECT_GE(contrast(theme->faint, theme->panel), 3.0);
}

}  // namespace
}  // namespace batten
