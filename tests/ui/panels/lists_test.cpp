// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QPainterPath>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/column_delegate.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/stages/fairing_figures.h"

namespace batten {
namespace {

using test::waitUntil;

class Lists : public test::WindowFixture {};

TEST_F(Lists, TheListOfCornersSaysWhatIsRounded) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.cornerMarks = {{{200, 100}}, {{400, 300}}};
  recipe.cornerMarks[0].roundMm = 1.5;
  session().change(QStringLiteral("Marks"), recipe);
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Corners);
  auto* list = find<QListWidget>("corners.list");
  ASSERT_EQ(list->count(), 2);
  EXPECT_TRUE(list->item(0)->text().contains(QStringLiteral("rounded 1.5"))) << list->item(0)->text().toStdString();
  EXPECT_FALSE(list->item(1)->text().contains(QStringLiteral("rounded")));
  recipe.cornerMarks[0].roundBy = RoundingSize::Radius;
  session().change(QStringLiteral("Marks"), recipe);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(list->item(0)->text().contains(QStringLiteral("rounded R 1.5"))) << list->item(0)->text().toStdString();
}

TEST_F(Lists, TheNumbersInTheListOfCornersStandBelowEachOther) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Corners);
  Recipe recipe = session().recipe();
  for (int i = 0; i < 11; ++i) recipe.cornerMarks.push_back({{9.0 + 40 * i, 99.5 - 9 * i}});
  session().change(QStringLiteral("Marks"), recipe);
  ASSERT_TRUE(settle());
  auto* list = find<QListWidget>("corners.list");
  ASSERT_EQ(list->count(), 11);
  const auto* columns = dynamic_cast<const ColumnDelegate*>(list->itemDelegate());
  ASSERT_NE(columns, nullptr);
  const QFontMetrics metrics(list->item(0)->font());
  const QRect row(0, 0, list->viewport()->width(), 22);
  for (int i = 0; i < list->count(); ++i) {
    const QStringList parts = list->item(i)->text().split(u'\t');
    int right = 0;
    for (int c = 0; c < parts.size(); ++c) {
      const QRect box = columns->columnRect(row, c);
      EXPECT_GE(box.left(), right) << i << " " << c;
      EXPECT_LE(metrics.horizontalAdvance(parts[c]), box.width()) << parts[c].toStdString();
      EXPECT_LE(box.right(), row.right());
      right = box.right();
    }
  }
  // As painted: the last ink of the numbers 9 and 10 is at the same place.
  list->scrollToBottom();
  const QImage all = list->viewport()->grab().toImage();
  const auto lastInk = [&](int item) {
    const QRect at = list->visualItemRect(list->item(item));
    const QRect box = columns->columnRect(at, 0);
    const QRgb paper = all.pixel(box.right() + 6, at.center().y());
    int last = 0;
    for (int x = box.left(); x <= box.right() + 3; ++x)
      for (int y = at.top() + 3; y < at.bottom() - 3; ++y)
        if (qGray(all.pixel(x, y)) != qGray(paper)) last = x;
    return last;
  };
  EXPECT_NEAR(lastInk(8), lastInk(9), 1);
}

