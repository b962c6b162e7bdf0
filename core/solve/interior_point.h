// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/cancel_check.h"
#include "core/base/termination.h"

namespace batten {

/// A convex quadratic program min x'Ax - 2b'x subject to r_i . x >= h_i, by what the solver needs of it. The problem
/// knows the shape of its matrix and rows, so that each step costs what they cost.
template <class P>
concept QuadraticProgram = requires(const P& p, typename P::Factor& factor, const Eigen::VectorXd& v,
                                    Eigen::VectorXd& out, Eigen::Index i) {
  { p.size() } -> std::convertible_to<Eigen::Index>;
  { p.rowCount() } -> std::convertible_to<Eigen::Index>;
  { p.linear() } -> std::convertible_to<const Eigen::VectorXd&>;  // b
  p.multiply(v, out);                                             // out = A v
  { p.bound(i) } -> std::convertible_to<double>;                  // h_i
  { p.dotRow(i, v) } -> std::convertible_to<double>;              // r_i . v
  p.addRow(i, 1.0, out);                                          // out += factor r_i'
  p.dotRows(v, out);                                              // of all i
  p.addRows(v, out);                                              // out += sum v_i r_i'
  { p.factorise(v, factor) } -> std::convertible_to<bool>;        // A + sum v_i r_i' r_i; an empty v is zero
  factor.solveInPlace(out);
};

struct InteriorPointLimits {
  int iterations = 40;            ///< At most.
  double complementarity = 1e-3;  ///< In units of the objective.
  double residual = 1e-4;  ///< In standard deviations of the constrained quantities, where the objective is chi2.
  double abortAbove = std::numeric_limits<double>::infinity();  ///< Stop when the objective is proven to exceed this.
};

struct InteriorPointResult {
  /// Converged; Exact without rows; ToleranceLimited when `abortAbove` was exceeded; IterationLimit; NoProgress when
  /// several steps in a row were next to nothing; Degenerate when a system was singular; NotRun when it was cancelled.
  Termination why = Termination::NotRun;
  Eigen::VectorXd x;
  double objective = 0.0;   ///< x'Ax - 2b'x.
  double lowerBound = 0.0;  ///< No feasible x has a smaller objective.
  int iterations = 0;
};

/// Mehrotra's predictor-corrector method (On the implementation of a primal-dual interior point method, SIAM J. Optim.
/// 2, 1992). All rows are scaled by one number, the standard deviation of the middle row, so that slacks and
/// multipliers of one are a sound start for every problem; rows of different kinds should come in like units.
template <QuadraticProgram Problem>
class InteriorPoint {
 public:
  InteriorPoint(const Problem& problem, const InteriorPointLimits& limits, CancelCheck check = {})
      : problem_(problem), limits_(limits), check_(check) {}

  InteriorPointResult solve() {
    InteriorPointResult result;
    if (!problem_.factorise(Eigen::VectorXd(), plain_)) {
      result.why = Termination::Degenerate;
      result.x = Eigen::VectorXd::Zero(problem_.size());
      return result;
    }
    x_ = problem_.linear();
    plain_.solveInPlace(x_);
    result.lowerBound = -problem_.linear().dot(x_);
    const bool hasRows = problem_.rowCount() > 0;
    result.why = hasRows ? iterateAll(result) : Termination::Exact;
    if (hasRows) result.lowerBound = std::max(result.lowerBound, lowerBound());
    problem_.multiply(x_, product_);
    result.objective = x_.dot(product_) - 2.0 * problem_.linear().dot(x_);
    result.x = std::move(x_);
    return result;
  }

 private:
  static constexpr double kStep = 0.99;  // of the longest step that leaves slacks and multipliers positive
  /// So many steps in a row below this share leave everything as it is: the rows ask for what lies so far off, in units
  /// of their scale, or contradict each other so much, that slacks and multipliers of one are no start.
  static constexpr int kStuckSteps = 5;
  static constexpr double kStuck = 1e-10;  // of a whole step

  /// All rows, scaled.
  void rows(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
    problem_.dotRows(v, out);
    out *= scale_;
  }

