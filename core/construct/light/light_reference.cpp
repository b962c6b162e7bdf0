// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_reference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/curve/rough_length.h"

namespace batten {
namespace {

constexpr double kCornerCosine = 0.94;  // cosine of 20 degrees: more between two samples is a corner
constexpr double kTurnCosine = 0.985;   // cosine of 10 degrees: more between two samples asks for one between
constexpr int kMostHalvings = 6;        // of one step
constexpr int kFewestSteps = 4;         // in a span of the curve
constexpr int kMostSamples = 40000;     // of a curve: longer ones get larger steps
constexpr int kFewestSamples = 48;      // of a curve, however short
constexpr double kSlopeWindow = 0.01;   // of the length, over which the slope of the curvature is looked at

std::optional<LightSample> lightSampleAt(const NurbsCurve& curve, double u) {
  const std::array<Vec2, 5> d = curve.derivatives(u, 3);
  const double v = d[1].norm();
  if (!(v * (curve.end() - curve.start()) > 1e-9 * (d[0].norm() + d[1].norm()))) return std::nullopt;
  LightSample sample;
  sample.u = u;
  sample.point = d[0];
  sample.tangent = d[1] / v;
  sample.kappa = cross(d[1], d[2]) / (v * v * v);
  sample.slope = (cross(d[1], d[3]) / (v * v * v) - 3.0 * sample.kappa * d[1].dot(d[2]) / (v * v)) / v;
  if (!std::isfinite(sample.kappa) || !std::isfinite(sample.slope)) return std::nullopt;
  return sample;
}

}  // namespace

bool LightReference::add(const NurbsCurve& curve, const LightSample& next, int depth) {
  if (!samples_.empty()) {
    const LightSample before = samples_.back();
    if (before.tangent.dot(next.tangent) < kTurnCosine && depth < kMostHalvings) {
      const auto between = lightSampleAt(curve, 0.5 * (before.u + next.u));
      if (!between || !add(curve, *between, depth + 1)) return false;
      return add(curve, next, depth + 1);
    }
    if (before.tangent.dot(next.tangent) < kCornerCosine) return false;
    // Chord and sagitta: exact to the fourth order of the step.
    const double chord = (next.point - before.point).norm();
    const double bend = 0.5 * (before.kappa + next.kappa) * chord;
    samples_.push_back(next);
    samples_.back().s = before.s + chord * (1.0 + bend * bend / 24.0);
  } else {
    samples_.push_back(next);
  }
  return true;
}

bool LightReference::addSpan(const NurbsCurve& curve, double from, double to, int steps) {
  const bool last = !(to < curve.end());
  for (int k = 0; k < steps + (last ? 1 : 0); ++k) {
    const auto next = lightSampleAt(curve, from + (to - from) * k / steps);
    if (!next || !add(curve, *next, 0)) return false;
  }
  return true;
}

std::optional<LightReference> LightReference::make(const NurbsCurve& curve, bool closed, double step,
                                                   std::optional<double> diagonal, CancelCheck check) {
  LightReference made;
  made.closed_ = closed;
  const std::vector<double> breaks = curve.breaks();
  std::vector<double> lengths;
  double total = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    lengths.push_back(roughLength(curve, breaks[i], breaks[i + 1]));
    total += lengths.back();
  }
  if (!(total > 0.0) || !std::isfinite(total)) return std::nullopt;
  const double asked = std::clamp(step, total / kMostSamples, total / kFewestSamples);
  std::vector<LightSample>& samples = made.samples_;
  samples.reserve(static_cast<int>(total / asked) + kFewestSteps * breaks.size() + 1);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (check.isCancelled()) return std::nullopt;
    const int steps = std::max(kFewestSteps, static_cast<int>(std::ceil(lengths[i] / asked)));
    if (!made.addSpan(curve, breaks[i], breaks[i + 1], steps)) return std::nullopt;
  }
  made.length_ = samples.back().s;
  if (closed) {
    if (samples.front().tangent.dot(samples.back().tangent) < kCornerCosine) return std::nullopt;
    samples.pop_back();
    made.beginWhereSteepest();
  }
  return made.measureWhole(diagonal) ? std::optional(std::move(made)) : std::nullopt;
}

bool LightReference::measureWhole(std::optional<double> diagonal) {
  Eigen::AlignedBox2d box;
  points_.reserve(samples_.size());
  for (const LightSample& sample : samples_) {
    box.extend(sample.point);
    points_.push_back(sample.point);
    kappaMax_ = std::max(kappaMax_, std::abs(sample.kappa));
  }
  diagonal_ = diagonal.value_or(box.diagonal().norm());
  return diagonal_ > 0.0;
}

