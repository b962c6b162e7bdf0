// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/sample_rows.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// [stiffness of the longest wave] Against sliding along the curve, however small the damping. Sliding changes no
/// shape, but a curve that may slide follows a profile more closely: with this floor it creeps there over many steps.
inline constexpr double kSlideFloor = 1.0;

/// The Gauss-Newton model at a state: sparse rows plus the coupling of all samples through the arc length.
class FairingModel {
 public:
  FairingModel(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
               const FairingState& state, double slideFloor = kSlideFloor);
  /// At another state, over the same unknowns: uses the memory that it has.
  void remake(const FairingObjective& objective, const FairingCorridor& corridor, const FairingState& state);
  /// J v and J' y of the curvature residuals, with samples that are re-located at equal arc fractions.
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  Eigen::VectorXd applyTransposed(const Eigen::VectorXd& y) const;
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// Change of the signed distances.
  Eigen::VectorXd distances(const Eigen::VectorXd& v) const;
  /// Solves (J'J + corridor + damping) x = -gradient by conjugate gradients with the banded part as preconditioner.
  /// Absent when the banded part cannot be factorised, and when the run is cancelled.
  std::optional<Eigen::VectorXd> step(double damping) const;

 private:
  void setRows(int sample, const Vec2& tangent, const Vec2& normal, bool profile);
  void assemble();
  /// What J' y adds to the rows: per sample, and of a closed curve to the tangent of the first one.
  struct Transposed {
    Eigen::VectorXd local, normal;
    double shift = 0.0;
  };
  /// An integral up to every sample, and over the whole line.
  struct Integral {
    Eigen::VectorXd upTo;
    double total = 0.0;
  };
  /// J v from its parts per sample.
  Eigen::VectorXd applyTo(const Eigen::VectorXd& local, const Eigen::VectorXd& normal, double shift) const;
  Transposed transposed(const Eigen::VectorXd& y) const;
  Eigen::VectorXd applyNormal(const Eigen::VectorXd& v, double damping) const;
  Integral cumulative(const Eigen::VectorXd& values) const;
  Eigen::VectorXd cumulativeTransposed(const Eigen::VectorXd& values, double total) const;

  const FairingSetup* setup_;
  const FairingState* state_;
  SampleRows rows_;
  Eigen::VectorXd across_;  ///< Cosine between the curve's normal and the sketch's: signed distances change by it.
  Eigen::VectorXd weight_, nonlocal_, lengthTerm_, corridorCurvature_, gradient_;
  double slideFloor_, stepLength_ = 0.0, tangentFloor_ = 0.0, dampingUnit_ = 0.0;
  BandedMatrix stiffness_, mass_;
};

}  // namespace batten
