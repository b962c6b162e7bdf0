// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plots/plot_series.h"
#include "ui/theme/theme.h"

class QCustomPlot;

namespace batten {

/// Adds the graphs of the data to a plot that has none: the band below, lines over it, marks on top.
void drawGraphs(QCustomPlot& plot, const PlotData& data, PlotTab tab, const Theme& theme);

}  // namespace batten
