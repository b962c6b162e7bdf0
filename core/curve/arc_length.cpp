// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/arc_length.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/curve/curvature.h"
#include "core/solve/gauss_legendre.h"

namespace batten {

namespace {

constexpr auto kTenPoints = gaussLegendre<10>();  // of a part; its halves by the same rule say how good it is
constexpr double kRelativeChange = 1e-11;         // by halving a part once more
constexpr int kMaxDepth = 30;                     // halvings of a span, to a thousand-millionth of it

double speed(const SpanPolynomials& curve, double u) { return curve.at(u)[1].norm(); }

double gauss(const SpanPolynomials& curve, double from, double to) {
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kTenPoints.node.size(); ++i)
    sum += kTenPoints.weight[i] * speed(curve, mid + half * kTenPoints.node[i]);
  return sum * half;
}

/// Subdivides [from, to] until halving changes nothing; appends the borders and the length up to them.
struct Subdivision {
  const SpanPolynomials& curve;
  double negligible;       ///< Change of length that does not matter, whatever the piece.
  std::size_t mostBreaks;  ///< Borders after which no interval is halved any more: rounding noise must not be chased.
  std::vector<double>& breaks;
  std::vector<double>& cumulative;

  void add(double from, double to, double whole, int depth) {
    const double mid = 0.5 * (from + to);
    const double left = gauss(curve, from, mid), right = gauss(curve, mid, to);
    const double change = std::abs(whole - left - right);
    const bool fine = change <= kRelativeChange * (left + right) || change <= negligible;
    if (fine || depth >= kMaxDepth || breaks.size() > mostBreaks || !(mid > from && mid < to)) {
      breaks.insert(breaks.end(), {mid, to});
      cumulative.push_back(cumulative.back() + left);
      cumulative.push_back(cumulative.back() + right);
      return;
    }
    add(from, mid, left, depth + 1);
    add(mid, to, right, depth + 1);
  }
};

}  // namespace

ArcLength::ArcLength(const NurbsCurve& curve, CancelCheck check) : curve_(curve) {
  const std::vector<double> spans = curve.breaks();
  std::vector<double> rough(spans.size(), 0.0);
  double roughTotal = 0.0;
  for (std::size_t i = 0; i + 1 < spans.size() && !check.isCancelled(); ++i)
    roughTotal += rough[i] = gauss(curve_, spans[i], spans[i + 1]);
  breaks_ = {spans.front()};
  cumulative_ = {0.0};
  breaks_.reserve(2 * spans.size());
  cumulative_.reserve(2 * spans.size());
  double largest = roughTotal;
  for (const Vec2& p : curve.controlPoints()) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  Subdivision subdivision{curve_, 1e-14 * largest, 4096 + 64 * spans.size(), breaks_, cumulative_};
  for (std::size_t i = 0; i + 1 < spans.size() && !check.isCancelled(); ++i)
    subdivision.add(spans[i], spans[i + 1], rough[i], 0);
  speeds_.reserve(breaks_.size());
  for (const double u : breaks_) speeds_.push_back(speed(curve_, u));
  total_ = cumulative_.back();
}

double ArcLength::at(double u) const {
  if (!(u > breaks_.front())) return 0.0;
  if (u >= breaks_.back()) return total_;
  const std::size_t i = std::upper_bound(breaks_.begin(), breaks_.end(), u) - breaks_.begin() - 1;
  if (u - breaks_[i] <= 0.5 * (breaks_[i + 1] - breaks_[i])) return cumulative_[i] + gauss(curve_, breaks_[i], u);
  return cumulative_[i + 1] - gauss(curve_, u, breaks_[i + 1]);
}

double ArcLength::parameter(double s) const {
  if (!(s > 0.0)) return breaks_.front();
  if (s >= total_) return breaks_.back();
  const std::size_t i = std::upper_bound(cumulative_.begin(), cumulative_.end(), s) - cumulative_.begin() - 1;
  const double u0 = breaks_[i], width = breaks_[i + 1] - u0;
  const double length = cumulative_[i + 1] - cumulative_[i];
  const double f = std::clamp((s - cumulative_[i]) / length, 0.0, 1.0);
  // First guess: the inverse as a cubic with the right slopes du/ds = 1/|R'| at both borders.
  double guess = u0 + f * width;
  if (speeds_[i] > 0.0 && speeds_[i + 1] > 0.0) {
    const double m0 = length / (speeds_[i] * width), m1 = length / (speeds_[i + 1] * width), g = 1.0 - f;
    if (m0 < 3.0 && m1 < 3.0) guess = u0 + width * (f * f * (3.0 - 2.0 * f) + m0 * f * g * g - m1 * f * f * g);
  }
  double low = u0, high = breaks_[i + 1];
  double u = std::clamp(guess, low, high);
  double here =
      u - u0 <= high - u ? cumulative_[i] + gauss(curve_, u0, u) : cumulative_[i + 1] - gauss(curve_, u, high);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double residual = here - s;
    if (std::abs(residual) <= 1e-14 * total_) break;
    (residual > 0.0 ? high : low) = u;
    const double v = speed(curve_, u);
    double next = v > 0.0 ? u - residual / v : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == u || !(next > low && next < high)) break;
    // The last Newton step of a converging run needs no new integral: its error is the square of the step.
    const double step = next - u;
    if (std::abs(step) < 1e-7 * width) return next;
    here += gauss(curve_, u, next);
    u = next;
  }
  return u;
}

std::vector<CurveSample> sampleByArcLength(const NurbsCurve& curve, int count, CancelCheck check) {
  const ArcLength length(curve, check);
  std::vector<CurveSample> samples(count);
  for (int i = 0; i < count && !check.isCancelled(); ++i) {
    CurveSample& sample = samples[i];
    sample.s = i + 1 == count ? length.total() : length.total() * i / (count - 1);
    sample.u = i + 1 == count ? curve.end() : length.parameter(sample.s);
    const auto d = curve.derivatives(sample.u, 2);
    sample.point = d[0];
    sample.speed = d[1].norm();
    if (sample.speed > 0.0) sample.tangent = d[1] / sample.speed;
    sample.kappa = curvature(curve, sample.u).value_or(0.0);
  }
  return samples;
}

}  // namespace batten
