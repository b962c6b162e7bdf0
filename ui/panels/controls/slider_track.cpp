// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/slider_track.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include "ui/theme/theme.h"

namespace batten {
namespace {
constexpr double kKnobRadius = 6.0;  // px
}

SliderTrack::SliderTrack(QWidget* parent) : QSlider(Qt::Horizontal, parent) {
  setRange(0, kSteps);
  setSingleStep(kSteps / 100);
  setPageStep(kSteps / 10);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
}

void SliderTrack::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double y = height() / 2.0;
  const double left = kKnobRadius + 1, right = width() - kKnobRadius - 1;
  const double share = maximum() > minimum() ? double(value() - minimum()) / (maximum() - minimum()) : 0.0;
  const double x = left + share * (right - left);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.line);
  painter.drawRoundedRect(QRectF(1, y - 2, width() - 2, 4), 2, 2);
  const QColor live = isEnabled() ? theme.accent : theme.mute;
  painter.setBrush(live);
  painter.drawRoundedRect(QRectF(1, y - 2, x - 1, 4), 2, 2);
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    QColor ring = theme.accent;
    ring.setAlpha(90);
    painter.setPen(QPen(ring, 3));
    painter.drawEllipse(QPointF(x, y), kKnobRadius + 0.5, kKnobRadius + 0.5);
  }
  painter.setPen(QPen(live, 2));
  painter.setBrush(theme.panel);
  painter.drawEllipse(QPointF(x, y), kKnobRadius - 0.5, kKnobRadius - 0.5);
}

int SliderTrack::valueAt(double x) const {
  const double left = kKnobRadius + 1, right = width() - kKnobRadius - 1;
  const double share = right > left ? (x - left) / (right - left) : 0.0;
  return minimum() + qRound(qBound(0.0, share, 1.0) * (maximum() - minimum()));
}

void SliderTrack::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  setSliderDown(true);
  setSliderPosition(valueAt(event->position().x()));
  event->accept();
}

void SliderTrack::mouseMoveEvent(QMouseEvent* event) {
  if (isSliderDown()) setSliderPosition(valueAt(event->position().x()));
}

void SliderTrack::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) setSliderDown(false);
}

void SliderTrack::wheelEvent(QWheelEvent* event) {
  // A page that scrolls under the mouse must not change values by the way.
  if (!hasFocus()) return event->ignore();
  QSlider::wheelEvent(event);
}

}  // namespace batten
