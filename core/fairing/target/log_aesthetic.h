// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// A stretch whose radius of curvature to the power alpha is linear in the arc length: alpha -1 is a clothoid, 0
/// Nielsen's spiral, 1 a logarithmic spiral, 2 the involute of a circle. Miura, A general equation of aesthetic curves
/// and its self-affinity, CAD & A 3 (2006).
struct LogAesthetic {
  double startKappa = 0.0, endKappa = 0.0;  ///< [1/mm] Of one sign unless alpha is -1.
  double alpha = -1.0;                      ///< [-]

  /// Curvature at x in 0..1 of its length, and its slope with respect to x.
  double kappa(double x) const;
  double slope(double x) const;
};

/// The log-aesthetic stretch nearest to samples of a curvature by least squares. @param x ascending, 0..1.
/// @param alpha given, or -3..6 searched for. @param start,end curvature held there.
/// Where the curvature changes its sign or has none, alpha is -1: no other crosses zero.
LogAesthetic fitLogAesthetic(std::span<const double> x, std::span<const double> kappa, std::optional<double> alpha,
                             std::optional<double> start, std::optional<double> end);

/// The profile of the curve's curvature as log-aesthetic stretches, from each split to the next, which meet with one
/// curvature.
struct LogAestheticTarget {
  TargetProfile profile;
  std::vector<LogAestheticSpan> spans;
};
LogAestheticTarget logAestheticTarget(const NurbsCurve&, bool closed, const std::vector<double>& splits,
                                      std::optional<double> alpha, int samples);

}  // namespace batten