TEST_F(Lists, TheListOfCurvesUsesTheRoomThereIs) {
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    for (int i = 0; i < 24; ++i) painter.drawLine(20 + 25 * i, 60, 24 + 25 * i, 340);
  }));
  ASSERT_EQ(session().curves().size(), 24u);
  session().selectCurve(3);
  for (const PanelStage stage : {PanelStage::Fairing, PanelStage::Curves}) {
    window_->setStage(stage);
    auto* list = find<QWidget>(("panel." + key(stage).toStdString()).c_str())->findChild<CurveList*>();
    ASSERT_NE(list, nullptr);
    ASSERT_TRUE(settleLayout());
    EXPECT_EQ(list->verticalScrollBar()->value(), 0) << "the row selected is among the first ten";
    const int row = list->sizeHintForRow(0);
    window_->resize(1366, 700);
    ASSERT_TRUE(waitUntil([&] { return window_->height() == 700; }, 5000));
    ASSERT_TRUE(settleLayout());
    EXPECT_GE(list->height(), 10 * row);
    EXPECT_LT(list->height(), 11 * row) << "a low panel scrolls as a whole";
    // What is below a low window is reached by scrolling.
    auto* scroll = qobject_cast<QScrollArea*>(list->parentWidget()->parentWidget()->parentWidget());
    ASSERT_NE(scroll, nullptr);
    EXPECT_GT(scroll->verticalScrollBar()->maximum(), 0);
    window_->resize(1366, 2000);
    ASSERT_TRUE(waitUntil([&] { return list->height() >= 24 * row; }, 5000)) << list->height() / row;
    EXPECT_EQ(scroll->verticalScrollBar()->maximum(), 0);
    EXPECT_LT(list->height(), 25 * row) << "no longer than its curves";
  }
  // So does the list of what is exported.
  window_->setStage(PanelStage::Export);
  find<QComboBox>("export.choice")->setFocus();
  QTest::keyClick(find<QComboBox>("export.choice"), Qt::Key_End);
  auto* ticks = find<QListWidget>("export.list");
  ASSERT_TRUE(waitUntil([&] { return ticks->isVisible() && ticks->count() == 24; }));
  const int line = ticks->sizeHintForRow(0);
  EXPECT_TRUE(waitUntil([&] { return ticks->height() >= 24 * line; }, 5000)) << ticks->height() / line;
  const int gap = find<QWidget>("export.all")->mapTo(window_.get(), QPoint(0, 0)).y() -
                  ticks->mapTo(window_.get(), QPoint(0, ticks->height())).y();
  EXPECT_LT(gap, 20) << "what is below follows at once";
  window_->resize(1366, 700);
  ASSERT_TRUE(waitUntil([&] { return window_->height() == 700; }, 5000));
  EXPECT_TRUE(waitUntil([&] { return ticks->height() < 9 * line; }, 5000)) << ticks->height() / line;
}

TEST_F(Lists, TheListOfCurvesStaysUnderTheMouseThatClicksIt) {
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.drawLine(40, 40, 600, 60);
    painter.drawEllipse(60, 100, 220, 160);
    QPainterPath wave({320, 300});
    wave.cubicTo({400, 100}, {500, 500}, {610, 150});
    painter.drawPath(wave);
  }));
  window_->setStage(PanelStage::Fairing);
  QTest::mouseClick(find<QAbstractButton>("fairing.mode.tolerance"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  auto* list = find<QWidget>("panel.fairing")->findChild<CurveList*>();
  ASSERT_EQ(list->count(), 3);
  std::set<int> places;
  std::set<bool> isSaid;
  for (int row = 0; row < list->count(); ++row) {
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(row)).center());
    ASSERT_TRUE(settle());
    ASSERT_EQ(session().selectedCurve(), row);
    ASSERT_TRUE(waitUntil([this] { return !session().isTargeting(); }));
    ASSERT_TRUE(settleLayout());
    places.insert(list->mapTo(window_.get(), QPoint(0, 0)).y());
    isSaid.insert(!fairingNote(*session().selected()).text.isEmpty());
  }
  EXPECT_EQ(isSaid.size(), 2u) << "of one curve something is said, of another nothing";
  EXPECT_EQ(places.size(), 1u);
}

TEST_F(Lists, NothingJumpsWhenATargetNeedsMoreTolerance) {
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    QPainterPath wave({40, 300});
    wave.cubicTo({200, 20}, {400, 600}, {600, 60});
    painter.drawPath(wave);
  }));
  window_->resize(1366, 768);
  window_->setStage(PanelStage::Fairing);
  QTest::mouseClick(find<QAbstractButton>("fairing.mode.target"), Qt::LeftButton);
  type(find<QLineEdit>("fairing.tolerance.field"), QStringLiteral("0.03"));
  session().selectCurve(0);
  ASSERT_TRUE(settle());
  std::set<int> places;
  std::set<bool> isRaised;
  for (int degree = 1; degree <= 6; ++degree) {
    auto* tile = find<QAbstractButton>(QStringLiteral("target.%1").arg(degree).toLatin1().constData());
    ASSERT_TRUE(waitUntil([&] { return !session().isTargeting() && tile->isEnabled(); }));
    QTest::mouseClick(tile, Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_TRUE(settleLayout());
    places.insert(find<QWidget>("fairing.compare")->mapTo(window_.get(), QPoint(0, 0)).y());
    isRaised.insert(find<QWidget>("fairing.raise")->isVisible());
  }
  EXPECT_EQ(isRaised.size(), 2u) << *isRaised.begin() << ": one target needs more, another does not";
  EXPECT_EQ(places.size(), 1u);
}
}  // namespace
}  // namespace batten