std::optional<LightReference> LightReference::through(const std::vector<Vec2>& points, bool closed) {
  LightReference made;
  made.closed_ = closed;
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) -> const Vec2& { return points[closed ? (i % n + n) % n : std::clamp(i, 0, n - 1)]; };
  made.samples_.resize(points.size());
  for (int i = 0; i < n; ++i) {
    LightSample& sample = made.samples_[i];
    sample.point = at(i);
    const Vec2 in = at(i) - at(i - 1), out = at(i + 1) - at(i), chord = at(i + 1) - at(i - 1);
    if (!(chord.norm() > 0.0)) return std::nullopt;
    sample.tangent = chord.normalized();
    const double length = 0.5 * (in.norm() + out.norm());
    if (in.norm() > 0.0 && out.norm() > 0.0) sample.kappa = std::atan2(cross(in, out), in.dot(out)) / length;
    sample.s = i == 0 ? 0.0 : made.samples_[i - 1].s + in.norm();
    sample.u = sample.s;
  }
  if (!closed) {  // an end has no turn of its own
    made.samples_.front().kappa = made.samples_[1].kappa;
    made.samples_.back().kappa = made.samples_[points.size() - 2].kappa;
  }
  const auto kappaAt = [&](int i) { return made.samples_[closed ? (i % n + n) % n : std::clamp(i, 0, n - 1)].kappa; };
  for (int i = 0; i < n; ++i) {
    made.samples_[i].slope = (kappaAt(i + 1) - kappaAt(i - 1)) / (at(i + 1) - at(i - 1)).norm();
  }
  made.length_ = made.samples_.back().s + (closed ? (points.front() - points.back()).norm() : 0.0);
  if (!(made.length_ > 0.0)) return std::nullopt;
  if (closed) made.beginWhereSteepest();
  return made.measureWhole({}) ? std::optional(std::move(made)) : std::nullopt;
}

void LightReference::beginWhereSteepest() {
  const int n = size();
  const int half = std::max(1, static_cast<int>(0.5 * kSlopeWindow * n));
  const auto slopeOf = [&](int i) { return samples_[(i % n + n) % n].slope; };
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) sum += slopeOf(i);
  int best = 0;
  double largest = std::abs(sum);
  for (int i = 1; i < n; ++i) {
    sum += slopeOf(i + half) - slopeOf(i - half - 1);
    if (std::abs(sum) > largest) {
      largest = std::abs(sum);
      best = i;
    }
  }
  const double shift = samples_[best].s;
  std::rotate(samples_.begin(), samples_.begin() + best, samples_.end());
  for (LightSample& sample : samples_) {
    sample.s -= shift;
    if (sample.s < 0.0) sample.s += length_;
  }
  samples_.front().s = 0.0;
}

LightFoot LightReference::foot(const Vec2& place, int hint) const {
  const int n = size();
  int index = hint;
  double best = (points_[index] - place).squaredNorm();
  for (const int step : {1, -1}) {
    int moved = 0;
    while (moved < n) {
      int next = index + step;
      if (next < 0 || next >= n) {
        if (!closed_) break;
        next = next < 0 ? n - 1 : 0;
      }
      const double squared = (points_[next] - place).squaredNorm();
      if (squared >= best) break;
      best = squared;
      index = next;
      ++moved;
    }
    if (moved > 0) break;
  }
  const LightSample& sample = at(index);
  const Vec2 away = place - sample.point;
  LightFoot foot;
  foot.index = index;
  foot.along = away.dot(sample.tangent);
  foot.offset = away.dot(leftNormal(sample.tangent)) - 0.5 * sample.kappa * foot.along * foot.along;
  return foot;
}

Vec2 LightReference::normalAt(const LightFoot& foot) const {
  const LightSample& sample = at(foot.index);
  return (leftNormal(sample.tangent) - sample.kappa * foot.along * sample.tangent).normalized();
}

int LightReference::indexAt(double s) const {
  if (closed_) s -= length_ * std::floor(s / length_);
  const auto above = std::lower_bound(samples_.begin(), samples_.end(), s,
                                      [](const LightSample& sample, double value) { return sample.s < value; });
  const int i = static_cast<int>(above - samples_.begin());
  if (i == 0) return 0;
  if (i == size()) return closed_ && length_ - s < s - samples_.back().s ? 0 : size() - 1;
  return at(i).s - s < s - at(i - 1).s ? i : i - 1;
}

Vec2 LightReference::pointAt(double s) const {
  const LightSample& sample = at(indexAt(s));
  double along = closed_ ? s - length_ * std::floor(s / length_) - sample.s : std::clamp(s, 0.0, length_) - sample.s;
  if (closed_ && along > 0.5 * length_) along -= length_;
  return sample.point + along * sample.tangent + 0.5 * sample.kappa * along * along * leftNormal(sample.tangent);
}

}  // namespace batten
