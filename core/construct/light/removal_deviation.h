// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/construct/light/light_reference.h"

namespace batten {

/// [1/diagonal] Extrema of less have no removal deviation. Less than kExtremumProminence, so that an extremum that just
/// counts is ranked on the dense curve and on its sections alike.
inline constexpr double kRankedProminence = 2e-3;

/// A curvature extremum and how far the curve moves when it is flattened.
struct RankedExtremum {
  double s = 0.0;      ///< Arc length of the reference.
  double kappa = 0.0;  ///< 1/unit.
  bool maximum = true;
  Vec2 point = Vec2::Zero();
  /// What flattening it moves the curve by, about: |d kappa| l^2 / (2 pi^2), the half wave of a sine of that height and
  /// length, with the neighbour that it goes with (or the end). Never less than of those that went before it. Absent:
  /// it never goes (closed curves keep four).
  std::optional<double> removal;
};

/// All extrema of at least this prominence, in order along the curve, alternately maxima and minima, each with its
/// removal deviation: the cheapest pair of neighbours (at an open end: single) goes first, again and again. The order
/// and the values belong to the curve alone.
std::vector<RankedExtremum> rankedExtrema(const LightReference&, double prominence);

/// Those whose removal deviation is at least `least`.
std::vector<RankedExtremum> significantExtrema(const std::vector<RankedExtremum>&, double least);

/// Changes of sign of the curvature that reach beyond +-threshold on both sides.
int countInflections(const LightReference&, double threshold);

}  // namespace batten
