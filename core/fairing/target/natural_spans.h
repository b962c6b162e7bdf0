// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// Whether the parameters ask for them: no splits of their own, and polynomials of the curvature.
bool hasNaturalSpans(const TargetParams&);

/// Shares of the arc length, ascending and inside 0..1, of the curvature extrema whose removal would move the curve by
/// a tenth of the tolerance or more (the estimate of structureLevels). So that they do not change with every step of a
/// slider, the tolerance counts as the next lower one of the series 1, 2, 5, 10 …
std::vector<double> naturalSplits(const NurbsCurve&, bool closed, double toleranceMm);

/// Splits, and the smallest tolerance of which they are the natural ones.
struct SpanLevel {
  double fromMm = 0.0;         ///< 0: of every tolerance below those of the next level.
  std::vector<double> splits;  ///< 0..1 of the arc length, ascending.
};
/// Those of all tolerances, from the largest tolerance down: what differs from the level before. Never empty.
std::vector<SpanLevel> naturalSpanLevels(const NurbsCurve&, bool closed);
/// Which of them are naturalSplits of a tolerance.
std::size_t levelOf(std::span<const SpanLevel>, double toleranceMm);

/// The part between two splits in which a place lies; with one split or none of a closed curve all of it.
ProfileSpan spanBetween(const std::vector<double>& splits, double at, bool closed);

}  // namespace batten
