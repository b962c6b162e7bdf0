// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/lines_note.h"

#include <QFrame>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScreen>
#include <QTextLayout>
#include <QVBoxLayout>
#include <algorithm>

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

void LinesNote::setText(const QString& text) {
  QLabel::setText(text);
  findCut();
}

void LinesNote::setLines(int lines) {
  if (lines == lines_) return;
  lines_ = lines;
  setFixedHeight(roomFor(lines));
  findCut();
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
      const bool fits = fontMetrics().horizontalAdvance(rest) <= width();
      const int room = width() - (fits ? 0 : fontMetrics().horizontalAdvance(moreText()));
      shown << fontMetrics().elidedText(rest, Qt::ElideRight, room);
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
  showToolTip(static_cast<QHelpEvent*>(event)->globalPos(), isCut() ? text() : QString(), this);
  return true;
}

void LinesNote::findCut() {
  const QStringList shown = shownLines();
  const bool was = isCut_;
  isCut_ = !shown.isEmpty() && shown.last().endsWith(QChar(0x2026)) && !text().endsWith(QChar(0x2026));
  if (isCut_ == was) return;
  // As from a widget that is disabled: the next one has the keyboard.
  if (!isCut_ && hasFocus()) focusNextChild();
  setFocusPolicy(isCut_ ? Qt::TabFocus : Qt::NoFocus);
  setCursor(isCut_ ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void LinesNote::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) findCut();
}

void LinesNote::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  findCut();
}

QString LinesNote::moreText() const { return QLatin1Char(' ') + tr("more"); }

void LinesNote::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && isCut()) return showWhole();
  QLabel::mouseReleaseEvent(event);
}

void LinesNote::keyPressEvent(QKeyEvent* event) {
  const bool isPressed =
      event->key() == Qt::Key_Space || event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (isPressed && isCut()) return showWhole();
  QLabel::keyPressEvent(event);
}

// Over the note, so that it is read on from where the eye is, but within the screen. A click elsewhere or Esc closes
// it.
void LinesNote::showWhole() {
  constexpr int kMarginPx = 10;
  auto* frame = new QFrame(this, Qt::Popup);
  frame->setObjectName(QStringLiteral("note.whole"));
  frame->setAttribute(Qt::WA_DeleteOnClose);
  frame->setFrameStyle(QFrame::Box | QFrame::Plain);
  auto* whole = new QLabel(text(), frame);
  whole->setFont(font());
  whole->setTextFormat(Qt::PlainText);
  whole->setWordWrap(true);
  whole->setFixedWidth(width());
  auto* layout = new QVBoxLayout(frame);
  layout->setContentsMargins(kMarginPx, kMarginPx, kMarginPx, kMarginPx);
  layout->addWidget(whole);
  frame->setAccessibleName(text());
  frame->adjustSize();
  const int edge = kMarginPx + frame->frameWidth();
  const QRect room = screen()->availableGeometry();
  QRect box(mapToGlobal(QPoint(-edge, -edge)), frame->size());
  box.moveBottomRight({std::min(box.right(), room.right()), std::min(box.bottom(), room.bottom())});
  box.moveTopLeft({std::max(box.left(), room.left()), std::max(box.top(), room.top())});
  frame->move(box.topLeft());
  frame->show();
  frame->setFocus(Qt::PopupFocusReason);
}

void LinesNote::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setPen(palette().color(foregroundRole()));
  const QStringList shown = shownLines();
  int y = 0;
  for (const QString& line : shown) {
    painter.drawText(QRect(0, y, width(), fontMetrics().lineSpacing()), Qt::AlignLeft | Qt::AlignTop, line);
    y += fontMetrics().lineSpacing();
  }
  if (!isCut_) return;
  const int top = y - fontMetrics().lineSpacing(), left = fontMetrics().horizontalAdvance(shown.last());
  painter.setPen(theme.accent);
  painter.drawText(QRect(left, top, width() - left, fontMetrics().lineSpacing()), Qt::AlignLeft | Qt::AlignTop,
                   moreText());
  if (hasFocus()) drawFocusRing(painter, rect(), 3, theme);
}

void keepRoom(QWidget* widget) {
  QSizePolicy policy = widget->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  widget->setSizePolicy(policy);
}

}  // namespace batten
