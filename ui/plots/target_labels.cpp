// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/target_labels.h"

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ui/plots/plot_style.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kSlots = 24;             // places along the shown stretch that are tried
constexpr double kApartPx = 18.0;      // between two numbers
constexpr double kFromCurvePx = 10.0;  // half the height of a number, and a little
constexpr double kFromOthersPx = 4.0;  // from the lines of other targets: so that it is seen on which one it stands
constexpr double kLookPx = 3.0;        // between the places of a line that are looked at
constexpr double kFromEdgePx = 8.0;    // of the plot
/// Up and down: where a number may stand beside its line, in the order in which places are tried.
constexpr std::array kBesidePx = {0.0, -13.0, 13.0, -22.0, 22.0, -32.0, 32.0};
/// Of kFromCurvePx: nearer than that a number lies on a curve.
constexpr double kOffCurve = 0.8;

bool isTarget(const PlotSeries& series) {
  return series.role == PlotRole::Target || series.role == PlotRole::ChosenTarget ||
         series.role == PlotRole::HoveredTarget;
}

}  // namespace

void TargetLabels::show(const PlotData& data) {
  for (const Label& label : labels_) {
    if (label.text) plot_->removeItem(label.text);
    if (label.leader) plot_->removeItem(label.leader);
  }
  labels_.clear();
  lines_.clear();
  curves_.clear();
  const Theme& theme = themeOf(plot_->palette());
  for (const PlotSeries& series : data.series) {
    if ((series.role == PlotRole::Sketched || series.role == PlotRole::Faired) && series.points.size() > 1)
      curves_.push_back(series);
    if (!isTarget(series) || !series.degree || series.points.size() < 2) continue;
    auto* leader = new QCPItemLine(plot_);  // below the number
    auto* text = new QCPItemText(plot_);
    leader->setObjectName(QStringLiteral("plot.target.%1.leader").arg(*series.degree));
    leader->setPen(QPen(penOf(series.role, theme, series.degree).color(), 1));
    leader->setSelectable(false);
    text->setText(QString::number(*series.degree));
    text->setObjectName(QStringLiteral("plot.target.%1").arg(*series.degree));
    text->setFont(uiFont(11, series.role == PlotRole::Target ? QFont::Normal : QFont::Bold));
    text->setColor(penOf(series.role, theme, series.degree).color());
    text->setBrush(theme.panel);
    text->setPen(Qt::NoPen);
    text->setPadding(QMargins(2, 0, 2, 0));
    text->setPositionAlignment(Qt::AlignCenter);
    text->setSelectable(false);
    lines_.push_back(series);
    labels_.push_back({text, leader});
  }
  place();
}

/// How far a line passes by a place, looked at as far around it as a number reaches.
double TargetLabels::passesBy(const PlotSeries& line, const QPointF& place) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<double> before;
  for (double dx = -kFromCurvePx; dx <= kFromCurvePx; dx += kLookPx) {
    const double dy = plot_->yAxis->coordToPixel(line.at(plot_->xAxis->pixelToCoord(place.x() + dx))) - place.y();
    // A steep line passes between two places that are both far away.
    const bool isCrossed = before && (*before < 0.0) != (dy < 0.0);
    nearest = std::min(nearest, isCrossed ? std::abs(dx) : std::hypot(dx, dy));
    before = dy;
  }
  return nearest;
}

void TargetLabels::placeOne(std::size_t line, std::vector<QPointF>& taken) {
  const QCPRange shown = plot_->xAxis->range();
  const QRectF inside =
      QRectF(plot_->axisRect()->rect()).adjusted(kFromEdgePx, kFromEdgePx, -kFromEdgePx, -kFromEdgePx);
  // Each begins at a place of its own and looks on from there for one that is clear, or as clear as there is; on its
  // line, or else beside it, but never on a curve.
  const int first = (static_cast<int>(line) * kSlots / static_cast<int>(lines_.size()) + kSlots / 12) % kSlots;
  double best = 0.0;
  std::optional<QPointF> found;
  double foundBeside = 0.0;
  for (const double beside : kBesidePx) {
    if (found) break;
    for (int k = 0; k < kSlots && best < 1.0; ++k) {
      const double s = shown.lower + shown.size() * ((first + k) % kSlots + 0.5) / kSlots;
      const QPointF at(plot_->xAxis->coordToPixel(s), plot_->yAxis->coordToPixel(lines_[line].at(s)) + beside);
      const auto isNear = [&](const QPointF& other) {
        return std::hypot(other.x() - at.x(), other.y() - at.y()) < kApartPx;
      };
      if (!std::isfinite(at.y()) || !inside.contains(at) || std::any_of(taken.begin(), taken.end(), isNear)) continue;
      double clear = 1.0;
      for (const PlotSeries& curve : curves_) clear = std::min(clear, passesBy(curve, at) / kFromCurvePx);
      if (clear < kOffCurve) continue;
      for (std::size_t other = 0; other < lines_.size(); ++other)
        if (other != line) clear = std::min(clear, passesBy(lines_[other], at) / kFromOthersPx);
      if (found && clear <= best) continue;
      best = clear;
      found = at;
      foundBeside = beside;
    }
  }
  const Label& label = labels_[line];
  label.text->setVisible(found.has_value());
  label.leader->setVisible(found && foundBeside != 0.0);
  if (!found) return;
  const auto moveTo = [this](QCPItemPosition* position, const QPointF& px) {
    position->setCoords(plot_->xAxis->pixelToCoord(px.x()), plot_->yAxis->pixelToCoord(px.y()));
  };
  moveTo(label.text->position, *found);
  moveTo(label.leader->start, *found);
  moveTo(label.leader->end, *found - QPointF(0.0, foundBeside));
  taken.push_back(*found);
}

void TargetLabels::place() {
  std::vector<QPointF> taken;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (labels_[i].text && labels_[i].leader) placeOne(i, taken);
  }
}

}  // namespace batten
