// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/knot_strip.h"

#include <QHelpEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/theme/theme.h"
#include "ui/theme/tool_tips.h"

namespace batten {
namespace {
constexpr double kSide = 8.0, kBase = 18.0;  // [px] left and right, and below for the text
}

std::vector<KnotStrip::Column> knotColumns(const std::vector<double>& knots) {
  std::vector<KnotStrip::Column> columns;
  for (const double knot : knots) {
    if (!columns.empty() && columns.back().value == knot)
      ++columns.back().times;
    else
      columns.push_back({knot, 1});
  }
  return columns;
}

KnotStrip::KnotStrip(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("knots.strip"));
  setAccessibleName(tr("Knot vector"));
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setMouseTracking(true);
}

void KnotStrip::setKnots(const std::vector<double>& knots) {
  columns_ = knotColumns(knots);
  setAccessibleDescription(tr("%1 knots, %2 different values").arg(knots.size()).arg(columns_.size()));
  update();
}

double KnotStrip::xOf(std::size_t column) const {
  if (columns_.size() < 2) return 0.5 * width();
  return kSide + (width() - 2.0 * kSide) * static_cast<double>(column) / static_cast<double>(columns_.size() - 1);
}

void KnotStrip::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double base = height() - kBase;
  painter.fillRect(QRectF(kSide, base + 4, width() - 2.0 * kSide, 1), theme.line);
  if (columns_.empty()) return;
  const double pitch = columns_.size() > 1 ? xOf(1) - xOf(0) : 20.0;
  const double radius = std::clamp(0.38 * pitch, 0.7, 2.6);
  const double rise = 7.0;
  painter.setPen(Qt::NoPen);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool isEnd = i == 0 || i + 1 == columns_.size();
    painter.setBrush(columns_[i].times > 1 && !isEnd ? QColor(201, 60, 16)
                     : columns_[i].times > 1         ? theme.text
                                                     : theme.mute);
    for (int k = 0; k < columns_[i].times; ++k)
      painter.drawEllipse(QPointF(xOf(i), base - k * rise), std::max(radius, columns_[i].times > 1 ? 1.8 : 0.0),
                          std::max(radius, columns_[i].times > 1 ? 1.8 : 0.0));
  }
  painter.setFont(uiFont(11));
  painter.setPen(theme.mute);
  double free = 0.0;  // left of this, numbers stand already
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].times < 2) continue;
    const QString text = QString::number(columns_[i].value, 'g', 6);
    const double w = painter.fontMetrics().horizontalAdvance(text);
    const double x = std::clamp(xOf(i) - 0.5 * w, 0.0, width() - w);
    if (x < free) continue;
    painter.drawText(QRectF(x, base + 5, w + 1, kBase - 5), Qt::AlignCenter, text);
    free = x + w + 5.0;
  }
}

bool KnotStrip::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && !columns_.empty()) {
    const auto* help = static_cast<QHelpEvent*>(event);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < columns_.size(); ++i)
      if (std::abs(xOf(i) - help->pos().x()) < std::abs(xOf(nearest) - help->pos().x())) nearest = i;
    const Column& column = columns_[nearest];
    showToolTip(help->globalPos(),
                column.times > 1 ? tr("Knot %1, %2 times").arg(column.value).arg(column.times)
                                 : tr("Knot %1").arg(column.value),
                this);
    return true;
  }
  return QWidget::event(event);
}

}  // namespace batten
