// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>
#include <QPainter>

namespace batten {

/// A list whose height does not depend on its entries, so that what stands below it stays where it is while entries
/// come and go. Empty, it says what will be in it.
class HintList : public QListWidget {
 public:
  /// @param rows how many entries are seen without scrolling.
  HintList(const QString& hint, int rows, QWidget* parent) : QListWidget(parent), hint_(hint) {
    setFixedHeight(rows * kRowPx + 2 * frameWidth());
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  }
  /// As many more rows as the layout has room for: for the last of a panel, below which nothing moves.
  void useRoomBelow() {
    setMaximumHeight(QWIDGETSIZE_MAX);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QListWidget::paintEvent(event);
    if (count() > 0) return;
    QPainter painter(viewport());
    painter.setPen(palette().color(QPalette::PlaceholderText));
    QRect box = viewport()->rect().adjusted(8, 4, -8, -4);
    box.setHeight(minimumHeight());
    painter.drawText(box, Qt::AlignCenter | Qt::TextWordWrap, hint_);
  }

 private:
  static constexpr int kRowPx = 22;  // height
  QString hint_;
};

}  // namespace batten
