// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/region_histogram.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <functional>

#include "ui/theme/theme.h"

namespace batten {

RegionHistogram::RegionHistogram(QWidget* parent) : QWidget(parent) {
  setFixedHeight(112);
  setFocusPolicy(Qt::StrongFocus);
  setObjectName(QStringLiteral("threshold.histogram"));
  setAccessibleName(tr("Histogram of the region with its threshold"));
  setToolTip(
      tr("Histogram of the grey levels of this region, dark on the left. Drag the line or use the "
         "arrow keys: everything darker is ink."));
}

void RegionHistogram::show(const std::array<std::uint32_t, 256>& counts, double threshold) {
  counts_ = counts;
  threshold_ = threshold;
  hasData_ = true;
  setCursor(Qt::SizeHorCursor);
  setAccessibleDescription(tr("Threshold %1").arg(threshold, 0, 'f', 0));
  update();
}

void RegionHistogram::clear() {
  hasData_ = false;
  unsetCursor();
  update();
}

QRectF RegionHistogram::plot() const { return QRectF(6, 4, width() - 12, height() - 22); }

void RegionHistogram::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme.line, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(QRectF(0.5, 0.5, width() - 1, height() - 1), 5, 5);
  if (hasFocus()) drawFocusRing(painter, rect(), 5, theme);
  const QRectF box = plot();
  painter.setFont(uiFont(11));
  if (!hasData_) {
    painter.setPen(theme.mute);
    painter.drawText(rect(), Qt::AlignCenter, tr("No region selected"));
    return;
  }
  // The square root keeps thin ink visible beside the mountain of paper; paper of a single grey is cut off.
  auto sorted = counts_;
  std::nth_element(sorted.begin(), sorted.begin() + 1, sorted.end(), std::greater<>());
  const double top = std::sqrt(double(std::max<std::uint32_t>(1, sorted[1])));
  const auto shape = [&](int from, int to) {
    QPainterPath path;
    const double step = box.width() / 256.0;
    path.moveTo(box.left() + from * step, box.bottom());
    for (int i = from; i < to; ++i) {
      const double h = std::min(1.0, std::sqrt(double(counts_[i])) / top) * box.height();
      path.lineTo(box.left() + i * step, box.bottom() - h);
      path.lineTo(box.left() + (i + 1) * step, box.bottom() - h);
    }
    path.lineTo(box.left() + to * step, box.bottom());
    path.closeSubpath();
    return path;
  };
  const int cut = std::clamp(static_cast<int>(std::lround(threshold_)), 0, 256);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.text);
  painter.drawPath(shape(0, cut));
  QColor pale = theme.mute;
  pale.setAlphaF(0.45F);
  painter.setBrush(pale);
  painter.drawPath(shape(cut, 256));
  const double x = box.left() + threshold_ / 256.0 * box.width();
  painter.setPen(QPen(theme.accent, 1.6));
  painter.drawLine(QPointF(x, 2), QPointF(x, box.bottom() + 2));
  painter.setBrush(theme.accent);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(QPointF(x, box.bottom() + 2), 3.5, 3.5);
  painter.setPen(theme.mute);
  const QRectF axis(box.left(), box.bottom() + 2, box.width(), 16);
  painter.drawText(axis, Qt::AlignLeft | Qt::AlignVCenter, tr("ink"));
  painter.drawText(axis, Qt::AlignRight | Qt::AlignVCenter, tr("paper"));
}

void RegionHistogram::moveTo(double x) {
  const QRectF box = plot();
  const double grey = std::clamp(std::round((x - box.left()) / box.width() * 256.0), 0.0, 255.0);
  if (grey == threshold_) return;
  threshold_ = grey;
  update();
  emit thresholdMoved(grey);
}

void RegionHistogram::mousePressEvent(QMouseEvent* event) {
  if (!hasData_ || event->button() != Qt::LeftButton) return;
  dragging_ = true;
  emit dragStarted();
  moveTo(event->position().x());
}

void RegionHistogram::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_) moveTo(event->position().x());
}

void RegionHistogram::mouseReleaseEvent(QMouseEvent*) { dragging_ = false; }

void RegionHistogram::keyPressEvent(QKeyEvent* event) {
  const int step = event->modifiers() & Qt::ShiftModifier ? 10 : 1;
  int move = 0;
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Down) move = -step;
  if (event->key() == Qt::Key_Right || event->key() == Qt::Key_Up) move = step;
  if (move == 0 || !hasData_) return QWidget::keyPressEvent(event);
  if (!event->isAutoRepeat()) emit dragStarted();
  threshold_ = std::clamp(std::round(threshold_) + move, 0.0, 255.0);
  update();
  emit thresholdMoved(threshold_);
}

}  // namespace batten
