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
                                 const std::vector<Sample>& samples, const RunContext& context)
    : setup_(setup), context_(context) {
  program_.b = Eigen::VectorXd::Zero(setup.unknowns.count());
  program_.ridge = 1e-12;
  program_.leastPivot = 0.0;
  const std::ptrdiff_t stride = setup.unknowns.stride();
  local_.resize(stride);
  slopes_.resize(stride * std::ssize(places));
  for (std::size_t i = 0; i < places.size() && !context.isCancelled(); ++i) {
    const SpanPlace& place = places[i];
    spans_.push_back(place.span);
    setup.unknowns.reduce(place.span,
                          curvatureSlopeRow(samples[i].jet, setup.basis.row(place, 3), setup.basis.degree()),
                          slopes_.data() + static_cast<std::ptrdiff_t>(i) * stride);
  }
}

MonotoneSearch::Program::Row MonotoneSearch::Program::localRow(int span, const LocalRow& local) {
  const auto index = setup_.unknowns.indices(span);
  setup_.unknowns.reduce(span, local, local_.data());
  return {index, std::span(local_).first(index.size())};
}

MonotoneSearch::Program::Row MonotoneSearch::Program::slope(int place) const {
  const auto index = setup_.unknowns.indices(spans_[place]);
  const std::ptrdiff_t stride = setup_.unknowns.stride();
  return {index, std::span(slopes_).subspan(place * stride, index.size())};
}

MonotoneSearch::Program::Row MonotoneSearch::Program::difference(int from, int to) {
  const Row a = slope(from), b = slope(to);
  difference_.clear();
  if (spans_[from] == spans_[to]) {
    for (std::size_t k = 0; k < a.value.size(); ++k) difference_.push_back(b.value[k] - a.value[k]);
    return {a.index, difference_};
  }
  eitherIndex_.clear();
  std::size_t i = 0, j = 0;
  while (i < a.index.size() || j < b.index.size()) {
    const bool takeA = j == b.index.size() || (i < a.index.size() && a.index[i] <= b.index[j]);
    const bool takeB = i == a.index.size() || (j < b.index.size() && b.index[j] <= a.index[i]);
    eitherIndex_.push_back(takeA ? a.index[i] : b.index[j]);
    difference_.push_back((takeB ? b.value[j] : 0.0) - (takeA ? a.value[i] : 0.0));
    i += takeA ? 1 : 0;
    j += takeB ? 1 : 0;
  }
  return {eitherIndex_, difference_};
}

void MonotoneSearch::Program::addSquare(const Row& row, double value, double weight) {
  for (std::size_t k = 0; k < row.index.size(); ++k) program_.b[row.index[k]] -= weight * value * row.value[k];
  constant_ += weight * value * value;
  squares_.add(row.index, row.value);
  weights_.push_back(weight);
}

void MonotoneSearch::Program::addBound(const Row& row, double factor, double bound) {
  program_.rows.add(row.index, row.value, factor);
  program_.bounds.push_back(bound);
}

std::optional<MonotoneSearch::Program::Solution> MonotoneSearch::Program::solve(bool mayBeInfeasible) {
  const int count = setup_.unknowns.count();
  const int half = std::max({setup_.unknowns.halfWidth(), squares_.width(), program_.rows.width()});
  program_.a = BandedMatrix(count, std::min(half, count - 1), false);
  squares_.addOuter(Eigen::Map<const Eigen::VectorXd>(weights_.data(), std::ssize(weights_)), program_.a);
  if (context_.isCancelled()) return std::nullopt;
  // Rows of all kinds, at places of any speed, in units of about their standard deviation.
  const auto unitOf = [&](std::span<const int> index, std::span<const double> value) {
    double variance = 0.0;
    for (std::size_t k = 0; k < index.size(); ++k) variance += value[k] * value[k] / program_.a.entry(index[k], 0);
    return variance > 0.0 && std::isfinite(variance) ? 1.0 / std::sqrt(variance) : 1.0;
  };
  program_.rows.scale(unitOf, [&](Eigen::Index row, double unit) { program_.bounds[row] *= unit; });
  InteriorPointLimits limits;
  if (mayBeInfeasible) limits.abortAbove = kHopeless * (constant_ + static_cast<double>(program_.rows.count()));
  const InteriorPointResult result = solveProgram(program_, limits, context_);
  const bool isStuck = result.why == Termination::NoProgress;
  const bool usable = result.why == Termination::Converged || result.why == Termination::Exact ||
                      ((isStuck || result.why == Termination::IterationLimit) && !mayBeInfeasible);
  if (!usable || !result.x.allFinite()) return std::nullopt;
  return Solution{result.x, isStuck};
}

}  // namespace batten