  Termination iterateAll(InteriorPointResult& result) {
    const Eigen::Index count = problem_.rowCount();
    setScale(count / 2);
    bounds_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) bounds_[i] = scale_ * problem_.bound(i);
    rows(x_, s_);
    s_ = (s_ - bounds_).cwiseMax(1.0);
    z_ = Eigen::VectorXd::Ones(count);
    const bool mayAbort = std::isfinite(limits_.abortAbove);
    int stuck = 0;  // steps in a row
    for (;; ++result.iterations) {
      residuals();
      if (mayAbort) result.lowerBound = std::max(result.lowerBound, lowerBound());
      if (s_.dot(z_) < limits_.complementarity && primal_.cwiseAbs().maxCoeff() < limits_.residual) {
        return Termination::Converged;
      }
      if (result.lowerBound > limits_.abortAbove) return Termination::ToleranceLimited;
      if (result.iterations >= limits_.iterations) return Termination::IterationLimit;
      if (stuck >= kStuckSteps) return Termination::NoProgress;
      if (check_.isCancelled()) return Termination::NotRun;
      const auto step = iterate();
      if (!step) return check_.isCancelled() ? Termination::NotRun : Termination::Degenerate;
      stuck = *step < kStuck ? stuck + 1 : 0;
    }
  }

  void setScale(Eigen::Index middle) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(problem_.size());
    problem_.addRow(middle, 1.0, unit);
    plain_.solveInPlace(unit);
    const double variance = problem_.dotRow(middle, unit);
    scale_ = variance > 0.0 && std::isfinite(variance) ? 1.0 / std::sqrt(variance) : 1.0;
  }

  /// Residuals A x - b - G'z and G x - h - s.
  void residuals() {
    problem_.multiply(x_, product_);
    dual_ = product_ - problem_.linear();
    weights_ = -scale_ * z_;
    problem_.addRows(weights_, dual_);
    rows(x_, primal_);
    primal_ = primal_ - bounds_ - s_;
  }

  /// Lagrange's dual value for the multipliers: a proven lower bound.
  double lowerBound() {
    double lagrangian = x_.dot(product_) - 2.0 * problem_.linear().dot(x_);
    for (Eigen::Index i = 0; i < z_.size(); ++i) lagrangian -= 2.0 * z_[i] * (primal_[i] + s_[i]);
    solved_ = dual_;
    plain_.solveInPlace(solved_);
    return lagrangian - dual_.dot(solved_);
  }

  /// The Newton step dx_, ds_, dz_ for the complementarity target rc_.
  void direction() {
    dx_ = -dual_;
    weights_ = (-scale_ * (rc_ + z_.cwiseProduct(primal_))).cwiseQuotient(s_);
    problem_.addRows(weights_, dx_);
    factor_.solveInPlace(dx_);
    rows(dx_, ds_);
    ds_ += primal_;
    dz_ = -(rc_ + z_.cwiseProduct(ds_)).cwiseQuotient(s_);
  }

  double longestStep() const {
    double step = 1.0;
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      if (ds_[i] < 0.0) step = std::min(step, -s_[i] / ds_[i]);
      if (dz_[i] < 0.0) step = std::min(step, -z_[i] / dz_[i]);
    }
    return step;
  }

  /// @return the share of the way that was gone; none where a system is singular, and when the run is cancelled.
  std::optional<double> iterate() {
    weights_ = scale_ * scale_ * z_.cwiseQuotient(s_);
    if (!problem_.factorise(weights_, factor_) || check_.isCancelled()) return std::nullopt;
    const Eigen::Index count = s_.size();
    rc_ = s_.cwiseProduct(z_);
    direction();
    const double affine = longestStep();
    const double mu = s_.dot(z_) / static_cast<double>(count);
    const double muAffine = (s_ + affine * ds_).dot(z_ + affine * dz_) / static_cast<double>(count);
    const double sigma = std::pow(std::clamp(muAffine / mu, 0.0, 1.0), 3);
    rc_ += ds_.cwiseProduct(dz_) - Eigen::VectorXd::Constant(count, sigma * mu);
    direction();
    if (!dx_.allFinite() || !ds_.allFinite() || !dz_.allFinite()) return std::nullopt;
    const double step = std::min(1.0, kStep * longestStep());
    x_ += step * dx_;
    s_ += step * ds_;
    z_ += step * dz_;
    return step;
  }

  const Problem& problem_;
  InteriorPointLimits limits_;
  CancelCheck check_;
  typename Problem::Factor plain_, factor_;  ///< Of A, and of the Newton step.
  double scale_ = 1.0;
  Eigen::VectorXd x_, s_, z_, dual_, primal_, bounds_;  ///< Unknowns, slacks, multipliers, residuals; h, scaled.
  Eigen::VectorXd dx_, ds_, dz_, rc_, weights_;         ///< Of the step.
  Eigen::VectorXd product_, solved_;                    ///< A x_; what lowerBound() works in.
};

}  // namespace batten
