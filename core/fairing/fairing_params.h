// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/fairing/profile/drawn_profile.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// Part of the tolerance that a curve may take: the rest is room for what lies between the places where the deviation
/// is measured.
inline constexpr double kToleranceRoom = 0.999;
/// [mm] The tolerance that has this room beside a deviation, with what rounding takes.
inline double toleranceFor(double deviationMm) { return deviationMm * (1.0 + 1e-12) / kToleranceRoom; }

enum class FairingMode {
  None,       ///< The sketched curve as constructed.
  Target,     ///< Towards one of the target profiles, or the drawn one.
  Tolerance,  ///< Smallest integral of (dkappa/ds)^2 within the tolerance.
  Monotone,   ///< The nearest curve whose curvature is monotone between the extrema that are kept.
  LowPass,    ///< Towards the sketch's own curvature without its short waves.
};

/// How much of the tolerance the tolerance fairing uses.
enum class TolerancePolicy {
  AsNeeded,  ///< Until no insignificant wave is left; see fairWithinTolerance.
  All,       ///< All of it: least variation of curvature within the tolerance.
};

/// What a target or low-passed profile moves.
enum class FairingMeans {
  ControlPoints,  ///< All control points (000, 003).
  EdgeLengths,    ///< Bezier path: the lengths of the edges of each piece's polygon, not their directions (001).
};

/// Which target is recommended.
enum class TargetChoice {
  Simplest,    ///< The lowest degree that is met within the tolerance without a curvature extremum more (default).
  Similarity,  ///< The highest similarity S (000, 003), which mostly rises with the degree.
};

/// What target mode follows. The values are the numbers that recipes hold.
enum class FairingTarget {
  Recommended = 0,  ///< The polynomial that TargetChoice recommends.
  Degree1 = 1,
  Degree2,
  Degree3,
  Degree4,
  Degree5,
  Degree6,
  Drawn,         ///< The profile that the user has drawn.
  LogAesthetic,  ///< Between the splits rho^alpha linear in the arc length (log_aesthetic.h).
};
/// The degree of the polynomial that was asked for; nothing where it is recommended, or another profile.
std::optional<int> degreeOf(FairingTarget);
/// @pre isTargetDegree(degree)
FairingTarget targetOfDegree(int degree);
/// The target of a recipe's number; nothing for a number that stands for none.
std::optional<FairingTarget> targetOfNumber(int number);
/// Whether a polynomial is followed: of a degree that was asked for, or the recommended one.
inline bool isPolynomial(FairingTarget target) {
  return target == FairingTarget::Recommended || degreeOf(target).has_value();
}

inline constexpr double kLeastAlpha = -3.0, kMostAlpha = 6.0;  // range of the log-aesthetic parameter alpha
/// [mm] Of FairingParams::toleranceMm.
inline constexpr double kLargestToleranceMm = 20.0;
/// How many curvature extrema a monotone curve may keep.
struct KeptExtrema {
  std::optional<int> count;  ///< 0..99; absent: as few as the tolerance allows.
  bool operator==(const KeptExtrema&) const = default;
};
/// The number that recipes, reports and the command line hold for it: -1 for as few as the tolerance allows.
int numberOf(const KeptExtrema&);
/// What such a number stands for.
KeptExtrema keptExtremaOf(int number);

/// What is held at an end of an open curve beside its position, which always is.
struct EndHold {
  bool tangent = false;
  bool curvature = false;  ///< Includes the tangent: a held curvature on a turned end would join nothing.
  bool operator==(const EndHold&) const = default;
};

/// A natural span with a target of its own.
struct SpanTarget {
  double at = 0.0;  ///< 0..1. Share of the arc length: a place in the span.
  int degree = 1;   ///< 1..kMostTargetDegree.
  bool operator==(const SpanTarget&) const = default;
};

struct FairingParams {
  FairingMode mode = FairingMode::None;
  FairingTarget target = FairingTarget::Recommended;
  TargetChoice targetChoice = TargetChoice::Simplest;
  std::optional<double> alpha;  ///< -3..6. Of a log-aesthetic target; absent: what each span comes nearest to.
  double toleranceMm = 0.2;     ///< [mm] 0.001..20. Largest move of the curve from the sketched one; never exceeded.
  /// [mm] >= 0. Of the tolerance, not for fairing: how far the curve that it begins with lies off the sketched one.
  /// What goes by the tolerance (spans) goes by all of it.
  double takenMm = 0.0;
  TolerancePolicy tolerancePolicy = TolerancePolicy::AsNeeded;  ///< Tolerance mode.
  FairingMeans means = FairingMeans::ControlPoints;  ///< Target and low-pass modes; edge lengths only on Bezier paths.
  double lowPassMm =
      20.0;  ///< [mm] 0.1..10000. Low-pass: curvature waves of this length are halved, shorter ones removed.
  KeptExtrema keepExtrema;     ///< Monotone mode.
  std::vector<double> keptAt;  ///< Monotone: arc length fractions 0..1 of the extrema to keep; not empty: counts alone.
  std::vector<SpanTarget> spanTargets;  ///< Target: not empty: only these spans are moved, the rest stays as it is.
  std::vector<ProfilePoint> profile;    ///< The drawn curvature.
  EndHold startHold, endHold;
  TargetParams targets;
  bool operator==(const FairingParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const FairingParams&);

}  // namespace batten
