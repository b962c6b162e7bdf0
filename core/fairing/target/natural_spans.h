// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/profile/radius_target.h"

namespace batten {

/// Shares of the arc length, ascending and inside 0..1, of the curvature extrema whose removal would move the curve by
/// `leastMm` or more (the estimate of structureLevels).
std::vector<double> significantSplits(const NurbsCurve&, bool closed, double leastMm);

/// A profile of more polynomials says nothing that the curve does not say itself.
inline constexpr int kMostSplits = 24;

/// Those of the natural extrema, whose removal would move the curve by 0.02 mm and by 1/10000 of its size; of a curve
/// with more than kMostSplits of them those of the most significant ones. They
/// depend on the curve alone, so that a target is the same target at every tolerance.
std::vector<double> naturalSplits(const NurbsCurve&, bool closed);

/// The natural splits first, then fewer and fewer down to none, then more and more, but no more than kMostSplits: those
/// of the moves 1, 2, 5, 10 ... Without repetitions.
struct SplitLevel {
  std::vector<double> splits;
  bool isFiner = false;  ///< More splits than the natural ones.
};
std::vector<SplitLevel> naturalSplitLevels(const NurbsCurve&, bool closed);

/// The part between two splits in which a place lies; with one split or none of a closed curve all of it.
ProfileSpan spanBetween(const std::vector<double>& splits, double at, bool closed);

}  // namespace batten
