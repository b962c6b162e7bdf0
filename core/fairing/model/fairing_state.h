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
  double reference = 1.0;
};
/// What keeps the curve near the sketch, a function of the signed distance e of each sample.
struct FairingCorridor {
  double weight = 0.0;   ///< weight^2 e^2 / M, 1/mm.
  double barrier = 0.0;  ///< -barrier / M log(1 - (e/bound)^2); 0 = none.
  double bound = 0.0;
};

/// A curve on its way, with all that the next step needs.
struct FairingState {
  std::vector<Vec2> points;
  SpanCurve curve;
  EqualArc arc;
  std::vector<Jet> jets;
  std::vector<CurvatureJet> curvature;
  std::vector<SpanPlace> feet;   ///< Foot points of the samples on the sketched curve.
  std::vector<double> distance;  ///< Signed distances of the samples.
  std::vector<Vec2> normal;      ///< Left normals of the sketched curve at the feet.
  Eigen::VectorXd residual;
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
