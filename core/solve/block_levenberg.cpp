// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/block_levenberg.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {

namespace {

constexpr int kMaxIterations = 40;
constexpr double kSmallDecrease = 1e-4;

void gather(const ResidualBlock& block, const Eigen::VectorXd& x, std::vector<double>& local) {
  local.resize(block.columns.size());
  for (std::size_t i = 0; i < local.size(); ++i) local[i] = x(block.columns[i]);
}

double sumOfSquares(std::span<const ResidualBlock> blocks, const Eigen::VectorXd& x) {
  double sum = 0.0;
  std::vector<double> local, residuals;
  for (const ResidualBlock& block : blocks) {
    gather(block, x, local);
    residuals.assign(block.size, 0.0);
    block.evaluate(local, residuals);
    for (const double r : residuals) sum += r * r;
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

struct Linearised {
  Eigen::SparseMatrix<double> squared;  ///< J'J, lower part.
  Eigen::VectorXd gradient;             ///< J'r
};

Linearised linearise(std::span<const ResidualBlock> blocks, const Eigen::VectorXd& x, const Eigen::VectorXd& scales) {
  const auto n = x.size();
  std::vector<Eigen::Triplet<double>> entries;
  Linearised result{Eigen::SparseMatrix<double>(n, n), Eigen::VectorXd::Zero(n)};
  std::vector<double> local, r, ahead, behind;
  for (const ResidualBlock& block : blocks) {
    gather(block, x, local);
    const auto rows = static_cast<std::size_t>(block.size);
    r.assign(rows, 0.0);
    block.evaluate(local, r);
    Eigen::MatrixXd jacobian(block.size, static_cast<Eigen::Index>(local.size()));
    for (std::size_t c = 0; c < local.size(); ++c) {
      const double step = 1e-5 * scales(block.columns[c]), here = local[c];
      ahead.assign(rows, 0.0);
      behind.assign(rows, 0.0);
      local[c] = here + step;
      block.evaluate(local, ahead);
      local[c] = here - step;
      block.evaluate(local, behind);
      local[c] = here;
      for (std::size_t i = 0; i < rows; ++i) {
        const double slope = (ahead[i] - behind[i]) / (2.0 * step);
        jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = std::isfinite(slope) ? slope : 0.0;
      }
    }
    const Eigen::MatrixXd product = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * Eigen::Map<Eigen::VectorXd>(r.data(), block.size);
    for (Eigen::Index i = 0; i < product.rows(); ++i) {
      const int row = block.columns[i];
      result.gradient(row) += gradient(i);
      for (Eigen::Index j = 0; j < product.cols(); ++j) {
        const int column = block.columns[j];
        if (row >= column) entries.emplace_back(row, column, product(i, j));
      }
    }
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.0);
  result.squared.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

LevenbergResult minimiseBlocks(const Eigen::VectorXd& start, const Eigen::VectorXd& scales,
                               std::span<const ResidualBlock> blocks, const RunContext& context) {
  LevenbergResult result;
  result.x = start;
  result.before = result.after = sumOfSquares(blocks, start);
  result.why = Termination::IterationLimit;
  if (!std::isfinite(result.before)) {
    result.why = Termination::Degenerate;
    return result;
  }
  double damping = 1e-3;
  int small = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  for (; result.iterations < kMaxIterations && !context.isCancelled(); ++result.iterations) {
    const Linearised system = linearise(blocks, result.x, scales);
    const Eigen::VectorXd diagonal = system.squared.diagonal();
    // An unknown that nothing depends on must not make the system singular.
    const double floor = 1e-12 * std::max(diagonal.maxCoeff(), std::numeric_limits<double>::min());
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      Eigen::SparseMatrix<double> damped = system.squared;
      for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
        damped.coeffRef(i, i) += damping * std::max(diagonal(i), floor);
      }
      solver.compute(damped);
      const Eigen::VectorXd trial = result.x - solver.solve(system.gradient);
      const double cost = solver.info() == Eigen::Success && trial.allFinite()
                              ? sumOfSquares(blocks, trial)
                              : std::numeric_limits<double>::infinity();
      better = cost < result.after;
      damping = better ? std::max(damping / 5.0, 1e-12) : damping * 4.0;
      if (!better) continue;
      small = result.after - cost < kSmallDecrease * result.after ? small + 1 : 0;
      result.x = trial;
      result.after = cost;
    }
    if (!better || small >= 2 || result.after == 0.0) {
      result.why = better ? Termination::Converged : Termination::NoProgress;
      break;
    }
  }
  return result;
}

}  // namespace batten
