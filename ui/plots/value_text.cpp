// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/value_text.h"

#include <algorithm>

#include "ui/plots/curve_plots.h"

namespace batten {
namespace {

QString quantity(PlotTab tab, const QString& number) {
  switch (tab) {
    case PlotTab::Radius:
      return CurvePlots::tr(" · R %1 mm").arg(number);
    case PlotTab::Curvature:
      return CurvePlots::tr(" · κ %1 /mm").arg(number);
    case PlotTab::CurvatureSlope:
      return CurvePlots::tr(" · dκ/ds %1 /mm²").arg(number);
    case PlotTab::Speed:
      return CurvePlots::tr(" · |R′| %1").arg(number);
    case PlotTab::Deviation:
      return CurvePlots::tr(" · %1 mm").arg(number);
  }
  return {};
}

}  // namespace

QString valueText(const PlotData& data, PlotTab tab, double s) {
  const QString place = CurvePlots::tr("s %1 mm").arg(s, 0, 'f', 1);
  for (const PlotRole role : {PlotRole::Faired, PlotRole::Sketched}) {
    const auto series = std::find_if(data.series.begin(), data.series.end(),
                                     [role](const PlotSeries& one) { return one.role == role; });
    if (series == data.series.end()) continue;
    const auto at = std::lower_bound(series->s.begin(), series->s.end(), s) - series->s.begin();
    const auto i = std::min(at, std::ssize(series->s) - 1);
    return place + quantity(tab, QString::number(series->value[i], 'g', 4));
  }
  return place;
}

}  // namespace batten
