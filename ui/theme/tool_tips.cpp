// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/tool_tips.h"

#include <QAbstractItemView>
#include <QFontMetrics>
#include <QHelpEvent>
#include <QStringList>
#include <QTextDocument>
#include <QToolTip>

namespace batten {
namespace {

constexpr int kLinePx = 340;  ///< About fifty letters: the eye finds the next line.

QString tipAt(QWidget* widget, const QPoint& position) {
  const auto* view = qobject_cast<QAbstractItemView*>(widget->parentWidget());
  if (view && view->viewport() == widget) {
    const QString ofRow = view->indexAt(position).data(Qt::ToolTipRole).toString();
    return ofRow.isEmpty() ? view->toolTip() : ofRow;
  }
  return widget->toolTip();
}

}  // namespace

QString inLines(const QString& text, const QFontMetrics& metrics, int widthPx) {
  QStringList lines;
  for (const QString& paragraph : text.split(u'\n')) {
    QString line;
    for (const QString& word : paragraph.split(u' ')) {
      const QString longer = line.isEmpty() ? word : line + u' ' + word;
      if (!line.isEmpty() && metrics.horizontalAdvance(longer) > widthPx) {
        lines << line;
        line = word;
      } else {
        line = longer;
      }
    }
    lines << line;
  }
  return lines.join(u'\n');
}

void showToolTip(const QPoint& globalPosition, const QString& text, QWidget* of) {
  QToolTip::showText(globalPosition, inLines(text, QFontMetrics(QToolTip::font()), kLinePx), of);
}

bool ToolTipLines::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ToolTip || !watched->isWidgetType()) return false;
  auto* widget = static_cast<QWidget*>(watched);
  const auto* help = static_cast<QHelpEvent*>(event);
  const QString text = tipAt(widget, help->pos());
  if (text.isEmpty() || Qt::mightBeRichText(text)) return false;
  showToolTip(help->globalPos(), text, widget);
  return true;
}

}  // namespace batten
