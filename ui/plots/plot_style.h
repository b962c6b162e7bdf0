// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <qcustomplot.h>

#include <QPen>

#include "ui/plots/plot_series.h"
#include "ui/theme/theme.h"

namespace batten {

/// What the plot of deviations follows from.
struct DataKey {
  std::shared_ptr<const FairedSet> faired;
  std::shared_ptr<const PieceSet> pieces;
  int curve;
  PlotTab tab;
  bool operator==(const DataKey&) const = default;
};

QPen penOf(PlotRole role, const Theme& theme);
/// What the numbers of a plot are: "R, mm".
QString quantityText(PlotTab tab);

/// Ticks at round numbers that stand apart on a logarithmic axis, however short its range.
class RoundLogTicker : public QCPAxisTicker {
 protected:
  QVector<double> createTickVector(double tickStep, const QCPRange& range) override;
  QVector<double> createSubTickVector(int, const QVector<double>&) override { return {}; }
  QString getTickLabel(double tick, const QLocale&, QChar, int) override;
};

/// Begin, middle and end of the shown length, the middle with its unit.
class LengthTicker : public QCPAxisTicker {
 protected:
  QVector<double> createTickVector(double tickStep, const QCPRange& range) override;
  QVector<double> createSubTickVector(int, const QVector<double>&) override { return {}; }
  QString getTickLabel(double tick, const QLocale&, QChar, int) override;

 private:
  QCPRange shown_;
};

}  // namespace batten
