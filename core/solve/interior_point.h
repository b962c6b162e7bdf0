// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

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
  { p.multiply(v) } -> std::convertible_to<Eigen::VectorXd>;      // A v
  { p.bound(i) } -> std::convertible_to<double>;                  // h_i
  { p.dotRow(i, v) } -> std::convertible_to<double>;              // r_i . v
  p.addRow(i, 1.0, out);                                          // out += factor r_i'
  { p.factorise(v, factor) } -> std::convertible_to<bool>;        // A + sum v_i r_i' r_i; an empty v is zero
  factor.solveInPlace(out);
};

struct InteriorPointLimits {
  int iterations = 40;
  double complementarity = 1e-3;  ///< In units of the objective.
  double residual = 1e-4;  ///< In standard deviations of the constrained quantities, where the objective is chi2.
  double abortAbove = std::numeric_limits<double>::infinity();  ///< Stop when the objective is proven to exceed this.
};

struct InteriorPointResult {
  /// Converged; Exact without rows; ToleranceLimited when `abortAbove` was exceeded; IterationLimit; Degenerate when a
  /// system was singular; NotRun when it was cancelled.
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
    result.why = problem_.rowCount() == 0 ? Termination::Exact : iterateAll(result);
    result.x = x_;
    result.objective = x_.dot(problem_.multiply(x_)) - 2.0 * problem_.linear().dot(x_);
    return result;
  }

 private:
  static constexpr double kStep = 0.99;

  double row(Eigen::Index i, const Eigen::VectorXd& v) const { return scale_ * problem_.dotRow(i, v); }

  Termination iterateAll(InteriorPointResult& result) {
    const Eigen::Index count = problem_.rowCount();
    setScale(count / 2);
    s_.resize(count);
    z_ = Eigen::VectorXd::Ones(count);
    primal_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) s_[i] = std::max(row(i, x_) - scale_ * problem_.bound(i), 1.0);
    for (;; ++result.iterations) {
      residuals();
      result.lowerBound = std::max(result.lowerBound, lowerBound());
      if (s_.dot(z_) < limits_.complementarity && primal_.cwiseAbs().maxCoeff() < limits_.residual) {
        return Termination::Converged;
      }
      if (result.lowerBound > limits_.abortAbove) return Termination::ToleranceLimited;
      if (result.iterations >= limits_.iterations) return Termination::IterationLimit;
      if (check_.isCancelled()) return Termination::NotRun;
      if (!iterate()) return check_.isCancelled() ? Termination::NotRun : Termination::Degenerate;
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
    dual_ = problem_.multiply(x_) - problem_.linear();
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      problem_.addRow(i, -scale_ * z_[i], dual_);
      primal_[i] = row(i, x_) - scale_ * problem_.bound(i) - s_[i];
    }
  }

  /// Lagrange's dual value for the multipliers: a proven lower bound.
  double lowerBound() const {
    double lagrangian = x_.dot(problem_.multiply(x_)) - 2.0 * problem_.linear().dot(x_);
    for (Eigen::Index i = 0; i < z_.size(); ++i) lagrangian -= 2.0 * z_[i] * (primal_[i] + s_[i]);
    Eigen::VectorXd solved = dual_;
    plain_.solveInPlace(solved);
    return lagrangian - dual_.dot(solved);
  }

  /// The Newton step for the complementarity target `rc`.
  void direction(const typename Problem::Factor& m, const Eigen::VectorXd& rc, Eigen::VectorXd& dx, Eigen::VectorXd& ds,
                 Eigen::VectorXd& dz) const {
    dx = -dual_;
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      problem_.addRow(i, -scale_ * (rc[i] + z_[i] * primal_[i]) / s_[i], dx);
    }
    m.solveInPlace(dx);
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      ds[i] = row(i, dx) + primal_[i];
      dz[i] = -(rc[i] + z_[i] * ds[i]) / s_[i];
    }
  }

  double longestStep(const Eigen::VectorXd& ds, const Eigen::VectorXd& dz) const {
    double step = 1.0;
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      if (ds[i] < 0.0) step = std::min(step, -s_[i] / ds[i]);
      if (dz[i] < 0.0) step = std::min(step, -z_[i] / dz[i]);
    }
    return step;
  }

  bool iterate() {
    typename Problem::Factor m;
    if (!problem_.factorise(scale_ * scale_ * z_.cwiseQuotient(s_), m) || check_.isCancelled()) return false;
    const Eigen::Index count = s_.size();
    Eigen::VectorXd dx, ds(count), dz(count), rc = s_.cwiseProduct(z_);
    direction(m, rc, dx, ds, dz);
    const double affine = longestStep(ds, dz);
    const double mu = s_.dot(z_) / static_cast<double>(count);
    const double muAffine = (s_ + affine * ds).dot(z_ + affine * dz) / static_cast<double>(count);
    const double sigma = std::pow(std::clamp(muAffine / mu, 0.0, 1.0), 3);
    rc += ds.cwiseProduct(dz) - Eigen::VectorXd::Constant(count, sigma * mu);
    direction(m, rc, dx, ds, dz);
    if (!dx.allFinite() || !ds.allFinite() || !dz.allFinite()) return false;
    const double step = std::min(1.0, kStep * longestStep(ds, dz));
    x_ += step * dx;
    s_ += step * ds;
    z_ += step * dz;
    return true;
  }

  const Problem& problem_;
  InteriorPointLimits limits_;
  CancelCheck check_;
  typename Problem::Factor plain_;
  double scale_ = 1.0;
  Eigen::VectorXd x_, s_, z_, dual_, primal_;  ///< Unknowns, slacks, multipliers, residuals.
};

}  // namespace batten
