// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/shape_view.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "core/document/report_pages/figure.h"
#include "ui/theme/minus_sign.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kMostTicks = 5;     // of an axis
constexpr double kApartPx = 6.0;  // between numbers and axis
constexpr double kTickPx = 3.0;

QString plain(double value) { return withMinusSign(QString::number(value, 'g', 3)); }

void divideByMeanSize(std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  const double size = std::sqrt(sum / static_cast<double>(std::max<std::ptrdiff_t>(1, std::ssize(values))));
  for (double& v : values) v = size > 0.0 ? v / size : 0.0;
}

// The multiples of a round step from `low` to `high`.
std::vector<double> ticksBetween(double low, double high) {
  const double step = roundStep(high - low, kMostTicks);
  std::vector<double> all;
  for (auto i = static_cast<long>(std::ceil(low / step - 1e-9)); static_cast<double>(i) * step <= high + 1e-9 * step;
       ++i)
    all.push_back(static_cast<double>(i) * step);
  return all;
}

}  // namespace

void ShapeView::show(const ShapeComparison& comparison, bool isRadius) {
  isRadius_ = isRadius;
  first_ = isRadius ? comparison.first.radius : comparison.first.curvature;
  second_ = isRadius ? comparison.second.radius : comparison.second.curvature;
  divideByMeanSize(first_);
  divideByMeanSize(second_);
  range_ = rangeOfBoth();
  setAccessibleName(isRadius ? tr("Radius over arc length") : tr("Curvature over arc length"));
  setAccessibleDescription(isEmpty() ? QString()
                                     : tr("From %1 to %2 times the mean.").arg(plain(range_.low), plain(range_.high)));
  update();
}

ShapeView::Range ShapeView::rangeOfBoth() const {
  Range found{0.0, 0.0};
  for (const auto* values : {&first_, &second_}) {
    if (values->empty()) continue;
    std::vector<double> sorted = *values;
    std::sort(sorted.begin(), sorted.end());
    // One spike must not flatten the rest.
    const auto spikes = std::ssize(sorted) / 50;
    found.low = std::min(found.low, *(sorted.begin() + spikes));
    found.high = std::max(found.high, *(sorted.rbegin() + spikes));
  }
  if (found.high - found.low < 1e-12) found.high = found.low + 1.0;
  return found;
}

void ShapeView::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QFontMetricsF metrics(painter.font());
  const auto [low, high] = range_;
  const std::vector<double> levels = ticksBetween(low, high);
  double numbersPx = 0.0;
  for (const double level : levels) numbersPx = std::max(numbersPx, metrics.horizontalAdvance(plain(level)));
  // Above stands what the numbers are, below the arc length.
  const double linePx = metrics.height();
  const QRectF box = QRectF(rect()).adjusted(numbersPx + kApartPx, linePx + kApartPx, -metrics.averageCharWidth() * 2,
                                             -linePx - kApartPx);
  const auto yOf = [&, low = low, high = high](double v) {
    return box.bottom() - std::clamp((v - low) / (high - low), -0.03, 1.03) * box.height();
  };
  painter.setPen(QPen(theme.line, 1));
  for (const double level : levels) painter.drawLine(QPointF(box.left(), yOf(level)), QPointF(box.right(), yOf(level)));
  painter.drawLine(box.bottomLeft(), box.bottomRight());
  painter.setPen(theme.mute);
  painter.drawText(QRectF(rect().left(), 0, rect().width(), linePx), Qt::AlignLeft | Qt::AlignVCenter,
                   isRadius_ ? tr("radius ÷ its mean (rms)") : tr("curvature ÷ its mean (rms)"));
  for (const double level : levels)
    painter.drawText(QRectF(0, yOf(level) - 0.5 * linePx, numbersPx, linePx), Qt::AlignRight | Qt::AlignVCenter,
                     plain(level));
  for (const int percent : {0, 25, 50, 75, 100}) {
    const double x = box.left() + percent / 100.0 * box.width();
    painter.drawLine(QPointF(x, box.bottom()), QPointF(x, box.bottom() + kTickPx));
    const QString text = percent == 100 ? tr("100 %") : QString::number(percent);
    const double wide = metrics.horizontalAdvance(text);
    painter.drawText(QPointF(std::min(x - 0.5 * wide, rect().right() - wide), rect().bottom() - metrics.descent()),
                     text);
  }
  if (isEmpty()) return;
  const auto draw = [&](const std::vector<double>& values, const QPen& pen) {
    QPolygonF line;
    const double step = box.width() / static_cast<double>(values.size() - 1);
    double x = box.left(), before = 0.0;
    painter.setPen(pen);
    for (const double value : values) {
      // At an inflection the radius leaves on one side of infinity and comes back on the other.
      if (isRadius_ && before * value < 0.0) {
        painter.drawPolyline(line);
        line.clear();
      }
      line << QPointF(x, yOf(value));
      x += step;
      before = value;
    }
    painter.drawPolyline(line);
  };
  draw(first_, QPen(theme.accent, 2));
  draw(second_, QPen(theme.amber, 1.6, Qt::DashLine));
}

}  // namespace batten
