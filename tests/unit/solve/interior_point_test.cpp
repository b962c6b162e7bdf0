// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/interior_point.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <optional>
#include <random>

namespace batten {
namespace {

/// min x'Ax - 2b'x subject to G x >= h, all dense.
struct DenseProgram {
  struct Factor {
    Eigen::LDLT<Eigen::MatrixXd> ldlt;
    void solveInPlace(Eigen::VectorXd& v) const { v = ldlt.solve(v).eval(); }
  };
  Eigen::MatrixXd a, g;
  Eigen::VectorXd b, h;

  Eigen::Index size() const { return b.size(); }
  Eigen::Index rowCount() const { return h.size(); }
  const Eigen::VectorXd& linear() const { return b; }
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const { out = a * v; }
  double bound(Eigen::Index i) const { return h[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return g.row(i).dot(v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { out += factor * g.row(i).transpose(); }
  void dotRows(const Eigen::VectorXd& v, Eigen::VectorXd& out) const { out = g * v; }
  void addRows(const Eigen::VectorXd& weights, Eigen::VectorXd& out) const { out += g.transpose() * weights; }
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    Eigen::MatrixXd m = a;
    if (weights.size() > 0) m += g.transpose() * weights.asDiagonal() * g;
    factor.ldlt.compute(m);
    return factor.ldlt.info() == Eigen::Success && factor.ldlt.isPositive() && factor.ldlt.vectorD().minCoeff() > 0.0;
  }
  double objective(const Eigen::VectorXd& x) const { return x.dot(a * x) - 2.0 * b.dot(x); }
};

DenseProgram randomProgram(int size, int rows, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto fill = [&](auto& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = normal(random);
  };
  DenseProgram p{Eigen::MatrixXd(size, size), Eigen::MatrixXd(rows, size), Eigen::VectorXd(size),
                 Eigen::VectorXd(rows)};
  fill(p.a);
  p.a = (p.a * p.a.transpose()).eval() + 0.1 * Eigen::MatrixXd::Identity(size, size);
  fill(p.g);
  fill(p.b);
  Eigen::VectorXd inside(size), slack(rows);
  fill(inside);
  fill(slack);
  p.h = p.g * inside - slack.cwiseAbs();  // feasible
  return p;
}

/// The optimum by trying every set of rows that hold with equality.
std::optional<Eigen::VectorXd> bruteForce(const DenseProgram& p) {
  std::optional<Eigen::VectorXd> best;
  const auto rows = static_cast<int>(p.rowCount());
  for (int set = 0; set < 1 << rows; ++set) {
    std::vector<int> active;
    for (int i = 0; i < rows; ++i)
      if ((set >> i & 1) != 0) active.push_back(i);
    const auto count = static_cast<Eigen::Index>(active.size());
    if (count > p.size()) continue;
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(p.size() + count, p.size() + count);
    Eigen::VectorXd right(p.size() + count);
    kkt.topLeftCorner(p.size(), p.size()) = p.a;
    right.head(p.size()) = p.b;
    for (Eigen::Index k = 0; k < count; ++k) {
      const int row = active[k];
      kkt.block(p.size() + k, 0, 1, p.size()) = p.g.row(row);
      kkt.block(0, p.size() + k, p.size(), 1) = p.g.row(row).transpose();
      right[p.size() + k] = p.h[row];
    }
    const Eigen::VectorXd x = kkt.fullPivLu().solve(right).head(p.size());
    if ((p.g * x - p.h).minCoeff() < -1e-9) continue;
    if (!best || p.objective(x) < p.objective(*best)) best = x;
  }
  return best;
}

constexpr InteriorPointLimits kExact{80, 1e-10, 1e-9};

TEST(InteriorPoint, FindsTheOptimumOfRandomPrograms) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const DenseProgram p = randomProgram(2 + static_cast<int>(seed % 4), 1 + static_cast<int>(seed % 7), seed);
    const auto truth = bruteForce(p);
    ASSERT_TRUE(truth) << seed;
    const InteriorPointResult found = InteriorPoint(p, kExact).solve();
    EXPECT_EQ(found.why, Termination::Converged) << seed;
    EXPECT_LT((found.x - *truth).norm(), 1e-4 * (1.0 + truth->norm())) << seed;
    const double scale = 1.0 + std::abs(p.objective(*truth));
    EXPECT_NEAR(found.objective, p.objective(*truth), 1e-6 * scale) << seed;
    EXPECT_LE(found.lowerBound, p.objective(*truth) + 1e-9 * scale) << "a bound that is none: " << seed;
    EXPECT_GE(found.lowerBound, p.objective(*truth) - 1e-5 * scale) << seed;
    EXPECT_GE((p.g * found.x - p.h).minCoeff(), -1e-6) << seed;
  }
}

TEST(InteriorPoint, EndsWhereItMakesNoProgress) {
  // Twice as many rows as unknowns, nearly all contrary to others, and far beyond the scale of the program.
  DenseProgram p = randomProgram(20, 40, 5);
  for (Eigen::Index i = 0; i < p.h.size(); ++i) p.h[i] = 1e12 * std::sin(7.0 * static_cast<double>(i));
  const InteriorPointResult found = InteriorPoint(p, kExact).solve();
  EXPECT_EQ(found.why, Termination::NoProgress) << found.iterations;
  EXPECT_LT(found.iterations, 20);
  EXPECT_GT((p.h - p.g * found.x).maxCoeff(), 0.999 * p.h.maxCoeff()) << "the steps were steps";
}

TEST(InteriorPoint, WithoutRowsItSolvesTheSystem) {
  DenseProgram p = randomProgram(4, 0, 3);
  const InteriorPointResult found = InteriorPoint(p, {}).solve();
  EXPECT_EQ(found.why, Termination::Exact);
  EXPECT_LT((p.a * found.x - p.b).norm(), 1e-9);
  EXPECT_EQ(found.iterations, 0);
}

TEST(InteriorPoint, CancelledTakesNoStep) {
  const RunContext context;
  context.cancel.cancel();
  const DenseProgram p = randomProgram(4, 5, 3);
  const InteriorPointResult found = InteriorPoint(p, kExact, context).solve();
  EXPECT_EQ(found.why, Termination::NotRun);
  EXPECT_EQ(found.iterations, 0);
}

TEST(InteriorPoint, RowsThatHoldAnywayChangeNothing) {
  DenseProgram p = randomProgram(3, 4, 5);
  const Eigen::VectorXd free = p.a.ldlt().solve(p.b);
  p.h = p.g * free - Eigen::VectorXd::Constant(4, 2.0);
  const InteriorPointResult found = InteriorPoint(p, kExact).solve();
  EXPECT_EQ(found.why, Termination::Converged);
  EXPECT_LT((found.x - free).norm(), 1e-4);
}

TEST(InteriorPoint, StopsOnceTheObjectiveIsProvenTooLarge) {
  DenseProgram p = randomProgram(3, 3, 7);
  const Eigen::VectorXd free = p.a.ldlt().solve(p.b);
  p.h = p.g * free + Eigen::VectorXd::Constant(3, 5.0);  // a long way from the free minimum
  const auto truth = bruteForce(p);
  ASSERT_TRUE(truth);
  InteriorPointLimits limits = kExact;
  limits.abortAbove = std::lerp(p.objective(free), p.objective(*truth), 0.5);
  const InteriorPointResult found = InteriorPoint(p, limits).solve();
  EXPECT_EQ(found.why, Termination::ToleranceLimited);
  EXPECT_GT(found.lowerBound, limits.abortAbove);
  limits.abortAbove = p.objective(*truth) + 1.0;
  EXPECT_EQ(InteriorPoint(p, limits).solve().why, Termination::Converged) << "within what is allowed";
}

TEST(InteriorPoint, SaysWhenItIsNotDone) {
  const DenseProgram p = randomProgram(4, 6, 9);
  InteriorPointLimits few = kExact;
  few.iterations = 1;
  EXPECT_EQ(InteriorPoint(p, few).solve().why, Termination::IterationLimit);
  DenseProgram flat = p;
  flat.a.setZero();
  EXPECT_EQ(InteriorPoint(flat, kExact).solve().why, Termination::Degenerate);
}

}  // namespace
}  // namespace batten
