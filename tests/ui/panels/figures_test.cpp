// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that take a moment come when they are known; the window waits for none of them.
#include <gtest/gtest.h>

#include <QPainter>

#include "core/pipeline/run/stroke_widths.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"

namespace batten {
namespace {

using test::waitUntil;

class Figures : public test::WindowFixture {
 protected:
  /// What stands in the row of the stroke's width; empty where there is none.
  QString width() {
    for (const auto* table : find<QWidget>("panel.curves")->findChildren<FigureTable*>())
      for (const FigureTable::Row& row : table->rows())
        if (row.name == QStringLiteral("Stroke width")) return row.cells.front().text;
    return {};
  }
  /// From the run's own outputs.
  QString measured() {
    const TracedCurve& curve = *session().selected();
    const auto widths = strokeWidthsAlong(session().output(), *session().scan(), curve, curve.sketched);
    if (!widths) return {};
    const WidthFigures of = figuresOf(*widths);
    return QStringLiteral("%1 mm (%2 to %3)")
        .arg(of.mean, 0, 'f', 2)
        .arg(of.least, 0, 'f', 2)
        .arg(of.largest, 0, 'f', 2);
  }
};

const QString kPending = QStringLiteral("…");

TEST_F(Figures, TheWidthOfAStrokeIsMeasuredInTheBackground) {
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    for (const int width : {4, 8, 12}) {
      QPen pen = painter.pen();
      pen.setWidth(width);
      painter.setPen(pen);
      painter.drawLine(40, 30 * width, 600, 30 * width + 10);
    }
  }));
  window_->setStage(PanelStage::Curves);
  ASSERT_EQ(session().curves().size(), 3u);
  QStringList seen;
  for (const int curve : {0, 1, 2}) {
    session().selectCurve(std::nullopt);
    session().selectCurve(curve);
    EXPECT_EQ(width(), kPending) << "nothing is measured before the next event";
    ASSERT_TRUE(waitUntil([&] { return width() != kPending; }));
    EXPECT_EQ(width(), measured());
    seen << width();
  }
  EXPECT_EQ(QSet<QString>(seen.begin(), seen.end()).size(), 3) << seen.join(u'|').toStdString();
  // The newest one wins.
  session().selectCurve(0);
  session().selectCurve(1);
  ASSERT_TRUE(waitUntil([&] { return width() != kPending; }));
  EXPECT_EQ(width(), seen[1]);
  // After a change it is that of the new curve.
  changeSomething();
  ASSERT_TRUE(waitUntil([&] { return width() != kPending; }));
  EXPECT_EQ(width(), measured());
}

TEST_F(Figures, WhatHasNoWidthHasNoRow) {
  openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
    painter.setBrush(Qt::black);
    painter.drawEllipse(120, 60, 400, 280);
  }));
  window_->setStage(PanelStage::Curves);
  EXPECT_EQ(width(), QString()) << "an outline";
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Export);
  session().selectCurve(std::nullopt);
  session().selectCurve(0);
  window_->setStage(PanelStage::Curves);
  ASSERT_TRUE(waitUntil([&] { return width() != kPending; }));
  EXPECT_EQ(width(), measured());
}

}  // namespace
}  // namespace batten
