// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/monotone_program.h"

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// A program whose objective is proven to lie so many times above anything sensible has no solution.
constexpr double kHopeless = 1e6;

}  // namespace

MonotoneSearch::Program::Program(const FairingSetup& setup, const std::vector<SpanPlace>& places,
                                 const std::vector<Jet>& jets, const RunContext& context)
    : setup_(setup), context_(context) {
  program_.b = Eigen::VectorXd::Zero(setup.unknowns.count());
  program_.ridge = 1e-12;
  program_.leastPivot = 0.0;
  for (std::size_t i = 0; i < places.size() && !context.isCancelled(); ++i) {
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
  addTo(program_.b, row, -weight * value);
  constant_ += weight * value * value;
  squares_.push_back({row, weight});
}

void MonotoneSearch::Program::addBound(const SparseRow& row, double factor, double bound) {
  program_.rows.push_back(row);
  for (double& v : program_.rows.back().value) v *= factor;
  program_.bounds.push_back(bound);
}

std::optional<Eigen::VectorXd> MonotoneSearch::Program::solve(bool mayBeInfeasible) {
  const int count = setup_.unknowns.count();
  int half = setup_.unknowns.halfWidth();
  for (const Square& square : squares_) half = std::max(half, square.row.width());
  for (const SparseRow& row : program_.rows) half = std::max(half, row.width());
  program_.a = BandedMatrix(count, std::min(half, count - 1), false);
  for (const Square& square : squares_) {
    if (context_.isCancelled()) return std::nullopt;
    program_.a.addOuter(square.row, square.weight);
  }
  // Rows of all kinds, at places of any speed, in units of about their standard deviation.
  for (std::size_t i = 0; i < program_.rows.size(); ++i) {
    SparseRow& row = program_.rows[i];
    double variance = 0.0;
    for (std::size_t k = 0; k < row.index.size(); ++k)
      variance += row.value[k] * row.value[k] / program_.a.entry(row.index[k], 0);
    const double unit = variance > 0.0 && std::isfinite(variance) ? 1.0 / std::sqrt(variance) : 1.0;
    for (double& v : row.value) v *= unit;
    program_.bounds[i] *= unit;
  }
  InteriorPointLimits limits;
  if (mayBeInfeasible) limits.abortAbove = kHopeless * (constant_ + static_cast<double>(program_.rows.size()));
  const InteriorPointResult result = solveProgram(program_, limits, context_);
  const bool usable = result.why == Termination::Converged || result.why == Termination::Exact ||
                      (result.why == Termination::IterationLimit && !mayBeInfeasible);
  if (!usable || !result.x.allFinite()) return std::nullopt;
  return result.x;
}

}  // namespace batten
