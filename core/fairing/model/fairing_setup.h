// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/result.h"
#include "core/curve/periodic_form.h"
#include "core/curve/span_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/unknowns.h"

namespace batten {

/// What all fairings of one curve share. Never changes once made; owned by a shared_ptr because curves refer to
/// `basis`.
struct FairingSetup {
  NurbsCurve original;  ///< The curve to begin with: the sketched one, or the one nearest to it over fewer knots.
  /// Set for a start over fewer knots: the setup of the sketched curve, to whose basis `reference` then belongs.
  std::shared_ptr<const FairingSetup> sketch;
  bool closed = false;
  PeriodicForm periodic;  ///< Closed curves only.
  /// [mm] How far the periodic form is from a closed curve whose ends do not meet with all derivatives; else 0.
  double seamMm = 0.0;
  double takenMm = 0.0;  ///< [mm] FairingParams::takenMm
  /// [mm] Of the tolerance, before the curve moves.
  double claimedMm() const { return seamMm + takenMm; }
  SpanBasis basis;
  std::vector<Vec2> points;  ///< Control points of the curve to begin with (each once).
  SpanCurve reference;       ///< The sketched curve.
  EqualArc start;            ///< Sample places on it.
  Unknowns unknowns;
  EndHold startHold, endHold;
  bool isPart = false;  ///< Only a span of the curve moves.
  double extent = 0.0;  ///< [mm] Of the curve.
  /// Signed distance of the line's own points from the sketched curve, at its samples (in the mean of those nearby);
  /// empty when the line is not known: the sketched curve then stands for it.
  std::vector<double> offsets;
  /// That distance at a place of the sketched curve.
  double offsetAt(const SpanPlace& foot) const;
  /// Where a place of the sketched curve lies among its samples: 0 at the first, 1 at the second, …
  double sampleAt(const SpanPlace& place) const;
  /// About where on the sketched curve a place of `basis` lies: there itself, or at the same share of the length.
  SpanPlace sketchedPlace(const SpanPlace& place) const;
  const NurbsCurve& sketchedCurve() const { return sketch ? sketch->original : original; }
  CancelCheck check;  ///< The run that the curve is faired for.
  int sampleCount() const { return static_cast<int>(start.places.size()); }
  double fraction(int sample) const {
    return static_cast<double>(sample) / (closed ? sampleCount() : sampleCount() - 1);
  }
};
/// @param check of the run, which all work with this setup looks at.
/// @param moving parameters between which alone the curve may move, a closed one over its seam, too; absent: anywhere.
/// @return BadParameter for rational curves and degrees outside 3..7; Numerical for a curve without length.
Result<std::shared_ptr<const FairingSetup>> makeSetup(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                                      CancelCheck check = {},
                                                      const std::optional<ProfileSpan>& moving = {});

/// The faired curve over the knots of the sketched one.
Result<NurbsCurve> toCurve(const FairingSetup& setup, const std::vector<Vec2>& points);

/// The curve as it was: what is taken of the tolerance, and the seam, leave nothing of it.
FairedCurve withoutTolerance(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check);

/// A result over a setup as one of the curve that the user has: what it needs includes what is claimed of the
/// tolerance. Where the curve had to be made periodic first, the deviation is measured again, and what has not moved is
/// that curve itself.
FairedCurve againstSketch(const FairingSetup& setup, FairedCurve faired);

/// Runs `body` on the curve's setup, with the tolerance that is left for it. Curves that cannot be faired are returned
/// they are when the reason lies in their shape.
Result<FairedCurve> withSetup(const NurbsCurve& curve, bool closed, const FairingParams& params, const RunContext&,
                              const std::function<Result<FairedCurve>(const std::shared_ptr<const FairingSetup>& setup,
                                                                      const FairingParams& within)>& body);

/// The share of the way from the sketched curve to `points` that stays within the tolerance, measured both ways on the
/// whole curve; `points` are moved there. @return the largest deviation.
double keepWithin(const FairingSetup& setup, double toleranceMm, std::vector<Vec2>& points);

/// Fills in what the report says of the curves: deviation, extrema.
Result<FairedCurve> finished(const FairingSetup& setup, std::vector<Vec2> points, double toleranceMm,
                             FairingReport report);

}  // namespace batten
