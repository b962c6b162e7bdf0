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
  std::optional<int> curve;
  PlotTab tab;
  Judged judged;
  bool operator==(const DataKey&) const = default;
};

/// @param degree of a target: each has a stroke of its own, by colour and dashes
QPen penOf(PlotRole role, const Theme& theme, std::optional<int> degree = {});
/// What the numbers of a plot are: "R, mm".
QString quantityText(PlotTab tab);

/// Ticks at round numbers that stand apart on a logarithmic axis, however short its range.
class RoundLogTicker : public QCPAxisTicker {
 protected:
  QVector<double> createTickVector(double tickStep, const QCPRange& range) override;
  QVector<double> createSubTickVector(int, const QVector<double>&) override { return {}; }
  QString getTickLabel(double tick, const QLocale&, QChar, int) override;
};

/// Ticks of a linear axis with just the digits that tell neighbours apart.
class PlainTicker : public QCPAxisTicker {
 public:
  PlainTicker() { setTickCount(4); }

 protected:
  double getTickStep(const QCPRange& range) override;
  QString getTickLabel(double tick, const QLocale&, QChar, int) override;

 private:
  double step_ = 1.0;
};

/// Begin, middle and end of the shown length, the middle with its unit and an arrow in the direction of travel.
class LengthTicker : public QCPAxisTicker {
 public:
  void setReversed(bool reversed) { reversed_ = reversed; }

 protected:
  QVector<double> createTickVector(double tickStep, const QCPRange& range) override;
  QVector<double> createSubTickVector(int, const QVector<double>&) override { return {}; }
  QString getTickLabel(double tick, const QLocale&, QChar, int) override;

 private:
  QCPRange shown_;
  bool reversed_ = false;
};

}  // namespace batten
