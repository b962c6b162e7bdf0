// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/nonnegative_least_squares.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <vector>

#include "core/solve/dense_solve.h"

namespace batten {
namespace {

/// The unconstrained least squares solution with all columns outside `passive` held at zero.
Eigen::VectorXd solvePassive(const Eigen::MatrixXd& e, const Eigen::VectorXd& f,
                             const std::vector<Eigen::Index>& passive) {
  Eigen::MatrixXd sub(e.rows(), static_cast<Eigen::Index>(passive.size()));
  for (std::size_t k = 0; k < passive.size(); ++k) sub.col(static_cast<Eigen::Index>(k)) = e.col(passive[k]);
  return leastSquares(sub, f);
}

}  // namespace

std::optional<Eigen::VectorXd> nonnegativeLeastSquares(const Eigen::MatrixXd& e, const Eigen::VectorXd& f) {
  const Eigen::Index n = e.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> passive;
  std::vector<bool> isPassive(n, false);
  const double tolerance = 1e-13 * std::max(1.0, e.cwiseAbs().maxCoeff()) * std::max(f.norm(), 1e-300);
  for (Eigen::Index change = 0; change < 3 * n + 10; ++change) {
    const Eigen::VectorXd gradient = e.transpose() * (f - e * x);
    std::optional<Eigen::Index> best;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (isPassive[j] || gradient[j] <= tolerance) continue;
      if (!best || gradient[j] > gradient[*best]) best = j;
    }
    if (!best || std::ssize(passive) >= e.rows()) return x;
    passive.push_back(*best);
    isPassive[*best] = true;
    bool entered = true;
    while (!passive.empty()) {
      const Eigen::VectorXd z = solvePassive(e, f, passive);
      // A column that rounding keeps from becoming positive would cycle for ever: give it back.
      if (entered && z[z.size() - 1] <= 0.0) {
        isPassive[passive.back()] = false;
        passive.pop_back();
        return x;
      }
      entered = false;
      double step = 1.0;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double zk = z[static_cast<Eigen::Index>(k)], xk = x[passive[k]];
        if (zk <= 0.0) step = std::min(step, xk / (xk - zk));
      }
      for (std::size_t k = 0; k < passive.size(); ++k) {
        x[passive[k]] += step * (z[static_cast<Eigen::Index>(k)] - x[passive[k]]);
      }
      if (step >= 1.0) break;
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const bool stays = z[static_cast<Eigen::Index>(k)] > 0.0 || x[passive[k]] > 1e-15 * x.cwiseAbs().maxCoeff();
        if (stays && x[passive[k]] > 0.0) {
          kept.push_back(passive[k]);
        } else {
          x[passive[k]] = 0.0;
          isPassive[passive[k]] = false;
        }
      }
      if (kept.size() == passive.size()) break;
      passive = std::move(kept);
    }
  }
  return std::nullopt;
}

std::optional<Eigen::VectorXd> constrainedLeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                                       const Eigen::MatrixXd& g, const Eigen::VectorXd& h) {
  const Eigen::Index n = a.cols();
  if (a.rows() < n || n == 0) return std::nullopt;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  if (!(r.diagonal().cwiseAbs().minCoeff() > 1e-12 * r.diagonal().cwiseAbs().maxCoeff())) return std::nullopt;
  const Eigen::VectorXd qy = (qr.householderQ().transpose() * y).head(n);
  // z = R x - Q'y turns the task into: the shortest z with (G R^-1) z >= h - G R^-1 Q'y.
  Eigen::MatrixXd gz = r.transpose().triangularView<Eigen::Lower>().solve(g.transpose()).transpose();
  Eigen::VectorXd hz = h - gz * qy;
  for (Eigen::Index i = 0; i < gz.rows(); ++i) {
    const double length = gz.row(i).norm();
    if (length > 0.0) {
      gz.row(i) /= length;
      hz[i] /= length;
    }
  }
  const double scale = std::max(hz.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Eigen::MatrixXd e(n + 1, gz.rows());
  e.topRows(n) = gz.transpose();
  e.row(n) = hz.transpose() / scale;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n + 1);
  f[n] = 1.0;
  const auto u = nonnegativeLeastSquares(e, f);
  if (!u) return std::nullopt;
  const Eigen::VectorXd residual = e * *u - f;
  if (!(std::abs(residual[n]) > 1e-12)) return std::nullopt;
  const Eigen::VectorXd z = -residual.head(n) / residual[n] * scale;
  const Eigen::VectorXd x = r.triangularView<Eigen::Upper>().solve(z + qy);
  if (!x.allFinite()) return std::nullopt;
  return x;
}

}  // namespace batten
