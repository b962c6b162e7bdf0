// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/fairing_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

/// Stiffness against sliding along the curve, in that of the longest wave. Sliding changes no shape, but far slides
/// make the linear model wrong: it is damped more than moves across the curve, and never quite free (kSlideFloor).
constexpr double kTangentDamping = 1e5;
constexpr int kConjugateSteps = 25;           // limits the work of one solution
constexpr double kConjugateTolerance = 1e-2;  // share of the residual at which it is good enough

LocalRow positionRow(const Vec2& direction, const SpanRow& basis, int degree) {
  LocalRow row;
  row.fill(Vec2::Zero());
  for (int j = 0; j <= degree; ++j) row[j] = basis.d[0][j] * direction;
  return row;
}

/// The fourth-order rule for the interval from sample k to k + 1 of spacing `step`: four samples and their factors.
struct IntervalRule {
  std::array<int, 4> sample;
  std::array<double, 4> factor;
};
std::array<double, 4> insideRule(double step) {
  return {-1.0 / 24 * step, 13.0 / 24 * step, 13.0 / 24 * step, -1.0 / 24 * step};
}
/// Of the intervals at the ends, whose samples are not k - 1 to k + 2.
IntervalRule endRule(int k, int count, bool closed, double step) {
  if (closed) return {{(k + count - 1) % count, k, (k + 1) % count, (k + 2) % count}, insideRule(step)};
  const std::array<double, 4> factor = {5.0 / 12 * step, 8.0 / 12 * step, -1.0 / 12 * step, 0.0};
  if (k == 0) return {{0, 1, 2, 0}, factor};
  return {{k + 1, k, k - 1, k}, factor};
}
bool isInside(int k, int count) { return k >= 1 && k + 2 < count; }

}  // namespace

FairingModel::FairingModel(const FairingSetup& setup, const FairingObjective& objective,
                           const FairingCorridor& corridor, const FairingState& state, double slideFloor)
    : setup_(&setup), slideFloor_(slideFloor) {
  remake(objective, corridor, state);
}

void FairingModel::remake(const FairingObjective& objective, const FairingCorridor& corridor,
                          const FairingState& state) {
  const FairingSetup& setup = *setup_;
  state_ = &state;
  const int count = setup.sampleCount();
  const double length = state.arc.length;
  const bool profile = !objective.wanted.empty();
  stepLength_ = length / (setup.closed ? count : count - 1);
  rows_.reset(setup.unknowns, state.arc);
  across_.resize(count);
  weight_.resize(count);
  nonlocal_.resize(count);
  lengthTerm_.resize(count);
  corridorCurvature_.resize(count);
  const double weight =
      profile ? 1.0 / objective.reference / std::sqrt(count) : std::sqrt(length / count) / objective.reference;
  Eigen::VectorXd corridorGradient(count);
  for (int i = 0; i < count && !setup.check.isCancelled(); ++i) {
    const FairingSample& sample = state.samples[i];
    const CurvatureJet& c = sample.curvature;
    const Vec2 tangent = sample.jet[1] / c.speed, normal = leftNormal(tangent);
    nonlocal_[i] = profile ? c.slope : c.bend;
    setRows(i, tangent, normal, profile);
    across_[i] = sample.normalAtFoot.dot(normal);
    weight_[i] = weight;
    lengthTerm_[i] = profile ? weight_[i] * setup.start.length / (length * length) * objective.wanted[i]
                             : 0.5 * state.residual[i] / length;
    const double e = sample.distance;
    corridorGradient[i] = corridor.weight * corridor.weight * (e - setup.offsetAt(sample.foot)) / count;
    corridorCurvature_[i] = corridor.weight * corridor.weight / count;
    if (corridor.barrier) {
      const auto [strength, bound] = *corridor.barrier;
      const double room = bound * bound - e * e;
      corridorGradient[i] += strength / count * e / room;
      corridorCurvature_[i] += strength / count * (bound * bound + e * e) / (room * room);
    }
  }
  const double wave = 2.0 * std::numbers::pi / length;
  dampingUnit_ = std::pow(wave, profile ? 4.0 : 6.0) * (profile ? 1.0 : length) /
                 (objective.reference * objective.reference) / count;
  if (setup.check.isCancelled()) return;
  gradient_ = applyTransposed(state.residual);
  rows_.addTransposed(across_.cwiseProduct(corridorGradient), gradient_);
  assemble();
}

