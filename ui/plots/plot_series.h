// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "ui/session/curves/extremum_marks.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/judged_curve.h"

namespace batten {

/// In an order of its own, as the settings keep the number.
enum class PlotTab { Radius, Curvature, Speed, Deviation, CurvatureSlope };
inline constexpr int kPlotTabs = 5;  // their number

/// What a line of a plot stands for; the plot chooses pen and colour.
enum class PlotRole { Sketched, Faired, Target, ChosenTarget, HoveredTarget, DrawnTarget, Tolerance, Joint };

struct PlotPoint {
  double s = 0.0;  ///< [mm] Arc length on the axis.
  double value = 0.0;
  bool operator==(const PlotPoint&) const = default;
};

struct PlotSeries {
  PlotRole role = PlotRole::Sketched;
  std::optional<int> degree = {};      ///< Of a target.
  std::vector<PlotPoint> points = {};  ///< s ascending; only finite values.
  /// Between the two samples beside the place; held beyond either end.
  /// @pre not empty.
  double at(double place) const;
};

/// The noise of a curve at one place.
struct NoiseRange {
  double s = 0.0;  ///< [mm] On the axis.
  double low = 0.0, high = 0.0;
};

/// Everything one plot draws of the selected curve.
struct PlotData {
  double lengthMm = 0.0;
  std::vector<PlotSeries> series;
  std::vector<NoiseRange> noise;    ///< Curvature: +-2 sigma of the sketched curve.
  std::vector<ExtremumMark> marks;  ///< Curvature: the extrema of the judged curve; s as on the axis.
  std::vector<PlotPoint> handles;   ///< Points of the drawn target.
  std::vector<double> kept;         ///< s of the extrema that monotone fairing is to keep.
  std::vector<double> splits;       ///< s of the splits, in the order of splitsOf.
  bool logarithmic = false;
  std::optional<double> most = {};  ///< Of the values shown at first: above it, lines leave the plot.
  bool runsLeft = false;            ///< The curve begins farther right on the page (or below) than it ends.
  double low = 0.0, high = 1.0;     ///< Range of the values that is shown at first.
  bool isEmpty() const { return series.empty(); }
};

/// The plot of the session's selected curve. Model frame, mm.
/// @param linearRadius the radius on a linear axis, cut off at twice the largest radius that a tenth of the curve
/// reaches.
/// @param judged Sketched: the constructed curve alone; Result: what fairing made of it, over the sketched one in grey.
PlotData plotData(const EditorSession& session, PlotTab tab, Judged judged = Judged::Result, bool linearRadius = false);

/// Radius within limits, never infinite: `largest` for straight stretches.
double clampedRadius(double kappa, double smallest, double largest);

}  // namespace batten
