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
/// make the linear model wrong: it is damped more than moves across the curve, and never quite free.
constexpr double kTangentDamping = 1e5, kTangentFloor = 1.0;
constexpr int kConjugateSteps = 25;           // limits the work of one solution
constexpr double kConjugateTolerance = 1e-2;  // share of the residual at which it is good enough

LocalRow positionRow(const Vec2& direction, const SpanRow& basis, int degree) {
  LocalRow row;
  row.fill(Vec2::Zero());
  for (int j = 0; j <= degree; ++j) row[j] = basis.d[0][j] * direction;
  return row;
}

/// The four samples and factors of the fourth-order rule for the interval from sample k to k + 1 of spacing 1.
struct IntervalRule {
  std::array<int, 4> sample;
  std::array<double, 4> factor;
};
IntervalRule intervalRule(int k, int count, bool closed) {
  if (closed) {
    return {{(k + count - 1) % count, k, (k + 1) % count, (k + 2) % count},
            {-1.0 / 24, 13.0 / 24, 13.0 / 24, -1.0 / 24}};
  }
  if (k == 0) return {{0, 1, 2, 0}, {5.0 / 12, 8.0 / 12, -1.0 / 12, 0.0}};
  if (k == count - 2) return {{k + 1, k, k - 1, k}, {5.0 / 12, 8.0 / 12, -1.0 / 12, 0.0}};
  return {{k - 1, k, k + 1, k + 2}, {-1.0 / 24, 13.0 / 24, 13.0 / 24, -1.0 / 24}};
}

}  // namespace

