// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/monotone_program.h"

#include <algorithm>
#include <cmath>

#include "core/solve/banded_cholesky.h"
#include "core/solve/interior_point.h"

namespace batten {
namespace {

/// A program whose objective is proven to lie so many times above anything sensible has no solution.
constexpr double kHopeless = 1e6;

double dot(const SparseRow& row, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (std::size_t k = 0; k < row.index.size(); ++k) sum += row.value[k] * x[row.index[k]];
  return sum;
}

void add(Eigen::VectorXd& x, const SparseRow& row, double factor) {
  for (std::size_t k = 0; k < row.index.size(); ++k) x[row.index[k]] += factor * row.value[k];
}

void addOuter(BandedMatrix& m, const SparseRow& row, double weight) {
  for (std::size_t b = 0; b < row.index.size(); ++b) {
    const double value = weight * row.value[b];
    double* column = &m.at(row.index[b], row.index[b]);
    for (std::size_t a = b; a < row.index.size(); ++a) column[row.index[a] - row.index[b]] += value * row.value[a];
  }
}

int width(const SparseRow& row) { return row.index.empty() ? 0 : row.index.back() - row.index.front(); }

}  // namespace

/// The program as the interior point method sees it.
struct MonotoneSearch::Program::Quadratic {
  struct Factor {
    BandedMatrix matrix;
    void solveInPlace(Eigen::VectorXd& x) const { matrix.solve(x); }
  };
  const Program& p;
  BandedMatrix a;

  Eigen::Index size() const { return p.linear_.size(); }
  Eigen::Index rowCount() const { return static_cast<Eigen::Index>(p.rows_.size()); }
  const Eigen::VectorXd& linear() const { return p.linear_; }
  double bound(Eigen::Index i) const { return p.bounds_[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return dot(p.rows_[i], v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { add(out, p.rows_[i], factor); }
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
    for (int j = 0; j < a.size(); ++j) {
      out[j] += a.at(j, j) * v[j];
      for (int i = j + 1; i <= std::min(j + a.halfWidth(), a.size() - 1); ++i) {
        out[i] += a.at(i, j) * v[j];
        out[j] += a.at(i, j) * v[i];
      }
    }
    return out;
  }
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    factor.matrix = a;
    for (Eigen::Index i = 0; i < weights.size(); ++i) addOuter(factor.matrix, p.rows_[i], weights[i]);
    const BandedMatrix plain = factor.matrix;
    if (factor.matrix.factorize()) return true;
    factor.matrix = plain;
    for (int j = 0; j < a.size(); ++j) factor.matrix.at(j, j) *= 1.0 + 1e-12;
    return factor.matrix.factorize();
  }
};

MonotoneSearch::Program::Program(const FairingSetup& setup, const std::vector<SpanPlace>& places,
                                 const std::vector<Jet>& jets)
    : setup_(setup), linear_(Eigen::VectorXd::Zero(setup.unknowns.count())) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    slopes_.push_back(
        localRow(places[i].span, curvatureSlopeRow(jets[i], setup.basis.row(places[i], 3), setup.basis.degree())));
  }
}

SparseRow MonotoneSearch::Program::localRow(int span, const LocalRow& local) const {
  const auto index = setup_.unknowns.indices(span);
  SparseRow row;
  row.index.assign(index.begin(), index.end());
  row.value.resize(index.size());
  setup_.unknowns.reduce(span, local, row.value.data());
  return row;
}

SparseRow MonotoneSearch::Program::difference(int from, int to) const {
  const SparseRow &a = slope(from), &b = slope(to);
  SparseRow row;
  std::size_t i = 0, j = 0;
  while (i < a.index.size() || j < b.index.size()) {
    const bool takeA = j == b.index.size() || (i < a.index.size() && a.index[i] <= b.index[j]);
    const bool takeB = i == a.index.size() || (j < b.index.size() && b.index[j] <= a.index[i]);
    row.index.push_back(takeA ? a.index[i] : b.index[j]);
    row.value.push_back((takeB ? b.value[j] : 0.0) - (takeA ? a.value[i] : 0.0));
    i += takeA ? 1 : 0;
    j += takeB ? 1 : 0;
  }
  return row;
}

void MonotoneSearch::Program::addSquare(const SparseRow& row, double value, double weight) {
  add(linear_, row, -weight * value);
  constant_ += weight * value * value;
  squares_.push_back({row, weight});
}

void MonotoneSearch::Program::addBound(const SparseRow& row, double factor, double bound) {
  rows_.push_back(row);
  for (double& v : rows_.back().value) v *= factor;
  bounds_.push_back(bound);
}

std::optional<Eigen::VectorXd> MonotoneSearch::Program::solve(bool mayBeInfeasible) {
  int half = setup_.unknowns.halfWidth();
  for (const Square& square : squares_) half = std::max(half, width(square.row));
  for (const SparseRow& row : rows_) half = std::max(half, width(row));
  Quadratic quadratic{*this, BandedMatrix(setup_.unknowns.count(), std::min(half, setup_.unknowns.count() - 1))};
  for (const Square& square : squares_) addOuter(quadratic.a, square.row, square.weight);
  // Rows of all kinds, at places of any speed, in units of about their standard deviation.
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    SparseRow& row = rows_[i];
    double variance = 0.0;
    for (std::size_t k = 0; k < row.index.size(); ++k) {
      variance += row.value[k] * row.value[k] / quadratic.a.at(row.index[k], row.index[k]);
    }
    const double unit = variance > 0.0 && std::isfinite(variance) ? 1.0 / std::sqrt(variance) : 1.0;
    for (double& v : row.value) v *= unit;
    bounds_[i] *= unit;
  }
  InteriorPointLimits limits;
  if (mayBeInfeasible) limits.abortAbove = kHopeless * (constant_ + static_cast<double>(rows_.size()));
  const InteriorPointResult result = InteriorPoint(quadratic, limits).solve();
  const bool usable = result.why == Termination::Converged || result.why == Termination::Exact ||
                      (result.why == Termination::IterationLimit && !mayBeInfeasible);
  if (!usable || !result.x.allFinite()) return std::nullopt;
  return result.x;
}

}  // namespace batten
