// SPDX-License-Identifier: GPL-3.0-or-later
// Inks are picked on the drawing.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QPainter>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>

#include "tests/ui/window_fixture.h"
#include "ui/session/edits/ink_edits.h"

namespace batten {
namespace {

using test::waitUntil;

class InkPicking : public test::WindowFixture {
 protected:
  void openInks() {
    QImage page(480, 400, QImage::Format_RGB32);
    page.fill(QColor(250, 247, 240));
    QPainter painter(&page);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto line = [&](const QColor& ink, const QPointF& a, const QPointF& b) {
      painter.setPen(QPen(ink, 5.0));
      painter.drawLine(a, b);
    };
    line(QColor(25, 25, 25), {60, 80}, {420, 100});
    line(QColor(210, 30, 40), {60, 200}, {420, 180});
    line(QColor(40, 70, 190), {60, 300}, {420, 330});
    painter.end();
    ASSERT_NO_FATAL_FAILURE(openPage(page));
    ASSERT_EQ(session().curves().size(), 3u);
    window_->setStage(PanelStage::Scan);
    pick_ = find<QAbstractButton>("scan.pickInk");
    ASSERT_TRUE(pick_ && pick_->isVisible());
  }
  const InkChoice& inks() { return session().recipe().preparation.inks; }
  void clickInk(const Vec2& px, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QCoreApplication::processEvents();
    auto* canvas = find<CurveCanvas>("canvas");
    const QPoint at = canvas->toWidget(px).toPoint();
    const int step = session().undoStack()->index();
    QTest::mouseMove(canvas, at);
    QTest::mouseClick(canvas, Qt::LeftButton, modifiers, at);
    ASSERT_TRUE(waitUntil([&] { return session().undoStack()->index() == step + 1; }));
    ASSERT_TRUE(settle());
  }
  QAbstractButton* pick_ = nullptr;
  static constexpr double kRedHue = 357.0, kBlueHue = 228.0, kNearDeg = 15.0;
};

TEST_F(InkPicking, AClickExcludesAnInkAndASecondTracesItAgain) {
  ASSERT_NO_FATAL_FAILURE(openInks());
  QTest::mouseClick(pick_, Qt::LeftButton);
  EXPECT_EQ(window_->view().tool(), Tool::Ink);
  // Beside the line, within a few pixels of the screen; at once after the tool was chosen.
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 193}));
  ASSERT_EQ(inks().drop.size(), 1u);
  EXPECT_TRUE(isSameInk(inks().drop[0], {kRedHue}, kNearDeg)) << *inks().drop[0].hueDeg;
  EXPECT_EQ(session().curves().size(), 2u);
  // Its button in the panel says so, too.
  const auto& found = session().output().page->inks;
  int checked = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    checked += find<QAbstractButton>(qPrintable(QStringLiteral("scan.ink%1").arg(i)))->isChecked() ? 1 : 0;
  EXPECT_EQ(checked, 2);
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 190}));
  EXPECT_TRUE(inks().isAll());
  EXPECT_EQ(session().curves().size(), 3u);
  window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(settle());
  EXPECT_EQ(inks().drop.size(), 1u);
}

TEST_F(InkPicking, ShiftClickTracesOneAlone) {
  ASSERT_NO_FATAL_FAILURE(openInks());
  window_->action(ActionId::ToolInk)->trigger();
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 315}, Qt::ShiftModifier));
  ASSERT_EQ(inks().keep.size(), 1u);
  EXPECT_TRUE(isSameInk(inks().keep[0], {kBlueHue}, kNearDeg)) << *inks().keep[0].hueDeg;
  EXPECT_EQ(session().curves().size(), 1u);
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 90}));  // black is traced besides
  EXPECT_EQ(session().curves().size(), 2u);
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 90}, Qt::ShiftModifier));
  EXPECT_TRUE(isOnlyInk(session(), InkColour{}));
  EXPECT_EQ(session().curves().size(), 1u);
  ASSERT_NO_FATAL_FAILURE(clickInk({240, 90}, Qt::ShiftModifier));
  EXPECT_TRUE(inks().isAll());
  EXPECT_EQ(session().curves().size(), 3u);
}

TEST(InkNames, AreThoseOfTheirHues) {
  EXPECT_EQ(inkName({0.0}), QStringLiteral("Red"));
  EXPECT_EQ(inkName({60.0}), QStringLiteral("Yellow"));
  EXPECT_EQ(inkName({120.0}), QStringLiteral("Green"));
  for (const double blue : {205.0, 228.0, 240.0, 250.0}) EXPECT_EQ(inkName({blue}), QStringLiteral("Blue")) << blue;
  EXPECT_EQ(inkName({300.0}), QStringLiteral("Magenta"));
  EXPECT_EQ(inkName({359.9}), QStringLiteral("Red"));
  EXPECT_EQ(inkName({}), QStringLiteral("Black and grey"));
}

TEST_F(InkPicking, OnPaperNothingHappensAndAGreyScanHasNoInks) {
  ASSERT_NO_FATAL_FAILURE(openInks());
  window_->action(ActionId::ToolInk)->trigger();
  auto* canvas = find<CurveCanvas>("canvas");
  const Recipe before = session().recipe();
  clickCanvas({240, 250});
  // What lies under the mouse is named once the paper's colour is known, after the click that waited for it.
  QSignalSpy hints(canvas, &CurveCanvas::hint);
  QTest::mouseMove(canvas, canvas->toWidget({240, 315}).toPoint());
  EXPECT_TRUE(waitUntil([&] {
    return std::any_of(hints.begin(), hints.end(),
                       [](const auto& one) { return one.at(0).toString().startsWith(QStringLiteral("Blue")); });
  }));
  EXPECT_EQ(session().recipe(), before);
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  window_->setStage(PanelStage::Scan);
  EXPECT_FALSE(pick_->isVisible());
}

}  // namespace
}  // namespace batten
