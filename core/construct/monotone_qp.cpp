// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/monotone_qp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace batten {
namespace {

constexpr int kIterationLimit = 40;
constexpr double kComplementarity = 1e-3;  // in units of the objective (chi2), where 1 is one standard deviation
constexpr double kResidual = 1e-4;         // in standard deviations of the constrained quantities
constexpr double kStep = 0.99;

/// Factorises, with a tiny ridge relative to the diagonal when the plain factors fail.
bool factorSafely(BandCholesky& cholesky, const BandMatrix& m) {
  if (cholesky.factor(m)) return true;
  BandMatrix lifted = m;
  for (int i = 0; i < m.size(); ++i) lifted.entry(i, 0) *= 1.0 + 1e-13;
  return cholesky.factor(lifted);
}

/// One number for all rows: the standard deviation of the middle one. Keeps s = 1, z = 1 a sound start for every
/// problem.
double rowScale(const BandCholesky& a, const MonotoneQp& qp) {
  if (qp.rows.empty()) return 1.0;
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(qp.b.size());
  const BandRow& middle = qp.rows[qp.rows.size() / 2];
  addTo(unit, middle, 1.0);
  const double variance = dot(middle, a.solve(unit));
  return variance > 0.0 && std::isfinite(variance) ? 1.0 / std::sqrt(variance) : 1.0;
}

struct InteriorPoint {
  const MonotoneQp& qp;
  BandCholesky a;
  double scale = 1.0;
  Eigen::VectorXd x, s, z;       ///< Unknowns, slacks, multipliers.
  Eigen::VectorXd dual, primal;  ///< Residuals A x - b - G'z and G x - h - s.

  double row(std::size_t i, const Eigen::VectorXd& v) const { return scale * dot(qp.rows[i], v); }

  void residuals() {
    dual = qp.a * x - qp.b;
    for (std::size_t i = 0; i < qp.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      addTo(dual, qp.rows[i], -scale * z[at]);
      primal[at] = row(i, x) - scale * qp.bounds[i] - s[at];
    }
  }

  /// Lagrange dual value for the multipliers z (half the objective's scale removed): a proven lower bound.
  double lowerBound() const {
    const Eigen::VectorXd ax = qp.a * x;
    double lagrangian = x.dot(ax) - 2.0 * qp.b.dot(x);
    for (Eigen::Index i = 0; i < z.size(); ++i) lagrangian -= 2.0 * z[i] * (primal[i] + s[i]);
    return lagrangian - dual.dot(a.solve(dual));
  }

  /// The Newton step for the complementarity target `rc`.
  void direction(const BandCholesky& m, const Eigen::VectorXd& rc, Eigen::VectorXd& dx, Eigen::VectorXd& ds,
                 Eigen::VectorXd& dz) const {
    dx = -dual;
    for (std::size_t i = 0; i < qp.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      addTo(dx, qp.rows[i], -scale * (rc[at] + z[at] * primal[at]) / s[at]);
    }
    m.solveInPlace(dx);
    for (std::size_t i = 0; i < qp.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      ds[at] = row(i, dx) + primal[at];
      dz[at] = -(rc[at] + z[at] * ds[at]) / s[at];
    }
  }

  double longestStep(const Eigen::VectorXd& ds, const Eigen::VectorXd& dz) const {
    double step = 1.0;
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      if (ds[i] < 0.0) step = std::min(step, -s[i] / ds[i]);
      if (dz[i] < 0.0) step = std::min(step, -z[i] / dz[i]);
    }
    return step;
  }

  bool iterate() {
    BandMatrix normal = qp.a;
    for (std::size_t i = 0; i < qp.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      normal.addOuter(qp.rows[i], scale * scale * z[at] / s[at]);
    }
    BandCholesky m;
    if (!factorSafely(m, normal)) return false;
    const Eigen::Index count = s.size();
    Eigen::VectorXd dx, ds(count), dz(count), rc = s.cwiseProduct(z);
    direction(m, rc, dx, ds, dz);
    const double affine = longestStep(ds, dz);
    const double mu = s.dot(z) / static_cast<double>(count);
    const double muAffine = (s + affine * ds).dot(z + affine * dz) / static_cast<double>(count);
    const double sigma = std::pow(std::clamp(muAffine / mu, 0.0, 1.0), 3);
    rc += ds.cwiseProduct(dz) - Eigen::VectorXd::Constant(count, sigma * mu);
    direction(m, rc, dx, ds, dz);
    if (!dx.allFinite() || !ds.allFinite() || !dz.allFinite()) return false;
    const double step = std::min(1.0, kStep * longestStep(ds, dz));
    x += step * dx;
    s += step * ds;
    z += step * dz;
    return true;
  }
};

}  // namespace

MonotoneQpResult solveMonotoneQp(const MonotoneQp& qp, double abortAbove) {
  MonotoneQpResult result;
  InteriorPoint point{qp, {}, 1.0, {}, {}, {}, {}, {}};
  if (!factorSafely(point.a, qp.a)) {
    result.why = Termination::Degenerate;
    result.x = Eigen::VectorXd::Zero(qp.b.size());
    return result;
  }
  const auto count = static_cast<Eigen::Index>(qp.rows.size());
  point.x = point.a.solve(qp.b);
  point.scale = rowScale(point.a, qp);
  point.s = Eigen::VectorXd::Ones(count);
  point.z = Eigen::VectorXd::Ones(count);
  point.primal.resize(count);
  for (std::size_t i = 0; i < qp.rows.size(); ++i) {
    point.s[static_cast<Eigen::Index>(i)] = std::max(point.row(i, point.x) - point.scale * qp.bounds[i], 1.0);
  }
  result.why = Termination::IterationLimit;
  result.lowerBound = -qp.b.dot(point.x);
  if (count == 0) result.why = Termination::Exact;
  for (; count > 0; ++result.iterations) {
    point.residuals();
    result.lowerBound = std::max(result.lowerBound, point.lowerBound());
    const double gap = point.s.dot(point.z);
    const double worst = point.primal.cwiseAbs().maxCoeff();
    if (gap < kComplementarity && worst < kResidual) {
      result.why = Termination::Converged;
      break;
    }
    if (result.lowerBound > abortAbove) {
      result.why = Termination::ToleranceLimited;
      break;
    }
    if (result.iterations == kIterationLimit) break;
    if (!point.iterate()) {
      result.why = Termination::Degenerate;
      break;
    }
  }
  result.x = point.x;
  result.objective = point.x.dot(qp.a * point.x) - 2.0 * qp.b.dot(point.x);
  return result;
}

}  // namespace batten
