// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "core/fairing/model/curvature_rows.h"
#include "core/fairing/model/fairing_setup.h"

namespace batten {

/// A derivative below this share of the mean speed counts as a cusp.
inline constexpr double kCuspShare = 1e-6;

/// What is minimised beside the fidelity: sum over the samples of squared residuals.
struct FairingObjective {
  /// Not empty: residuals (kappa_i - (L0/L) wanted_i) / reference / sqrt(M). Empty: d kappa/ds sqrt(L/M) / reference.
  std::vector<double> wanted;
  double reference = 1.0;  ///< [1/mm; mm^-3/2 where `wanted` is empty] Makes residuals plain numbers.
};
/// What keeps the curve near the sketch, a function of the signed distance e of each sample.
struct FairingCorridor {
  /// -weight / M log(1 - (e/boundMm)^2)
  struct Barrier {
    double weight = 0.0, boundMm = 0.0;
  };
  double weight = 0.0;                  ///< weight^2 e^2 / M, 1/mm.
  std::optional<Barrier> barrier = {};  ///< Absent: e has no bound.
};

/// A place of a curve on its way, at equal arc length.
struct FairingSample {
  Jet jet;
  CurvatureJet curvature;
  SpanPlace foot;                    ///< On the sketched curve.
  Vec2 normalAtFoot = Vec2::Zero();  ///< Left normal of the sketched curve there.
  double distance = 0.0;             ///< Signed, from the foot.
};

/// A curve on its way, with all that the next step needs.
struct FairingState {
  std::vector<Vec2> points;  ///< Control points. [mm]
  SpanCurve curve;
  EqualArc arc;
  std::vector<FairingSample> samples;
  Eigen::VectorXd residual;  ///< Of the samples.
  std::vector<SpanPlace> feet() const;
  double misfit = 0.0, total = 0.0;  ///< Sum of squared residuals; the same with the corridor.
};
/// Absent when the curve collapses (a vanishing derivative), is not finite or leaves the corridor of the barrier, and
/// when the run is cancelled.
/// @param most of the total: a curve of more is not evaluated to its end, and absent too.
std::optional<FairingState> evaluate(const FairingSetup& setup, const FairingObjective& objective,
                                     const FairingCorridor& corridor, std::vector<Vec2> points,
                                     const std::vector<SpanPlace>& feet,
                                     double most = std::numeric_limits<double>::infinity());

}  // namespace batten