/// A sample that is re-located loses what sliding along the curve would change.
void FairingModel::setRows(int i, const Vec2& tangent, const Vec2& normal, bool profile) {
  constexpr int kQuintic = 5;  // the usual case, written in place
  const SpanPlace& place = state_->arc.places[i];
  const int span = place.span, degree = setup_->basis.degree();
  const Jet& jet = state_->samples[i].jet;
  const SpanRow basis = setup_->basis.row(place, profile ? 2 : 3);
  if (profile && degree == kQuintic && rows_.areOwn(span)) {
    const auto [first, second] = curvatureWeights(jet);
    double *curvature = rows_.own(i, SampleRows::Curvature), *across = rows_.own(i, SampleRows::Across),
           *along = rows_.own(i, SampleRows::Along);
    for (int j = 0; j <= kQuintic; ++j) {
      const double value = basis.d[0][j];
      Vec2 change = basis.d[1][j] * first + basis.d[2][j] * second;
      change -= nonlocal_[i] * value * tangent;
      Eigen::Map<Vec2>(curvature + 2 * j) = change;
      Eigen::Map<Vec2>(across + 2 * j) = value * normal;
      Eigen::Map<Vec2>(along + 2 * j) = value * tangent;
    }
    return;
  }
  LocalRow local = profile ? curvatureRow(jet, basis, degree) : curvatureSlopeRow(jet, basis, degree);
  for (int j = 0; j <= degree; ++j) local[j] -= nonlocal_[i] * basis.d[0][j] * tangent;
  rows_.set(i, SampleRows::Curvature, span, local);
  rows_.set(i, SampleRows::Across, span, positionRow(normal, basis, degree));
  rows_.set(i, SampleRows::Along, span, positionRow(tangent, basis, degree));
}

void FairingModel::assemble() {
  const Unknowns& unknowns = setup_->unknowns;
  stiffness_ = BandedMatrix(unknowns.count(), unknowns.halfWidth(), false);
  mass_ = stiffness_;
  tangentFloor_ = slideFloor_ * dampingUnit_;
  SampleRows::Squares squares{{}, dampingUnit_, slideFloor_, kTangentDamping};
  squares.weights.reserve(setup_->start.places.size());
  for (int i = 0; i < setup_->sampleCount(); ++i)
    squares.weights.push_back({weight_[i] * weight_[i], corridorCurvature_[i] * across_[i] * across_[i]});
  rows_.addSquares(squares, setup_->check, stiffness_, mass_);
}

FairingModel::Integral FairingModel::cumulative(const Eigen::VectorXd& values) const {
  const int count = static_cast<int>(values.size());
  const std::array<double, 4> inside = insideRule(stepLength_);
  const double* v = values.data();
  Eigen::VectorXd result(count);
  double sum = 0.0;
  result[0] = 0.0;
  for (int k = 0; k < (setup_->closed ? count : count - 1); ++k) {
    if (isInside(k, count)) {
      for (int l = 0; l < 4; ++l) sum += inside[l] * v[k - 1 + l];
    } else {
      const IntervalRule rule = endRule(k, count, setup_->closed, stepLength_);
      for (int l = 0; l < 4; ++l) sum += rule.factor[l] * v[rule.sample[l]];
    }
    if (k + 1 < count) result[k + 1] = sum;
  }
  return {std::move(result), sum};
}

Eigen::VectorXd FairingModel::cumulativeTransposed(const Eigen::VectorXd& values, double total) const {
  const int count = static_cast<int>(values.size());
  const std::array<double, 4> inside = insideRule(stepLength_);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  double* r = result.data();
  double sum = total;
  for (int k = (setup_->closed ? count : count - 1) - 1; k >= 0; --k) {
    if (k + 1 < count) sum += values[k + 1];
    if (isInside(k, count)) {
      for (int l = 0; l < 4; ++l) r[k - 1 + l] += inside[l] * sum;
    } else {
      const IntervalRule rule = endRule(k, count, setup_->closed, stepLength_);
      for (int l = 0; l < 4; ++l) r[rule.sample[l]] += rule.factor[l] * sum;
    }
  }
  return result;
}

