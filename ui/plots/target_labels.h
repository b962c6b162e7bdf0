// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointF>
#include <QPointer>
#include <vector>

#include "ui/plots/plot_series.h"

class QCPItemLine;
class QCPItemText;
class QCustomPlot;

namespace batten {

/// The numbers of the six targets on their lines in a plot, each where its line is inside the plot and clear of the
/// other numbers, and as clear of the curves and of the other targets as there is a place. One that stands beside its
/// line is led to it. They follow the stretch that is shown.
class TargetLabels {
 public:
  explicit TargetLabels(QCustomPlot* plot) : plot_(plot) {}
  /// New lines. @pre the axes have their ranges.
  void show(const PlotData& data);
  /// The axes show another stretch.
  void place();

 private:
  QCustomPlot* plot_;
  struct Label {
    QPointer<QCPItemText> text;
    QPointer<QCPItemLine> leader;
  };
  void placeOne(std::size_t line, std::vector<QPointF>& taken);
  double passesBy(const PlotSeries& line, const QPointF& place) const;
  std::vector<PlotSeries> lines_, curves_;
  std::vector<Label> labels_;
};

}  // namespace batten