FairingModel::FairingModel(const FairingSetup& setup, const FairingObjective& objective,
                           const FairingCorridor& corridor, const FairingState& state)
    : setup_(&setup), state_(&state) {
  const int count = setup.sampleCount(), degree = setup.basis.degree(), stride = setup.unknowns.stride();
  const double length = state.arc.length;
  const bool profile = !objective.wanted.empty();
  stepLength_ = length / (setup.closed ? count : count - 1);
  for (auto* rows : {&local_, &normal_, &tangent_}) rows->setZero(stride, count);
  across_.resize(count);
  weight_.resize(count);
  nonlocal_.resize(count);
  lengthTerm_.resize(count);
  corridorCurvature_.resize(count);
  Eigen::VectorXd corridorGradient(count);
  for (int i = 0; i < count && !setup.check.isCancelled(); ++i) {
    const FairingSample& sample = state.samples[i];
    const int span = state.arc.places[i].span;
    const SpanRow basis = setup.basis.row(state.arc.places[i], profile ? 2 : 3);
    const CurvatureJet& c = sample.curvature;
    const Vec2 tangent = sample.jet[1] / c.speed, normal = leftNormal(tangent);
    const Unknowns& unknowns = setup.unknowns;
    LocalRow local = profile ? curvatureRow(sample.jet, basis, degree) : curvatureSlopeRow(sample.jet, basis, degree);
    // A sample that is re-located loses what sliding along the curve would change.
    nonlocal_[i] = profile ? c.slope : c.bend;
    for (int j = 0; j <= degree; ++j) {
      local[j] -= nonlocal_[i] * basis.d[0][j] * tangent;
    }
    unknowns.reduce(span, local, &local_(0, i));
    unknowns.reduce(span, positionRow(normal, basis, degree), &normal_(0, i));
    unknowns.reduce(span, positionRow(tangent, basis, degree), &tangent_(0, i));
    across_[i] = sample.normalAtFoot.dot(normal);
    weight_[i] =
        profile ? 1.0 / objective.reference / std::sqrt(count) : std::sqrt(length / count) / objective.reference;
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
  for (int i = 0; i < count; ++i) accumulate(normal_, i, across_[i] * corridorGradient[i], gradient_);
  assemble();
}

double FairingModel::dot(const Eigen::MatrixXd& rows, int sample, const Eigen::VectorXd& v) const {
  const auto index = setup_->unknowns.indices(state_->arc.places[sample].span);
  const double* row = &rows(0, sample);
  double sum = 0.0;
  for (std::size_t k = 0; k < index.size(); ++k) sum += row[k] * v[index[k]];
  return sum;
}

void FairingModel::accumulate(const Eigen::MatrixXd& rows, int sample, double factor, Eigen::VectorXd& out) const {
  const auto index = setup_->unknowns.indices(state_->arc.places[sample].span);
  const double* row = &rows(0, sample);
  for (std::size_t k = 0; k < index.size(); ++k) out[index[k]] += factor * row[k];
}

void FairingModel::assemble() {
  const Unknowns& unknowns = setup_->unknowns;
  stiffness_ = BandedMatrix(unknowns.count(), unknowns.halfWidth(), false);
  mass_ = stiffness_;
  tangentFloor_ = kTangentFloor * dampingUnit_;
  for (int i = 0; i < setup_->sampleCount() && !setup_->check.isCancelled(); ++i) {
    const auto index = unknowns.indices(state_->arc.places[i].span);
    const double w2 = weight_[i] * weight_[i], f2 = corridorCurvature_[i] * across_[i] * across_[i];
    for (std::size_t b = 0; b < index.size(); ++b) {
      const auto col = static_cast<Eigen::Index>(b);
      const double l = w2 * local_(col, i), f = f2 * normal_(col, i), n = dampingUnit_ * normal_(col, i),
                   t = dampingUnit_ * tangent_(col, i);
      double* stiff = &stiffness_.entry(index[b], 0);
      double* mass = &mass_.entry(index[b], 0);
      for (std::size_t a = b; a < index.size(); ++a) {
        const auto row = static_cast<Eigen::Index>(a);
        const int below = index[a] - index[b];
        stiff[below] += l * local_(row, i) + f * normal_(row, i) + kTangentFloor * t * tangent_(row, i);
        mass[below] += n * normal_(row, i) + kTangentDamping * t * tangent_(row, i);
      }
    }
  }
}

FairingModel::Integral FairingModel::cumulative(const Eigen::VectorXd& values) const {
  const int count = static_cast<int>(values.size());
  Eigen::VectorXd result(count);
  double sum = 0.0;
  result[0] = 0.0;
  for (int k = 0; k < (setup_->closed ? count : count - 1); ++k) {
    const IntervalRule rule = intervalRule(k, count, setup_->closed);
    for (std::size_t l = 0; l < 4; ++l) sum += stepLength_ * rule.factor[l] * values[rule.sample[l]];
    if (k + 1 < count) result[k + 1] = sum;
  }
  return {std::move(result), sum};
}

Eigen::VectorXd FairingModel::cumulativeTransposed(const Eigen::VectorXd& values, double total) const {
  const int count = static_cast<int>(values.size());
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  double sum = total;
  for (int k = (setup_->closed ? count : count - 1) - 1; k >= 0; --k) {
    if (k + 1 < count) sum += values[k + 1];
    const IntervalRule rule = intervalRule(k, count, setup_->closed);
    for (std::size_t l = 0; l < 4; ++l) result[rule.sample[l]] += stepLength_ * rule.factor[l] * sum;
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
  const int count = setup_->sampleCount();
  Eigen::VectorXd local(count), normal(count);
  for (int i = 0; i < count; ++i) {
    local[i] = dot(local_, i, v);
    normal[i] = dot(normal_, i, v);
  }
  return applyTo(local, normal, setup_->closed ? dot(tangent_, 0, v) : 0.0);
}

Eigen::VectorXd FairingModel::applyTransposed(const Eigen::VectorXd& y) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(setup_->unknowns.count());
  const Transposed back = transposed(y);
  for (int i = 0; i < setup_->sampleCount(); ++i) {
    accumulate(local_, i, back.local[i], out);
    accumulate(normal_, i, back.normal[i], out);
  }
  if (setup_->closed) accumulate(tangent_, 0, back.shift, out);
  return out;
}

Eigen::VectorXd FairingModel::distances(const Eigen::VectorXd& v) const {
  Eigen::VectorXd result(setup_->sampleCount());
  for (int i = 0; i < setup_->sampleCount(); ++i) result[i] = across_[i] * dot(normal_, i, v);
  return result;
}

Eigen::VectorXd FairingModel::applyNormal(const Eigen::VectorXd& v, double damping) const {
  constexpr int kQuintic = 12;  // unknowns of a span whose control points are all free: the usual case, in registers
  return setup_->unknowns.stride() == kQuintic ? applyNormalOf<kQuintic>(v, damping)
                                               : applyNormalOf<Eigen::Dynamic>(v, damping);
}

/// All rows of a sample are gone through at once: this is what conjugate gradients spend their time on. Spans with
/// fewer unknowns have zeros behind them.
template <int Stride>
Eigen::VectorXd FairingModel::applyNormalOf(const Eigen::VectorXd& v, double damping) const {
  using Row = Eigen::Map<const Eigen::Matrix<double, Stride, 1>>;
  const int count = setup_->sampleCount();
  const Eigen::Index stride = setup_->unknowns.stride();
  const auto indexOf = [&](int i) { return setup_->unknowns.indices(state_->arc.places[i].span); };
  Eigen::VectorXd local(count), normal(count), tangent(count);
  Eigen::Matrix<double, Stride, 1> near = Eigen::Matrix<double, Stride, 1>::Zero(stride);
  for (int i = 0; i < count; ++i) {
    const auto index = indexOf(i);
    near.setZero();
    for (std::size_t k = 0; k < index.size(); ++k) near[static_cast<Eigen::Index>(k)] = v[index[k]];
    local[i] = Row(&local_(0, i), stride).dot(near);
    normal[i] = Row(&normal_(0, i), stride).dot(near);
    tangent[i] = Row(&tangent_(0, i), stride).dot(near);
  }
  const Eigen::VectorXd y = applyTo(local, normal, setup_->closed ? tangent[0] : 0.0);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  const Transposed back = transposed(y);
  const double along = damping * kTangentDamping * dampingUnit_ + tangentFloor_, across = damping * dampingUnit_;
  for (int i = 0; i < count; ++i) {
    const auto index = indexOf(i);
    const double n = back.normal[i] + (corridorCurvature_[i] * across_[i] * across_[i] + across) * normal[i];
    const double t = along * tangent[i] + (setup_->closed && i == 0 ? back.shift : 0.0);
    near =
        back.local[i] * Row(&local_(0, i), stride) + n * Row(&normal_(0, i), stride) + t * Row(&tangent_(0, i), stride);
    for (std::size_t k = 0; k < index.size(); ++k) out[index[k]] += near[static_cast<Eigen::Index>(k)];
  }
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
