// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLineEdit>
#include <QPainter>
#include <QStyleOptionFrame>

namespace batten {

/// A field for a path: while nobody types in it, the beginning and the name show, and what does not fit is left out
/// between them.
class PathEdit : public QLineEdit {
 public:
  using QLineEdit::QLineEdit;

 protected:
  void paintEvent(QPaintEvent* event) override {
    constexpr int kMargin = 3;  // [px] left and right of the text
    QStyleOptionFrame option;
    initStyleOption(&option);
    const QRect box =
        style()->subElementRect(QStyle::SE_LineEditContents, &option, this).adjusted(kMargin, 0, -kMargin, 0);
    if (hasFocus() || fontMetrics().horizontalAdvance(text()) <= box.width()) return QLineEdit::paintEvent(event);
    QPainter painter(this);
    style()->drawPrimitive(QStyle::PE_PanelLineEdit, &option, &painter, this);
    painter.setPen(palette().color(isEnabled() ? QPalette::Normal : QPalette::Disabled, QPalette::Text));
    painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(text(), Qt::ElideLeft, box.width()));
  }
};

}  // namespace batten
