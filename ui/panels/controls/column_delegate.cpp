// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/column_delegate.h"

#include <QApplication>
#include <QListWidget>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kBeforePx = 6;    ///< Left of the first column.
constexpr int kBetweenPx = 10;  // Two columns.
constexpr QChar kTab = u'\t';   // Between the texts of two columns.

QFont rowFont() { return uiFont(12); }

/// As wide as a text of so many digits can be: a list is measured without a look at the shape of each number.
QString widest(QString text) {
  for (QChar& c : text)
    if (c.isDigit()) c = u'0';
  return text;
}

}  // namespace

ColumnDelegate::ColumnDelegate(std::vector<Qt::Alignment> alignments, QListWidget& list)
    : QStyledItemDelegate(&list), alignments_(std::move(alignments)), widths_(alignments_.size(), 0), list_(list) {}

QString ColumnDelegate::joined(const QStringList& parts) { return parts.join(kTab); }

QString ColumnDelegate::spoken(const QStringList& parts) {
  QStringList said = parts;
  said.removeAll(QString());
  return said.join(QStringLiteral(", "));
}

void ColumnDelegate::measure() {
  std::vector<QString> longest(alignments_.size());
  for (int row = 0; row < list_.count(); ++row) {
    const QStringList parts = list_.item(row)->text().split(kTab);
    for (int c = 0; c < std::ssize(longest) && c < parts.size(); ++c)
      if (parts[c].size() > longest[c].size()) longest[c] = parts[c];
  }
  const QFontMetrics metrics(rowFont());
  for (int c = 0; c < std::ssize(longest); ++c) widths_[c] = metrics.horizontalAdvance(widest(longest[c]));
  list_.viewport()->update();
}

QRect ColumnDelegate::columnRect(const QRect& row, int column) const {
  int left = row.left() + kBeforePx;
  for (int c = 0; c < column; ++c) left += widths_[c] + (widths_[c] > 0 ? kBetweenPx : 0);
  const bool isLastOfRow = column + 1 == std::ssize(widths_) && alignments_[column] == Qt::AlignLeft;
  return {left, row.top(), isLastOfRow ? row.right() - left : widths_[column], row.height()};
}

void ColumnDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QStyleOptionViewItem row = option;
  initStyleOption(&row, index);
  row.text.clear();
  const QWidget* view = option.widget;
  (view ? view->style() : QApplication::style())->drawControl(QStyle::CE_ItemViewItem, &row, painter, view);
  painter->save();
  painter->setFont(rowFont());
  const bool isSelected = row.state.testFlag(QStyle::State_Selected);
  painter->setPen(row.palette.color(isSelected ? QPalette::HighlightedText : QPalette::Text));
  const QStringList parts = index.data(Qt::DisplayRole).toString().split(kTab);
  for (int c = 0; c < std::ssize(alignments_) && c < parts.size(); ++c) {
    const QRect box = columnRect(option.rect, c);
    const bool isLastOfRow = c + 1 == std::ssize(alignments_);
    // Digits of one number may be wider than the zeros that were measured: there is room up to the end of the row.
    const int room = option.rect.right() - box.left();
    painter->drawText(box, Qt::AlignVCenter | alignments_[c] | Qt::TextDontClip,
                      isLastOfRow ? painter->fontMetrics().elidedText(parts[c], Qt::ElideRight, room) : parts[c]);
  }
  painter->restore();
}

}  // namespace batten
