// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/periodic_form.h"
#include "core/curve/span_curve.h"
#include "core/fairing/fairing.h"
#include "core/solve/banded_cholesky.h"

namespace batten {

/// A derivative below this share of the mean speed counts as a cusp.
inline constexpr double kCuspShare = 1e-6;
/// [1/extent] Prominence of a counted curvature extremum: smaller rises are not seen by an eye nor by light.
inline constexpr double kProminence = 5e-3;

/// d kappa / d q at a fixed parameter, per control point of the span (003 section 4; algorithms: shape modification):
/// row[j] = (d kappa / d x_j, d kappa / d y_j) with s = |R'|.
using LocalRow = std::array<Vec2, kMaxFairingDegree + 1>;
LocalRow curvatureRow(const Jet& jet, const SpanRow& basis, int degree);
/// The same for d kappa / d s, the change of curvature along the curve.
LocalRow curvatureSlopeRow(const Jet& jet, const SpanRow& basis, int degree);

/// Signed curvature of a jet and its first and second derivatives with respect to arc length. @pre |R'| > 0.
struct CurvatureJet {
  double kappa = 0.0, slope = 0.0, bend = 0.0, speed = 0.0;
};
CurvatureJet curvatureJet(const Jet& jet);

/// Coordinates that move freely, as a null-space basis of the linear end conditions: position always, with `tangent`
/// also the direction, with `curvature` the derivative and the normal part of the second one, which fixes both.
/// Periodic points are folded (0, m-1, 1, m-2, ...), so that cyclic coupling stays within a band.
class Unknowns {
 public:
  Unknowns() = default;
  Unknowns(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold, const EndHold& endHold);
  int count() const { return count_; }
  int halfWidth() const { return halfWidth_; }
  int stride() const { return stride_; }  ///< Largest number of unknowns that a span depends on.
  std::span<const int> indices(int span) const { return spans_[span].index; }
  /// Local row over the control points of a span to values over indices(span).
  void reduce(int span, const LocalRow& local, double* values) const;
  /// Adds the displacement of the unknowns to the control points.
  void move(const Eigen::VectorXd& step, std::vector<Vec2>& points) const;

