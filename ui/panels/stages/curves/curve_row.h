// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

#include "ui/panels/stages/curves/curve_list.h"

namespace batten {

/// Paints a row of the list of curves: the eye, the name, a sign of warning, the badge of fairness, the figures.
class CurveRow : public QStyledItemDelegate {
 public:
  /// What an item holds for its row.
  enum Role {
    IncludedRole = Qt::UserRole,
    FiguresRole,
    WarnsRole,
    BadgeRole = CurveList::kBadgeRole,
    SimilarityRole,
    OwnTipRole,
    OwnTextRole,
    ExtremaRole,  ///< The figures in columns of their own; empty where there are none.
    PointsRole,
    SameRole,
    ShapeRole
  };
  static constexpr int kHeight = 26;                     // px
  static constexpr int kEyeWidth = 26;                   // [px] At the left.
  static constexpr int kIconSize = 14;                   // px
  static constexpr int kRightMargin = 6;                 // px
  static constexpr int kBadgeWidth = 52, kBadgeGap = 6;  // px

  explicit CurveRow(CurveList& list);
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override;
  void paint(QPainter*, const QStyleOptionViewItem&, const QModelIndex&) const override;

 private:
  /// In columns, so that numbers stand below each other.
  void paintFigures(QPainter&, const QRectF& box, const QModelIndex&) const;

  CurveList& list_;
};

}  // namespace batten
