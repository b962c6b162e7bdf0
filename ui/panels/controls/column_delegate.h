// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <QStyledItemDelegate>
#include <vector>

class QListWidget;

namespace batten {

/// Paints the texts of a list in columns, so that numbers stand below each other: the parts of an item's text between
/// tabs. Each column is as wide as its longest part in the whole list; a last one that begins at the left goes on to
/// the edge.
class ColumnDelegate : public QStyledItemDelegate {
 public:
  /// @param alignments of the columns, from left to right.
  ColumnDelegate(std::vector<Qt::Alignment> alignments, QListWidget& list);
  /// To be called when the list has been filled.
  void measure();
  /// Where a part of a text stands in a row.
  QRect columnRect(const QRect& row, int column) const;
  void paint(QPainter*, const QStyleOptionViewItem&, const QModelIndex&) const override;

  /// The text of an item.
  static QString joined(const QStringList& parts);
  /// As it is read aloud.
  static QString spoken(const QStringList& parts);

 private:
  std::vector<Qt::Alignment> alignments_;
  std::vector<int> widths_;  ///< [px]
  QListWidget& list_;
};

}  // namespace batten
