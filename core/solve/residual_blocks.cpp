// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/residual_blocks.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {

namespace {

constexpr int kAttempts = 12;             ///< Dampings tried before a step is given up: up to 4^12 of the first.
constexpr double kDifferenceStep = 1e-5;  ///< Of an unknown's scale: about the cube root of the rounding error.
/// Of the largest diagonal: an unknown that nothing depends on must not make the system singular.
constexpr double kDiagonalFloor = 1e-12;

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

Linearised linearised(std::span<const ResidualBlock> blocks, const Eigen::VectorXd& x, const Eigen::VectorXd& scales) {
  const auto n = x.size();
  std::vector<Eigen::Triplet<double>> entries;
  Linearised result{Eigen::SparseMatrix<double>(n, n), Eigen::VectorXd::Zero(n)};
  std::vector<double> local, r, ahead, behind;
  for (const ResidualBlock& block : blocks) {
    gather(block, x, local);
    r.assign(block.size, 0.0);
    block.evaluate(local, r);
    Eigen::MatrixXd jacobian(block.size, static_cast<Eigen::Index>(local.size()));
    for (std::size_t c = 0; c < local.size(); ++c) {
      const double step = kDifferenceStep * scales(block.columns[c]), here = local[c];
      ahead.assign(block.size, 0.0);
      behind.assign(block.size, 0.0);
      local[c] = here + step;
      block.evaluate(local, ahead);
      local[c] = here - step;
      block.evaluate(local, behind);
      local[c] = here;
      for (int i = 0; i < block.size; ++i) {
        const double slope = (ahead[i] - behind[i]) / (2.0 * step);
        jacobian(i, static_cast<Eigen::Index>(c)) = std::isfinite(slope) ? slope : 0.0;
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

class BlockProblem final : public LevenbergProblem {
 public:
  BlockProblem(const Eigen::VectorXd& start, const Eigen::VectorXd& scales, std::span<const ResidualBlock> blocks)
      : scales_(scales), blocks_(blocks), x_(start), cost_(sumOfSquares(blocks, start)) {}

  const Eigen::VectorXd& x() const { return x_; }
  double cost() const { return cost_; }

  double linearise() override {
    if (!std::isfinite(cost_)) return cost_;
    system_ = linearised(blocks_, x_, scales_);
    diagonal_ = system_.squared.diagonal();
    diagonal_ = diagonal_.cwiseMax(kDiagonalFloor * std::max(diagonal_.maxCoeff(), std::numeric_limits<double>::min()));
    return cost_;
  }
  double tryStep(double damping) override {
    Eigen::SparseMatrix<double> damped = system_.squared;
    for (Eigen::Index i = 0; i < diagonal_.size(); ++i) damped.coeffRef(i, i) += damping * diagonal_(i);
    solver_.compute(damped);
    trial_ = x_ - solver_.solve(system_.gradient);
    trialCost_ = solver_.info() == Eigen::Success && trial_.allFinite() ? sumOfSquares(blocks_, trial_)
                                                                        : std::numeric_limits<double>::infinity();
    return trialCost_;
  }
  void accept() override {
    x_ = trial_;
    cost_ = trialCost_;
  }

 private:
  const Eigen::VectorXd& scales_;
  std::span<const ResidualBlock> blocks_;
  Eigen::VectorXd x_, trial_, diagonal_;
  double cost_, trialCost_ = 0.0;
  Linearised system_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace

BlockSolution minimiseBlocks(const Eigen::VectorXd& start, const Eigen::VectorXd& scales,
                             std::span<const ResidualBlock> blocks, const RunContext& context) {
  BlockProblem problem(start, scales, blocks);
  BlockSolution result;
  result.before = problem.cost();
  LevenbergOptions options;
  options.attempts = kAttempts;
  result.run = levenbergMarquardt(problem, options, context);
  result.x = problem.x();
  return result;
}

}  // namespace batten
