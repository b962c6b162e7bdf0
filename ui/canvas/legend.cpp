// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/legend.h"

#include <QCoreApplication>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "ui/canvas/layers/comb_layer.h"
#include "ui/canvas/layers/corner_layer.h"
#include "ui/canvas/layers/direction_layer.h"
#include "ui/canvas/layers/extremum_layer.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

constexpr int kKeyRowPx = 26, kMarkColumnPx = 40, kAroundPx = 8;

QString meaning(const char* text) { return QCoreApplication::translate("Legend", text); }

void paintTick(QPainter& painter, QPointF at) {
  painter.setPen(QPen(colors::target(), 1.4));
  for (const double side : {-1.0, 1.0}) painter.drawLine(at + QPointF(0.0, 3.0 * side), at + QPointF(0.0, 10.0 * side));
}

void paintArrow(QPainter& painter, QPointF at) { paintDirectionArrow(painter, at + QPointF(6, 0), QPointF(1, 0)); }

ExtremumMark extremum(bool isKept, bool isCertain, std::optional<bool> wantedToKeep = {}) {
  ExtremumMark mark;
  mark.isKept = isKept;
  mark.isCertain = isCertain;
  mark.wantedToKeep = wantedToKeep;
  return mark;
}

}  // namespace

Legend::Legend(QWidget* parent) : QWidget(parent) {
  const auto ofExtremum = [](const ExtremumMark& mark) {
    return [mark](QPainter& painter, QPointF at) { paintExtremum(painter, mark, at); };
  };
  rows_ = {{ofExtremum(extremum(true, true)), meaning("Curvature extremum")},
           {ofExtremum(extremum(true, false)), meaning("Curvature extremum little above the noise")},
           {ofExtremum(extremum(false, true)), meaning("Extremum rejected as noise")},
           {ofExtremum(extremum(true, true, true)), meaning("Extremum kept by you; crossed out: removed by you")},
           {paintInflection, meaning("Inflection")},
           {[](QPainter& painter, QPointF at) { paintCornerSquare(painter, at, 5.0, colors::corner(), false); },
            meaning("Marked corner")},
           {[](QPainter& painter, QPointF at) { paintFoundCorner(painter, at, 5.0, colors::corner()); },
            meaning("Certain corner, found without a mark")},
           {paintTick, meaning("Split: a span of the target ends here")},
           {paintArrow, meaning("Start and direction of the selected curve")}};
  QStringList all;
  for (const Row& row : rows_) all << row.meaning;
  setAccessibleName(meaning("Legend"));
  setAccessibleDescription(all.join(QStringLiteral("; ")));
}

QSize Legend::sizeHint() const {
  int widest = 0;
  for (const Row& row : rows_) widest = std::max(widest, fontMetrics().horizontalAdvance(row.meaning));
  return {kMarkColumnPx + widest + 2 * kAroundPx, kKeyRowPx * static_cast<int>(rows_.size()) + 2 * kAroundPx};
}

void Legend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  int y = kAroundPx;
  for (const Row& row : rows_) {
    row.paint(painter, QPointF(kMarkColumnPx / 2.0, y + kKeyRowPx / 2.0));
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRect(kMarkColumnPx, y, width() - kMarkColumnPx, kKeyRowPx), Qt::AlignVCenter | Qt::AlignLeft,
                     row.meaning);
    y += kKeyRowPx;
  }
}

}  // namespace batten
