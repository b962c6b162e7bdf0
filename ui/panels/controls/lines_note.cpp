// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/lines_note.h"

#include <QHelpEvent>
#include <QPainter>
#include <QTextLayout>

#include "ui/theme/theme.h"
#include "ui/theme/tool_tips.h"

namespace batten {

LinesNote::LinesNote(int lines, QWidget* parent) : QLabel(parent), lines_(lines) {
  setFont(uiFont(12));
  setForegroundRole(QPalette::PlaceholderText);
  setTextFormat(Qt::PlainText);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  setFixedHeight(roomFor(lines));
}

void LinesNote::setLines(int lines) {
  if (lines == lines_) return;
  lines_ = lines;
  setFixedHeight(roomFor(lines));
  update();
}

int LinesNote::roomFor(int lines) const { return lines * fontMetrics().lineSpacing(); }

QStringList LinesNote::shownLines() const {
  QStringList shown;
  qsizetype begin = 0;  // of the paragraph
  for (const QString& paragraph : text().split(QLatin1Char('\n'))) {
    QTextLayout layout(paragraph, font());
    layout.beginLayout();
    for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
      line.setLineWidth(width());
      if (shown.size() + 1 < lines_) {
        shown << paragraph.mid(line.textStart(), line.textLength()).trimmed();
        continue;
      }
      // The last line takes all that is left, and is cut where it has to be.
      const QString rest = text().mid(begin + line.textStart()).simplified();
      shown << fontMetrics().elidedText(rest, Qt::ElideRight, width());
      layout.endLayout();
      return shown;
    }
    layout.endLayout();
    begin += paragraph.size() + 1;
  }
  return shown;
}

bool LinesNote::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || !toolTip().isEmpty()) return QLabel::event(event);
  const QStringList shown = shownLines();
  const bool isCut = !shown.isEmpty() && shown.last().endsWith(QChar(0x2026)) && !text().endsWith(QChar(0x2026));
  showToolTip(static_cast<QHelpEvent*>(event)->globalPos(), isCut ? text() : QString(), this);
  return true;
}

void LinesNote::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(palette().color(foregroundRole()));
  int y = 0;
  for (const QString& line : shownLines()) {
    painter.drawText(QRect(0, y, width(), fontMetrics().lineSpacing()), Qt::AlignLeft | Qt::AlignTop, line);
    y += fontMetrics().lineSpacing();
  }
}

void keepRoom(QWidget* widget) {
  QSizePolicy policy = widget->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  widget->setSizePolicy(policy);
}

}  // namespace batten
