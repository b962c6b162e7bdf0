// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/curve/curvature.h"
#include "core/fairing/profile/target_degrees.h"

namespace batten {

/// What the target polynomial describes over the perimeter 0..1.
enum class TargetQuantity {
  Curvature,  ///< Signed kappa (default): also through inflections.
  Radius,     ///< rho = 1/kappa as the papers fit it (000 VI); undefined on straight parts.
};

/// Where a polynomial begins and ends, unless the user has split the curve himself.
enum class TargetSpans {
  Natural,  ///< At every significant curvature extremum (naturalSplits).
  Whole,    ///< At the ends of the curve: one polynomial, as in the papers.
};

struct TargetParams {
  TargetSpans spans = TargetSpans::Natural;
  TargetQuantity quantity = TargetQuantity::Curvature;
  bool monotone = true;  ///< Monotone; off: "as in the paper", and the tile says when it is not monotone.
  int samples = 121;     ///< 101..2001. Samples at equal arc length (at least 4 a knot span are taken).
  /// Arc length fractions, ascending and inside 0..1, at which one profile ends and the next begins: each part has a
  /// polynomial of its own, and the curvature goes on where they meet.
  std::vector<double> splits;
  bool operator==(const TargetParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const TargetParams&);

/// A part of a curve by shares of its arc length. On a closed curve `to` may lie beyond 1: over the seam.
struct ProfileSpan {
  double from = 0.0, to = 1.0;
  bool operator==(const ProfileSpan&) const = default;
};

/// A place of a profile made of cubics.
struct ProfileNode {
  double f = 0.0, value = 0.0, slope = 0.0;  ///< Slope with respect to f.
};

/// One of the target profiles, or any other: where `nodes` are given, they count instead of the coefficients.
struct TargetProfile {
  int degree = 1;  ///< 1..kMostTargetDegree.
  TargetQuantity quantity = TargetQuantity::Curvature;
  std::vector<double> coefficients;  ///< Ascending powers of the perimeter f in 0..1, [1/mm] or [mm].
  std::vector<ProfileNode> nodes;    ///< Ascending f from 0 to 1, cubic between two; a kink is two nodes of the same f.
  bool valid = false;                ///< False: could not be fitted; `problem` says why.
  std::string problem;
  bool isMonotone = false;  ///< Monotone, except at splits.
  /// S (003 Eq 14) of the target's radius against the curve's, -1..1; where the curve has an inflection, and its radius
  /// no end, S of the curvature.
  double similarity = 0.0;
  double pearson = 0.0;     ///< Pearson r of the same, -1..1.
  double rmsPercent = 0.0;  ///< rms difference in % of the range of the data.
  /// Smaller is better; n_eff = number of control points. Absent: too few of them for the degree.
  std::optional<double> aicc;
  /// Target value at perimeter f; curvature() converts a radius target.
  double value(double f) const;
  double curvatureAt(double f) const;
};

/// Whether a profile explains the curve better than another by AICc; one without is never better.
inline bool hasLowerAicc(const TargetProfile& one, const TargetProfile& other) {
  return one.aicc && (!other.aicc || *one.aicc < *other.aicc);
}

/// The curvature of a curve at one place.
struct CurvatureSample {
  double perimeter = 0.0;  ///< 0..1, share of the arc length.
  double kappa = 0.0;      ///< [1/mm]
};

struct TargetSet {
  PerTarget<TargetProfile> profiles;
  std::vector<CurvatureSample> samples;  ///< Of the curve.
  bool comparesCurvature = false;        ///< Similarities are of the curvature, for the radius has no end somewhere.
  std::optional<int> recommendedDegree;  ///< By AICc; absent: none is valid.
};

/// Least-squares polynomials of degree 1..kMostTargetDegree over the perimeter (000 VI, 003 section 4), monotone by
/// non-negative least squares on a grid of 200 (Bernstein coefficients as fallback), with their similarity to the
/// curve. A monotone profile of data that turn back stays monotone and lies far off: S, Pearson and rms tell. S and
/// Pearson compare radii, which have no end where the curve is straight: |rho| counts as at most ten times the extent
/// of the curve (sagitta 1/80 of it), with the sign of kappa. rms and AICc refer to the fitted quantity; for AICc a
/// residual below 1e-6 of the data's rms counts as this, so that exact data choose the lowest degree and not the
/// rounding.
/// @param closed value and slope of the profile at f = 1 equal those at 0 (degrees 1 and 2: a circle); `monotone` is
/// off.
TargetSet fitTargets(const NurbsCurve&, const TargetParams&, bool closed = false);
/// The one of a degree alone.
TargetProfile fitTarget(const NurbsCurve&, const TargetParams&, bool closed, int degree);

}  // namespace batten
