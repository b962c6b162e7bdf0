// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/target_labels.h"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kSlots = 24;           // places along the shown stretch that are tried
constexpr double kApartPx = 18.0;    // between two numbers
constexpr double kFromEdgePx = 8.0;  // of the plot

bool isTarget(const PlotSeries& series) {
  return series.role == PlotRole::Target || series.role == PlotRole::ChosenTarget ||
         series.role == PlotRole::HoveredTarget;
}

double valueAt(const PlotSeries& series, double s) {
  const auto next = std::lower_bound(series.s.begin(), series.s.end(), s);
  if (next == series.s.begin()) return series.value.front();
  if (next == series.s.end()) return series.value.back();
  const auto i = static_cast<std::size_t>(next - series.s.begin());
  const double t = (s - series.s[i - 1]) / (series.s[i] - series.s[i - 1]);
  return series.value[i - 1] + t * (series.value[i] - series.value[i - 1]);
}

}  // namespace

void TargetLabels::show(const PlotData& data) {
  for (const QPointer<QCPItemText>& text : texts_)
    if (text) plot_->removeItem(text);
  texts_.clear();
  lines_.clear();
  const Theme& theme = themeOf(plot_->palette());
  for (const PlotSeries& series : data.series) {
    if (!isTarget(series) || series.s.size() < 2) continue;
    auto* text = new QCPItemText(plot_);
    text->setText(QString::number(series.degree));
    text->setObjectName(QStringLiteral("plot.target.%1").arg(series.degree));
    text->setFont(uiFont(11, series.role == PlotRole::Target ? QFont::Normal : QFont::Bold));
    text->setColor(series.role == PlotRole::ChosenTarget    ? theme.amber
                   : series.role == PlotRole::HoveredTarget ? theme.text
                                                            : theme.mute);
    text->setBrush(theme.panel);
    text->setPen(Qt::NoPen);
    text->setPadding(QMargins(2, 0, 2, 0));
    text->setPositionAlignment(Qt::AlignCenter);
    text->setSelectable(false);
    lines_.push_back(series);
    texts_.emplace_back(text);
  }
  place();
}

void TargetLabels::place() {
  const QCPRange shown = plot_->xAxis->range();
  const QRectF inside =
      QRectF(plot_->axisRect()->rect()).adjusted(kFromEdgePx, kFromEdgePx, -kFromEdgePx, -kFromEdgePx);
  std::vector<QPointF> taken;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!texts_[i]) continue;
    // Each begins at a place of its own and looks on from there.
    const int first = (static_cast<int>(i) * kSlots / static_cast<int>(lines_.size()) + kSlots / 12) % kSlots;
    bool found = false;
    for (int k = 0; k < kSlots && !found; ++k) {
      const double s = shown.lower + shown.size() * ((first + k) % kSlots + 0.5) / kSlots;
      const double value = valueAt(lines_[i], s);
      const QPointF at(plot_->xAxis->coordToPixel(s), plot_->yAxis->coordToPixel(value));
      const auto isNear = [&](const QPointF& other) {
        return std::hypot(other.x() - at.x(), other.y() - at.y()) < kApartPx;
      };
      if (!std::isfinite(at.y()) || !inside.contains(at) || std::any_of(taken.begin(), taken.end(), isNear)) continue;
      texts_[i]->position->setCoords(s, value);
      taken.push_back(at);
      found = true;
    }
    texts_[i]->setVisible(found);
  }
}

}  // namespace batten
