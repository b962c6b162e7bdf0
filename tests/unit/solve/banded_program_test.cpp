// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_program.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace batten {
namespace {

struct Problem {
  BandedProgram qp;
  Eigen::MatrixXd a, g;
  Eigen::VectorXd h;
};

Problem randomProblem(int n, bool cyclic, int constraints, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Problem p;
  p.qp.a = BandedMatrix(n, BandRow::kHalfWidth, cyclic);
  p.a = Eigen::MatrixXd::Zero(n, n);
  const auto randomRow = [&](int first) {
    BandRow row;
    row.first = first;
    for (double& v : row.v) v = normal(random);
    return row;
  };
  const auto full = [&](const BandRow& row) {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
    addTo(v, row, 1.0);
    return v;
  };
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (int first = 0; first < (cyclic ? n : n - 5); ++first) {
      const BandRow row = randomRow(first);
      p.qp.a.addOuter(row, 1.0);
      p.a += full(row) * full(row).transpose();
    }
  }
  p.qp.b.resize(n);
  Eigen::VectorXd inside(n);
  for (int i = 0; i < n; ++i) {
    p.qp.b[i] = 3.0 * normal(random);
    inside[i] = normal(random);
  }
  p.g.resize(constraints, n);
  p.h.resize(constraints);
  for (int i = 0; i < constraints; ++i) {
    const BandRow row = randomRow(static_cast<int>(random() % static_cast<unsigned>(cyclic ? n : n - 5)));
    p.qp.rows.push_back(row);
    p.g.row(i) = full(row).transpose();
    p.h[i] = p.g.row(i).dot(inside) - 0.3;  // a feasible point exists
    p.qp.bounds.push_back(p.h[i]);
  }
  return p;
}

InteriorPointLimits abortAbove(double objective) {
  InteriorPointLimits limits;
  limits.abortAbove = objective;
  return limits;
}

/// The optimum over all active sets: for each, the equality-constrained minimum, kept if feasible. Slow and sure.
double bruteForce(const Problem& p) {
  const int n = static_cast<int>(p.a.rows()), m = static_cast<int>(p.g.rows());
  double best = std::numeric_limits<double>::infinity();
  for (int set = 0; set < (1 << m); ++set) {
    std::vector<int> active;
    for (int i = 0; i < m; ++i) {
      if (set & (1 << i)) active.push_back(i);
    }
    const int k = static_cast<int>(active.size());
    if (k > n) continue;
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + k, n + k);
    Eigen::VectorXd right(n + k);
    kkt.topLeftCorner(n, n) = p.a;
    right.head(n) = p.qp.b;
    for (int j = 0; j < k; ++j) {
      kkt.block(n + j, 0, 1, n) = p.g.row(active[j]);
      kkt.block(0, n + j, n, 1) = p.g.row(active[j]).transpose();
      right[n + j] = p.h[active[j]];
    }
    const Eigen::VectorXd x = kkt.fullPivLu().solve(right).head(n);
    if (((p.g * x - p.h).array() < -1e-7).any()) continue;
    best = std::min(best, x.dot(p.a * x) - 2.0 * p.qp.b.dot(x));
  }
  return best;
}

TEST(BandedProgram, ReachesTheBestActiveSet) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Problem p = randomProblem(seed % 2 ? 9 : 12, seed % 3 == 0, 7, seed);
    const double best = bruteForce(p);
    const InteriorPointResult result = solveProgram(p.qp);
    ASSERT_EQ(result.why, Termination::Converged) << seed;
    EXPECT_LE(result.iterations, 25) << seed;
    EXPECT_NEAR(result.objective, best, 5e-3) << seed;
    EXPECT_LE(result.lowerBound, best + 1e-6) << seed;
    const Eigen::VectorXd slack = p.g * result.x - p.h;
    EXPECT_GT(slack.minCoeff(), -1e-3) << seed;
  }
}

TEST(BandedProgram, WithoutConstraintsItIsTheLinearSolution) {
  Problem p = randomProblem(15, false, 0, 3);
  const InteriorPointResult result = solveProgram(p.qp);
  EXPECT_EQ(result.why, Termination::Exact);
  const Eigen::VectorXd reference = p.a.ldlt().solve(p.qp.b);
  EXPECT_LT((result.x - reference).norm(), 1e-9 * reference.norm());
}

TEST(BandedProgram, StopsOnceTheObjectiveIsProvenTooLarge) {
  const Problem p = randomProblem(12, false, 7, 5);
  const double best = bruteForce(p);
  const double free = -p.qp.b.dot(p.a.ldlt().solve(p.qp.b));
  ASSERT_GT(best, free);
  const InteriorPointResult cut = solveProgram(p.qp, abortAbove(free + 0.2 * (best - free)));
  EXPECT_EQ(cut.why, Termination::ToleranceLimited);
  EXPECT_GT(cut.lowerBound, free + 0.2 * (best - free));
  EXPECT_LE(cut.lowerBound, best + 1e-6);
  EXPECT_EQ(solveProgram(p.qp, abortAbove(best + 1.0)).why, Termination::Converged);
}

TEST(BandedProgram, AnImpossibleProgramEndsWithoutNumbersThatAreNone) {
  Problem p = randomProblem(12, false, 1, 6);
  p.qp.rows.push_back(p.qp.rows[0]);
  for (double& v : p.qp.rows.back().v) v = -v;
  p.qp.bounds.push_back(-p.qp.bounds[0] + 5.0);  // a x >= h and -a x >= 5 - h
  const InteriorPointResult result = solveProgram(p.qp, abortAbove(1e6));
  EXPECT_NE(result.why, Termination::Converged);
  EXPECT_TRUE(result.x.allFinite());
}

TEST(BandedProgram, GroupedRowsGiveWhatTheSameRowsOfABandGive) {
  const Problem p = randomProblem(14, false, 9, 11);
  GroupedProgram grouped{p.qp.a, p.qp.b, {}, p.qp.bounds};
  for (const BandRow& row : p.qp.rows) {
    std::array<int, 6> index;
    std::iota(index.begin(), index.end(), row.first);
    grouped.rows.add(index, row.v);
  }
  const InteriorPointResult a = solveProgram(p.qp), b = solveProgram(grouped);
  EXPECT_EQ(b.why, Termination::Converged);
  EXPECT_LT((a.x - b.x).norm(), 1e-9 * a.x.norm());
}

}  // namespace
}  // namespace batten
