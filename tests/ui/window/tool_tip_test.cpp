// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QFontMetrics>
#include <QHelpEvent>
#include <QTextDocument>
#include <QToolTip>
#include <algorithm>

#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/theme/tool_tips.h"

namespace batten {
namespace {

constexpr int kReadableDots = 400;  // [px] of a line

class ToolTips : public test::WindowFixture {
 protected:
  /// What is shown when the mouse rests there.
  static QString shownAt(QWidget* widget, const QPoint& at) {
    QToolTip::hideText();
    QHelpEvent help(QEvent::ToolTip, at, widget->mapToGlobal(at));
    QCoreApplication::sendEvent(widget, &help);
    return QToolTip::text();
  }
  static int widest(const QString& text) {
    int width = 0;
    for (const QString& line : text.split(u'\n'))
      width = std::max(width, QFontMetrics(QToolTip::font()).horizontalAdvance(line));
    return width;
  }
  /// The same words, whatever the lines.
  static QString words(const QString& text) { return text.simplified(); }
};

TEST_F(ToolTips, LinesBreakAtBlanksAndKeepTheirOwnBreaks) {
  const QFontMetrics metrics(QToolTip::font());
  const QString text = QStringLiteral("one two three four\nfive averyveryveryverylongwordindeed six");
  const int width = metrics.horizontalAdvance(QStringLiteral("one two three"));
  const QString lines = inLines(text, metrics, width);
  EXPECT_EQ(words(lines), words(text));
  EXPECT_TRUE(lines.contains(QStringLiteral("four\nfive"))) << lines.toStdString();
  for (const QString& line : lines.split(u'\n'))
    EXPECT_TRUE(metrics.horizontalAdvance(line) <= width || !line.contains(u' ')) << line.toStdString();
  EXPECT_EQ(inLines(QStringLiteral("short"), metrics, width), QStringLiteral("short"));
  EXPECT_EQ(inLines({}, metrics, width), QString());
}

TEST_F(ToolTips, NoneRunsAcrossTheWindow) {
  openPage(test::zigzagPage());
  int longOnes = 0;
  for (const PanelStage stage : kPanelStages) {
    window_->setStage(stage);
    for (QWidget* widget : window_->findChildren<QWidget*>()) {
      if (!widget->isVisible() || widget->toolTip().isEmpty() || Qt::mightBeRichText(widget->toolTip())) continue;
      if (widget->inherits("QAbstractItemView")) continue;  // its viewport is what the mouse is over
      const QString shown = shownAt(widget, widget->rect().center());
      EXPECT_EQ(words(shown), words(widget->toolTip())) << widget->objectName().toStdString();
      EXPECT_LE(widest(shown), kReadableDots) << shown.toStdString();
      longOnes += widest(widget->toolTip()) > kReadableDots ? 1 : 0;
    }
  }
  EXPECT_GT(longOnes, 10) << "there is something to break";
}

TEST_F(ToolTips, RowsOfListsAndFiguresAreBrokenToo) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  auto* list = find<QWidget>("panel.curves")->findChild<CurveList*>();
  ASSERT_GT(list->count(), 0);
  list->item(0)->setToolTip(QStringLiteral("A sentence on a row of a list. ").repeated(12).trimmed());
  const QString ofRow = shownAt(list->viewport(), list->visualItemRect(list->item(0)).center());
  EXPECT_EQ(words(ofRow), words(list->item(0)->toolTip()));
  EXPECT_LE(widest(ofRow), kReadableDots);
  auto* table = find<QWidget>("panel.curves")->findChild<FigureTable*>();
  const QString ofFigure = shownAt(table, {20, 5});
  EXPECT_EQ(words(ofFigure), words(table->rows().front().help));
  EXPECT_LE(widest(ofFigure), kReadableDots);
}

}  // namespace
}  // namespace batten
