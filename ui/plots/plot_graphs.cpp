// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_graphs.h"

#include <qcustomplot.h>

#include <algorithm>

#include "ui/plots/plot_style.h"

namespace batten {
namespace {

template <class Point>
QVector<double> column(const std::vector<Point>& points, double Point::*field) {
  QVector<double> values;
  values.reserve(std::ssize(points));
  for (const Point& point : points) values.append(point.*field);
  return values;
}

void drawNoise(QCustomPlot& plot, const PlotData& data, const Theme& theme) {
  if (data.noise.size() < 2) return;
  QCPGraph* low = plot.addGraph();
  QCPGraph* high = plot.addGraph();
  low->setData(column(data.noise, &NoiseRange::s), column(data.noise, &NoiseRange::low), true);
  high->setData(column(data.noise, &NoiseRange::s), column(data.noise, &NoiseRange::high), true);
  low->setPen(Qt::NoPen);
  high->setPen(Qt::NoPen);
  QColor fill = theme.mute;
  fill.setAlphaF(0.18F);
  high->setBrush(fill);
  high->setChannelFillGraph(low);
}

void drawMarks(QCustomPlot& plot, const PlotData& data, const Theme& theme) {
  for (const ExtremumMark& mark : data.marks) {
    QColor faint = theme.accent;
    faint.setAlphaF(0.4F);
    const QColor line = mark.wantedToKeep ? theme.amber : mark.isKept ? theme.accent : theme.mute;
    const QColor fill = !mark.isKept ? theme.panel : mark.isCertain ? theme.accent : faint;
    QCPGraph* graph = plot.addGraph();
    graph->setData({mark.s}, {mark.kappa}, true);
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(line, mark.wantedToKeep ? 2.2 : 1.5), fill, 9));
    graph->setAntialiasedScatters(true);
  }
}

void drawLines(QCustomPlot& plot, const PlotData& data, PlotTab tab, const Theme& theme) {
  // A curve that is judged alone is drawn as the one that counts.
  const bool isAlone =
      tab != PlotTab::Deviation && std::none_of(data.series.begin(), data.series.end(),
                                                [](const auto& one) { return one.role == PlotRole::Faired; });
  for (const PlotSeries& series : data.series) {
    QCPGraph* graph = plot.addGraph();
    graph->setData(column(series.points, &PlotPoint::s), column(series.points, &PlotPoint::value), true);
    graph->setPen(
        penOf(isAlone && series.role == PlotRole::Sketched ? PlotRole::Faired : series.role, theme, series.degree));
    if (series.role == PlotRole::Joint) {
      graph->setLineStyle(QCPGraph::lsNone);
      graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, theme.text, theme.panel, 5.0));
    }
    graph->setAntialiased(true);
  }
}

}  // namespace

void drawGraphs(QCustomPlot& plot, const PlotData& data, PlotTab tab, const Theme& theme) {
  drawNoise(plot, data, theme);
  drawLines(plot, data, tab, theme);
  drawMarks(plot, data, theme);
}

}  // namespace batten