Eigen::VectorXd FairingModel::applyTo(const Eigen::VectorXd& local, const Eigen::VectorXd& normal, double shift) const {
  const int count = setup_->sampleCount();
  Eigen::VectorXd bent(count), result(count);
  for (int i = 0; i < count; ++i) bent[i] = state_->samples[i].curvature.kappa * normal[i];
  const Integral sums = cumulative(bent);
  const double lengthChange = -sums.total;
  for (int i = 0; i < count; ++i) {
    const double slide = shift + sums.upTo[i] + setup_->fraction(i) * lengthChange;
    result[i] = weight_[i] * (local[i] + nonlocal_[i] * slide) + lengthTerm_[i] * lengthChange;
  }
  return result;
}

FairingModel::Transposed FairingModel::transposed(const Eigen::VectorXd& y) const {
  const int count = setup_->sampleCount();
  Eigen::VectorXd slide(count);
  double length = 0.0, shift = 0.0;
  for (int i = 0; i < count; ++i) {
    slide[i] = weight_[i] * y[i] * nonlocal_[i];
    length += slide[i] * setup_->fraction(i) + lengthTerm_[i] * y[i];
    shift += slide[i];
  }
  Eigen::VectorXd normal = cumulativeTransposed(slide, -length);
  for (int i = 0; i < count; ++i) normal[i] *= state_->samples[i].curvature.kappa;
  return {weight_.cwiseProduct(y), std::move(normal), shift};
}

Eigen::VectorXd FairingModel::apply(const Eigen::VectorXd& v) const {
  const SampleRows::Products moves = rows_.times(v);
  return applyTo(moves.curvature, moves.across, setup_->closed ? moves.along[0] : 0.0);
}

Eigen::VectorXd FairingModel::applyTransposed(const Eigen::VectorXd& y) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(setup_->unknowns.count());
  const Transposed back = transposed(y);
  rows_.addTransposed(back.local, back.normal, out);
  if (setup_->closed) rows_.addFirstAlong(back.shift, out);
  return out;
}

Eigen::VectorXd FairingModel::distances(const Eigen::VectorXd& v) const {
  return across_.cwiseProduct(rows_.acrossTimes(v));
}

Eigen::VectorXd FairingModel::applyNormal(const Eigen::VectorXd& v, double damping) const {
  SampleRows::Products moves = rows_.times(v);
  const Eigen::VectorXd y = applyTo(moves.curvature, moves.across, setup_->closed ? moves.along[0] : 0.0);
  Transposed back = transposed(y);
  const double along = damping * kTangentDamping * dampingUnit_ + tangentFloor_, across = damping * dampingUnit_;
  for (int i = 0; i < setup_->sampleCount(); ++i) {
    moves.across[i] = back.normal[i] + (corridorCurvature_[i] * across_[i] * across_[i] + across) * moves.across[i];
    moves.along[i] = along * moves.along[i] + (setup_->closed && i == 0 ? back.shift : 0.0);
  }
  moves.curvature = std::move(back.local);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  rows_.addTransposedSums(moves, out);
  return out;
}

std::optional<Eigen::VectorXd> FairingModel::step(double damping) const {
  BandedMatrix damped = stiffness_;
  damped.add(mass_, damping);
  BandedCholesky factor;
  if (setup_->check.isCancelled() || !factor.factor(damped, 0.0)) return std::nullopt;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(gradient_.size()), r = -gradient_, z = r;
  factor.solveInPlace(z);
  Eigen::VectorXd p = z;
  double rz = r.dot(z);
  const double goal = kConjugateTolerance * kConjugateTolerance * rz;
  for (int k = 0; k < kConjugateSteps && rz > goal && rz > 0.0; ++k) {
    if (setup_->check.isCancelled()) return std::nullopt;
    const Eigen::VectorXd q = applyNormal(p, damping);
    const double curvature = p.dot(q);
    if (!(curvature > 0.0)) break;
    const double alpha = rz / curvature;
    x += alpha * p;
    r -= alpha * q;
    z = r;
    factor.solveInPlace(z);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  if (!x.allFinite()) return std::nullopt;
  return x;
}

}  // namespace batten
