// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/value_text.h"

#include <algorithm>

#include "ui/plots/curve_plots.h"
#include "ui/session/text/place_text.h"

namespace batten {
namespace {

QString quantity(PlotTab tab, const QString& number) {
  switch (tab) {
    case PlotTab::Curvature:
      return CurvePlots::tr(" · κ %1 /mm").arg(number);
    case PlotTab::CurvatureSlope:
      return CurvePlots::tr(" · dκ/ds %1 /mm²").arg(number);
    case PlotTab::Speed:
      return CurvePlots::tr(" · |R′| %1").arg(number);
    case PlotTab::Deviation:
      return CurvePlots::tr(" · %1 mm").arg(number);
    case PlotTab::Radius:
      break;
  }
  return {};
}

}  // namespace

QString valueText(const PlotData& data, PlotTab tab, double s, const NurbsCurve& shown) {
  const QString place = CurvePlots::tr("s %1 mm").arg(s, 0, 'f', 1);
  // The canvas says the radius, too: of the curve itself, not of the samples of either.
  const bool isOfCurvature = tab == PlotTab::Radius || tab == PlotTab::Curvature;
  const auto kappa = isOfCurvature ? curvatureAtLength(shown, s) : std::nullopt;
  if (tab == PlotTab::Radius) return kappa ? place + QStringLiteral(" · ") + radiusText(*kappa, shown) : place;
  if (kappa) return place + quantity(tab, QString::number(*kappa, 'g', 4));
  for (const PlotRole role : {PlotRole::Faired, PlotRole::Sketched}) {
    const auto series = std::find_if(data.series.begin(), data.series.end(),
                                     [role](const PlotSeries& one) { return one.role == role; });
    if (series == data.series.end()) continue;
    return place + quantity(tab, QString::number(series->at(s), 'g', 4));
  }
  return place;
}

}  // namespace batten