 private:
  struct Part {
    int index;
    double factor;
  };
  struct SpanMap {
    std::vector<int> index;
    std::vector<std::vector<std::pair<int, double>>> slots;  ///< Per local coordinate 2j + c: (slot, factor).
  };
  void buildBlocks(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold, const EndHold& endHold);
  void buildPeriodic(int points);
  void buildSpans(const SpanBasis& basis);
  int count_ = 0, halfWidth_ = 0, stride_ = 0, degree_ = 0;
  std::vector<std::vector<Part>> coordinates_;  ///< Per coordinate 2 * point + c.
  std::vector<SpanMap> spans_;
};

/// What all fairings of one curve share. Never changes once made; owned by a shared_ptr because curves refer to
/// `basis`.
struct FairingSetup {
  NurbsCurve original;
  bool closed = false;
  PeriodicForm periodic;  ///< Closed curves only.
  SpanBasis basis;
  std::vector<Vec2> points;  ///< Control points of the sketched curve (each once).
  SpanCurve reference;       ///< The sketched curve.
  EqualArc start;            ///< Sample places on it.
  Unknowns unknowns;
  double extent = 0.0;
  /// Signed distance of the line's own points from the sketched curve, at its samples (in the mean of those nearby);
  /// empty when the line is not known: the sketched curve then stands for it.
  std::vector<double> offsets;
  /// That distance at a place of the sketched curve.
  double offsetAt(const SpanPlace& foot) const;
  /// Where a place of the sketched curve lies among its samples: 0 at the first, 1 at the second, …
  double sampleAt(const SpanPlace& place) const;
  int sampleCount() const { return static_cast<int>(start.places.size()); }
  double fraction(int sample) const {
    return static_cast<double>(sample) / (closed ? sampleCount() : sampleCount() - 1);
  }
};
/// @return BadParameter for rational curves and degrees outside 3..7; Numerical for a curve without length.
Result<std::shared_ptr<const FairingSetup>> makeSetup(const NurbsCurve& curve, bool closed,
                                                      const FairingParams& params);

/// The faired curve over the knots of the sketched one.
Result<NurbsCurve> toCurve(const FairingSetup& setup, const std::vector<Vec2>& points);

/// Largest distance of the curve from the sketched one: foot points at 12 places a span or, where the two swing
/// apart quickly, so many that no more than 1 % can hide between them.
/// `bothWays` also measures the sketched curve's distance from the curve.
double largestDeviation(const FairingSetup& setup, const std::vector<Vec2>& points, bool bothWays = false);

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
/// Absent when the curve collapses (a vanishing derivative), is not finite or leaves the corridor of the barrier.
std::optional<FairingState> evaluate(const FairingSetup& setup, const FairingObjective& objective,
                                     const FairingCorridor& corridor, std::vector<Vec2> points,
                                     const std::vector<SpanPlace>& feet);

/// The Gauss-Newton model at a state: sparse rows plus the coupling of all samples through the arc length.
class FairingModel {
 public:
  FairingModel(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
               const FairingState& state);
  /// J v and J' y of the curvature residuals, with samples that are re-located at equal arc fractions.
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  Eigen::VectorXd applyTransposed(const Eigen::VectorXd& y) const;
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// Change of the signed distances.
  Eigen::VectorXd distances(const Eigen::VectorXd& v) const;
  /// Solves (J'J + corridor + damping) x = -gradient by conjugate gradients with the banded part as preconditioner.
  /// Absent when the banded part cannot be factorised.
  std::optional<Eigen::VectorXd> step(double damping) const;

 private:
  double dot(const Eigen::MatrixXd& rows, int sample, const Eigen::VectorXd& v) const;
  void accumulate(const Eigen::MatrixXd& rows, int sample, double factor, Eigen::VectorXd& out) const;
  void assemble();
  /// What J v is made of, per sample, and what J' y adds to the rows.
  Eigen::VectorXd applyTo(const Eigen::VectorXd& local, const Eigen::VectorXd& normal, double shift) const;
  void transposeTo(const Eigen::VectorXd& y, Eigen::VectorXd& local, Eigen::VectorXd& normal, double& shift) const;
  Eigen::VectorXd applyNormal(const Eigen::VectorXd& v, double damping) const;
  template <int Stride>
  Eigen::VectorXd applyNormalOf(const Eigen::VectorXd& v, double damping) const;
  Eigen::VectorXd cumulative(const Eigen::VectorXd& values, double& total) const;
  Eigen::VectorXd cumulativeTransposed(const Eigen::VectorXd& values, double total) const;

  const FairingSetup* setup_;
  const FairingState* state_;
  Eigen::MatrixXd local_, normal_, tangent_;  ///< One column a sample, over indices(span).
  Eigen::VectorXd across_;  ///< Cosine between the curve's normal and the sketch's: signed distances change by it.
  Eigen::VectorXd weight_, nonlocal_, lengthTerm_, corridorCurvature_, gradient_;
  double stepLength_ = 0.0, tangentFloor_ = 0.0, dampingUnit_ = 0.0;
  BandedMatrix stiffness_, mass_;
};

/// Why and how a minimisation ended.
struct FairingRun {
  FairingState state;
  Termination why = Termination::IterationLimit;
  int iterations = 0;
  double damping = 1e-3;
};
struct FairingLimits {
  int iterations = 40;
  double relativeDecrease = 1e-4;
};
/// Levenberg-Marquardt from a state. The model's damping is in units of the stiffness of the longest wave.
FairingRun minimise(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
                    FairingState start, double damping, const FairingLimits& limits, const RunContext& context);

}  // namespace batten
