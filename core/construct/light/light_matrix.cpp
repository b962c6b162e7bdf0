// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_matrix.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/construct/light/span_system.h"
#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

/// Up to here the dense factorisation costs less than 10 ms; every other figure of a fit is then larger.
constexpr Eigen::Index kMostDenseUnknowns = 450;
/// A group of unknowns is a control point and the length of one span, the one that has this point as its
/// kLengthAfter-th. The points of a quintic span then lie in the groups of the lengths that it depends on.
constexpr int kGroup = 3, kLengthAfter = 2, kLastPoint = 5;
constexpr int kGroupsOfSpan = kLengthsOfSpan;  // one for each length that a span depends on
static_assert(kLengthAfter <= kLengthReach && kLengthAfter + kLengthReach >= kLastPoint);

}  // namespace

LightMatrix::LightMatrix(const LightShape& shape, bool lengths)
    : unknowns_(2 * static_cast<Eigen::Index>(shape.points.size()) + (lengths ? shape.spans() : 0)) {
  if (unknowns_ > kMostDenseUnknowns) {
    orderUnknowns(shape, lengths);
    band_ = BandedMatrix(static_cast<int>(unknowns_), kGroup * kGroupsOfSpan - 1, shape.closed);
  } else {
    dense_.resize(unknowns_, unknowns_);
    damped_.resize(unknowns_, unknowns_);
  }
}

void LightMatrix::orderUnknowns(const LightShape& shape, bool lengths) {
  const int points = static_cast<int>(shape.points.size()), spans = lengths ? shape.spans() : 0;
  place_.resize(unknowns_);
  int next = 0;
  for (int point = 0; point < points; ++point) {
    place_[2 * point] = next++;
    place_[2 * point + 1] = next++;
    const int span = shape.closed ? (point - kLengthAfter + points) % points : point - kLengthAfter;
    if (span >= 0 && span < spans) place_[2 * points + span] = next++;
  }
}

void LightMatrix::setZero() {
  dense_.setZero();
  if (!place_.empty()) band_ = BandedMatrix(band_.size(), band_.halfWidth(), band_.isCyclic());
}

void LightMatrix::addToBand(Eigen::Index row, Eigen::Index column, double value) {
  const auto [first, last] = std::minmax(place_[row], place_[column]);
  const bool isAround = last - first > band_.halfWidth();
  band_.entry(isAround ? last : first, isAround ? first + band_.size() - last : last - first) += value;
}

std::optional<Eigen::VectorXd> LightMatrix::solveDamped(double damping, const Eigen::VectorXd& right) {
  if (place_.empty()) {
    damped_ = dense_;
    damped_.diagonal() += damping * dense_.diagonal();
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped_);
    if (factor.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd solution = right;
    factor.solveInPlace(solution);
    return solution;
  }
  BandedMatrix raised = band_;
  Eigen::VectorXd ordered(unknowns_), solution(unknowns_);
  for (int i = 0; i < raised.size(); ++i) {
    raised.entry(i, 0) += damping * band_.entry(i, 0);
    ordered[place_[i]] = right[i];
  }
  BandedCholesky factor;
  if (!factor.factor(raised, 0.0)) return std::nullopt;
  factor.solveInPlace(ordered);
  for (int i = 0; i < raised.size(); ++i) solution[i] = ordered[place_[i]];
  return solution;
}

}  // namespace batten
