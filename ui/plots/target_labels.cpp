// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/target_labels.h"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kSlots = 24;             // places along the shown stretch that are tried
constexpr double kApartPx = 18.0;      // between two numbers
constexpr double kFromCurvePx = 10.0;  // half the height of a number, and a little
constexpr double kFromEdgePx = 8.0;    // of the plot

bool isTarget(const PlotSeries& series) {
  return series.role == PlotRole::Target || series.role == PlotRole::ChosenTarget ||
         series.role == PlotRole::HoveredTarget;
}

}  // namespace

void TargetLabels::show(const PlotData& data) {
  for (const QPointer<QCPItemText>& text : texts_)
    if (text) plot_->removeItem(text);
  texts_.clear();
  lines_.clear();
  curves_.clear();
  const Theme& theme = themeOf(plot_->palette());
  for (const PlotSeries& series : data.series) {
    if ((series.role == PlotRole::Sketched || series.role == PlotRole::Faired) && series.s.size() > 1)
      curves_.push_back(series);
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

bool TargetLabels::placeOne(std::size_t line, bool clear, std::vector<QPointF>& taken) {
  const QCPRange shown = plot_->xAxis->range();
  const QRectF inside =
      QRectF(plot_->axisRect()->rect()).adjusted(kFromEdgePx, kFromEdgePx, -kFromEdgePx, -kFromEdgePx);
  // Each begins at a place of its own and looks on from there.
  const int first = (static_cast<int>(line) * kSlots / static_cast<int>(lines_.size()) + kSlots / 12) % kSlots;
  for (int k = 0; k < kSlots; ++k) {
    const double s = shown.lower + shown.size() * ((first + k) % kSlots + 0.5) / kSlots;
    const double value = lines_[line].at(s);
    const QPointF at(plot_->xAxis->coordToPixel(s), plot_->yAxis->coordToPixel(value));
    const auto isNear = [&](const QPointF& other) {
      return std::hypot(other.x() - at.x(), other.y() - at.y()) < kApartPx;
    };
    const auto isOnCurve = [&](const PlotSeries& curve) {
      return std::abs(plot_->yAxis->coordToPixel(curve.at(s)) - at.y()) < kFromCurvePx;
    };
    if (!std::isfinite(at.y()) || !inside.contains(at) || std::any_of(taken.begin(), taken.end(), isNear)) continue;
    if (clear && std::any_of(curves_.begin(), curves_.end(), isOnCurve)) continue;
    texts_[line]->position->setCoords(s, value);
    taken.push_back(at);
    return true;
  }
  return false;
}

void TargetLabels::place() {
  std::vector<QPointF> taken;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (texts_[i]) texts_[i]->setVisible(placeOne(i, true, taken) || placeOne(i, false, taken));
  }
}

}  // namespace batten
