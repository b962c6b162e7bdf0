// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing that may be clicked moves when something else is clicked.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPainterPath>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {
namespace {

using test::waitUntil;

/// Lines that bend both ways, one with a right angle, and a closed one.
QImage variedPage() {
  return test::drawnPage({640, 400}, [](QPainter& painter) {
    QPainterPath wave({40, 320});
    wave.cubicTo({200, 120}, {400, 460}, {600, 230});
    painter.drawPath(wave);
    QPainterPath angle({60, 60});
    angle.lineTo(260, 70);
    angle.lineTo(250, 190);
    painter.drawPath(angle);
    painter.drawEllipse(360, 40, 220, 130);
  });
}

class Jumps : public test::WindowFixture, public testing::WithParamInterface<QSize> {
 protected:
  QWidget* panel(PanelStage stage) { return find<QWidget>(("panel." + key(stage).toStdString()).c_str()); }
  bool settleAll() {
    return settle() && waitUntil([this] { return !session().isWorking(); }) && settleLayout();
  }
  void enter(PanelStage stage) {
    window_->setStage(stage);
    ASSERT_TRUE(settleAll());
  }
  /// Where on the screen what can be clicked in the panel stands, by name.
  std::map<std::string, QPoint> places(PanelStage stage) {
    EXPECT_TRUE(settleAll());
    std::map<std::string, QPoint> all;
    for (const auto* one : panel(stage)->findChildren<QWidget*>()) {
      const bool isControl = qobject_cast<const QAbstractButton*>(one) || qobject_cast<const QLineEdit*>(one) ||
                             qobject_cast<const QSlider*>(one) || qobject_cast<const QAbstractItemView*>(one);
      if (isControl && one->isVisible() && !one->objectName().isEmpty())
        all[one->objectName().toStdString()] = one->mapTo(window_.get(), QPoint(0, 0));
    }
    return all;
  }
  void click(const char* name) {
    auto* button = find<QAbstractButton>(name);
    ASSERT_TRUE(button->isVisible() && button->isEnabled()) << name;
    QTest::mouseClick(button, Qt::LeftButton);
  }
  void clickRow(PanelStage stage, int row) {
    auto* list = panel(stage)->findChild<CurveList*>();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(row)).center());
    ASSERT_TRUE(settleAll());
    ASSERT_EQ(session().selectedCurve(), row);
  }
  /// @param isLooked at the place of what has this name: not at what belongs to the thing that is clicked
  void expectStill(
      PanelStage stage, const std::string& what, const std::function<void()>& act,
      const std::function<bool(const std::string&)>& isLooked = [](const std::string&) { return true; }) {
    const auto before = places(stage);
    ASSERT_NO_FATAL_FAILURE(act());
    const auto after = places(stage);
    int compared = 0;
    for (const auto& [name, at] : after) {
      const auto was = before.find(name);
      if (was == before.end() || !isLooked(name)) continue;
      ++compared;
      EXPECT_EQ(at, was->second) << name << " moved by " << at.y() - was->second.y() << " px: " << what;
    }
    EXPECT_GT(compared, 3) << what;
  }
};

TEST_P(Jumps, NothingMovesInFairing) {
  ASSERT_NO_FATAL_FAILURE(openPage(variedPage()));
  window_->resize(GetParam());
  constexpr PanelStage kStage = PanelStage::Fairing;
  ASSERT_NO_FATAL_FAILURE(enter(kStage));
  for (const char* mode : {"fairing.mode.tolerance", "fairing.mode.target", "fairing.mode.monotone",
                           "fairing.mode.lowpass", "fairing.mode.none", "fairing.mode.tolerance"})
    ASSERT_NO_FATAL_FAILURE(expectStill(kStage, mode, [&] { click(mode); }));
  // A curve with a target of its own among curves that are smoothed.
  ASSERT_NO_FATAL_FAILURE(clickRow(kStage, 0));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "scope", [&] { click("fairing.scope.one"); }));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "its own target", [&] { click("fairing.mode.target"); }));
  for (const int row : {1, 0, 2, 0})
    ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "row " + std::to_string(row), [&] { clickRow(kStage, row); }));
  for (const char* link : {"fairing.logAesthetic", "fairing.draw", "fairing.forget"})
    ASSERT_NO_FATAL_FAILURE(expectStill(kStage, link, [&] { click(link); }));
  // Much is said of a target that cannot be followed.
  ASSERT_NO_FATAL_FAILURE(expectStill(
      kStage, "a small tolerance", [&] { type(find<QLineEdit>("fairing.tolerance.field"), QStringLiteral("0.01")); }));
}

