// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/curve/nurbs_curve.h"
#include "ui/plots/plot_series.h"

namespace batten {

/// The place of the cursor and the value there: "s 12.3 mm · R 45.6 mm". Of the faired curve where it is shown.
/// @param s [mm] along the axis
QString valueText(const PlotData& data, PlotTab tab, double s, const NurbsCurve& shown);

}  // namespace batten
