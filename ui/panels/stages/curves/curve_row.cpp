// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/curve_row.h"

#include <QPainter>

#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kBadgeHeight = 18;  // px

/// Of M: fair, nearly so, or far from it.
QColor fairnessColour(double similarity, const Theme& theme) {
  constexpr double kFairSimilarity = 0.99, kNearlyFair = 0.95;  // from here on
  return similarity >= kFairSimilarity ? theme.good : similarity >= kNearlyFair ? theme.mute : theme.amber;
}

void paintBadge(QPainter& painter, const QRectF& box, const QString& text, const QColor& colour) {
  painter.setPen(QPen(colour, 1.2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(box, kBadgeHeight / 2.0, kBadgeHeight / 2.0);
  painter.setFont(uiFont(11));
  painter.drawText(box, Qt::AlignCenter, text);
}

QRect rowIconBox(const QStyleOptionViewItem& option, int x) {
  const int size = CurveRow::kIconSize;
  return {option.rect.left() + x, option.rect.top() + (CurveRow::kHeight - size) / 2, size, size};
}

}  // namespace

CurveRow::CurveRow(CurveList& list) : QStyledItemDelegate(&list), list_(list) {}

QSize CurveRow::sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const { return {120, kHeight}; }

void CurveRow::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const Theme& theme = themeOf(option.palette);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(option.rect).adjusted(0, 1, 0, -1);
  if (option.state & (QStyle::State_Selected | QStyle::State_MouseOver)) {
    painter->setPen(Qt::NoPen);
    painter->setBrush(option.state & QStyle::State_Selected ? theme.selection : theme.hover);
    painter->drawRoundedRect(box, 5, 5);
  }
  if (option.state & QStyle::State_HasFocus) drawFocusRing(*painter, box, 5, theme);
  const bool included = index.data(IncludedRole).toBool();
  const QIcon eye = themedIcon(included ? QStringLiteral("eye") : QStringLiteral("eye-off"), option.palette);
  eye.paint(painter, rowIconBox(option, 6));
  painter->setFont(uiFont(12));
  painter->setPen(included ? theme.text : theme.mute);
  const QString badge = index.data(BadgeRole).toString();
  const QString name = list_.shownName(index.row());
  painter->drawText(box.adjusted(kEyeWidth, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, name);
  if (index.data(WarnsRole).toBool()) {
    const int after = kEyeWidth + painter->fontMetrics().horizontalAdvance(name) + 6;
    themedIcon(QStringLiteral("warning"), option.palette).paint(painter, rowIconBox(option, after));
  }
  painter->setPen(theme.mute);
  paintFigures(*painter, box.adjusted(0, 0, -kRightMargin, 0), index);
  if (!badge.isEmpty()) {
    const double right = box.right() - kRightMargin - list_.columns().figures() - kBadgeGap;
    paintBadge(*painter, {right - kBadgeWidth, box.center().y() - kBadgeHeight / 2.0, kBadgeWidth, kBadgeHeight}, badge,
               fairnessColour(index.data(SimilarityRole).toDouble(), theme));
  }
  painter->restore();
}

void CurveRow::paintFigures(QPainter& painter, const QRectF& box, const QModelIndex& index) const {
  const CurveList::Columns& columns = list_.columns();
  const QString extrema = index.data(ExtremaRole).toString();
  if (extrema.isEmpty())
    return painter.drawText(box, Qt::AlignVCenter | Qt::AlignRight, index.data(FiguresRole).toString());
  if (columns.hasPoints) painter.drawText(box, Qt::AlignVCenter | Qt::AlignRight, index.data(PointsRole).toString());
  painter.drawText(box.adjusted(0, 0, -columns.points, 0), Qt::AlignVCenter | Qt::AlignRight, extrema);
  if (index.data(SameRole).toBool())
    painter.drawText(box.adjusted(box.width() - columns.figures(), 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft,
                     QStringLiteral("="));
}

}  // namespace batten