TEST_P(Jumps, NothingAboveTheirSettingsMovesWithTheMethods) {
  ASSERT_NO_FATAL_FAILURE(openPage(variedPage()));
  window_->resize(GetParam());
  constexpr PanelStage kStage = PanelStage::Curves;
  ASSERT_NO_FATAL_FAILURE(enter(kStage));
  // The settings of a method stand below the list, and change with it.
  const auto isAbove = [](const std::string& name) {
    return name.starts_with("construct.method.") || name.starts_with("curves.list") || name.starts_with("pin.") ||
           name.starts_with("curves.paper");
  };
  for (const char* method : {"nurbs", "bezier", "typical", "control-polygon", "fair"}) {
    const std::string name = std::string("construct.method.") + method;
    ASSERT_NO_FATAL_FAILURE(expectStill(
        kStage, method, [&] { click(name.c_str()); }, isAbove));
  }
  ASSERT_NO_FATAL_FAILURE(expectStill(
      kStage, "pin", [&] { click("pin.set"); }, isAbove));
  for (const int row : {1, 0, 2})
    ASSERT_NO_FATAL_FAILURE(expectStill(
        kStage, "row " + std::to_string(row), [&] { clickRow(kStage, row); }, isAbove));
}

TEST_P(Jumps, NothingMovesInCorners) {
  start_.corners.automatic = true;
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openPage(variedPage()));
  window_->resize(GetParam());
  constexpr PanelStage kStage = PanelStage::Corners;
  ASSERT_NO_FATAL_FAILURE(enter(kStage));
  const auto& corners = session().output().pieces->corners;
  const auto found = std::ranges::find_if(corners, [](const Corner& one) { return !one.mark; });
  ASSERT_NE(found, corners.end());
  const Vec2 at = found->positionPx;
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "exclude a certain corner", [&] { clickCanvas(at); }));
  ASSERT_EQ(session().recipe().refusedCornersPx.size(), 1u);
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "restore", [&] { click("corners.restore"); }));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "no certain corners", [&] {
    Recipe after = session().recipe();
    after.corners.automatic = false;
    session().change(QStringLiteral("Corners"), after);
  }));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "mark a corner", [&] { clickCanvas(at); }));
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  session().selectCorner(0);
  ASSERT_NO_FATAL_FAILURE(
      expectStill(kStage, "round it", [&] { type(find<QLineEdit>("corners.rounding"), QStringLiteral("2")); }));
}

TEST_P(Jumps, NothingMovesInEdges) {
  ASSERT_NO_FATAL_FAILURE(openPage(variedPage()));
  window_->resize(GetParam());
  constexpr PanelStage kStage = PanelStage::Edges;
  session().selectCurve({});
  ASSERT_NO_FATAL_FAILURE(enter(kStage));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "select a line", [&] { session().selectCurve(0); }));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "another line", [&] { session().selectCurve(1); }));
  for (const char* button : {"edges.paint", "edges.tool.lines", "edges.pair", "edges.tool.select"})
    ASSERT_NO_FATAL_FAILURE(expectStill(kStage, button, [&] { click(button); }));
}

TEST_P(Jumps, NothingMovesInExport) {
  ASSERT_NO_FATAL_FAILURE(openPage(variedPage()));
  window_->resize(GetParam());
  constexpr PanelStage kStage = PanelStage::Export;
  ASSERT_NO_FATAL_FAILURE(enter(kStage));
  type(find<QLineEdit>("export.path"), folder_.filePath(QStringLiteral("out")));
  ASSERT_NO_FATAL_FAILURE(expectStill(kStage, "export", [&] {
    click("export.run");
    auto* result = find<QLabel>("export.result");
    ASSERT_TRUE(waitUntil([&] { return result->text().startsWith(QStringLiteral("Wrote")); }));
  }));
}

INSTANTIATE_TEST_SUITE_P(Sizes, Jumps, testing::Values(QSize(1366, 768), QSize(1920, 1080)),
                         [](const testing::TestParamInfo<QSize>& size) {
                           return "At" + std::to_string(size.param.width()) + "x" + std::to_string(size.param.height());
                         });

}  // namespace
}  // namespace batten
