// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/span_curve.h"

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr std::array<double, 5> kGaussAt = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                            0.9061798459386640};
constexpr std::array<double, 5> kGaussWeight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                                0.4786286704993665, 0.2369268850561891};
constexpr int kPartsPerSpan = 2;

/// Length between two positions of one span.
double lengthBetween(const SpanCurve& curve, int span, double from, double to) {
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGaussAt.size(); ++i)
    sum += kGaussWeight[i] * curve.speed({span, mid + half * kGaussAt[i]});
  return sum * half * curve.basis().width(span);
}

/// The place in the part of a span that begins at `low` at which its length, `whole` in all, has reached `wanted`.
double placeAtLength(const SpanCurve& curve, int span, double low, double whole, double wanted, double tolerance) {
  constexpr double kPart = 1.0 / kPartsPerSpan;
  const double start = low, width = curve.basis().width(span);
  const auto slope = [&](double x) { return curve.speed({span, x}) * width; };
  double high = low + kPart;
  const double f = whole > 0.0 ? std::clamp(wanted / whole, 0.0, 1.0) : 0.0;
  double guess = f;
  // First guess: the inverse as a cubic with the right slopes at both borders.
  const double v0 = slope(low), v1 = slope(high);
  if (v0 > 0.0 && v1 > 0.0) {
    const double m0 = whole / (v0 * kPart), m1 = whole / (v1 * kPart), g = 1.0 - f;
    if (m0 < 3.0 && m1 < 3.0) guess = f * f * (3.0 - 2.0 * f) + m0 * f * g * g - m1 * f * f * g;
  }
  double x = std::clamp(low + kPart * guess, low, high);
  for (int step = 0; step < 30; ++step) {
    const double miss = lengthBetween(curve, span, start, x) - wanted;
    if (std::abs(miss) <= tolerance) break;
    (miss > 0.0 ? high : low) = x;
    const double v = slope(x);
    double next = v > 0.0 ? x - miss / v : low - 1.0;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    // The error of a last Newton step is the square of the step.
    const bool settled = std::abs(next - x) < 1e-7 * kPart;
    x = next;
    if (settled) break;
  }
  return x;
}

}  // namespace

SpanBasis::SpanBasis(int degree, std::span<const double> knots, int count, int wrap)
    : degree_(degree), count_(count), wrap_(wrap) {
  const auto p = static_cast<std::size_t>(degree), size = p + 1;
  for (std::size_t k = p; k < static_cast<std::size_t>(count); ++k) {
    const double a = knots[k], h = knots[k + 1] - a;
    if (!(h > 0.0)) continue;
    breaks_.push_back(a);
    first_.push_back(static_cast<int>(k - p));
    // Cox-de Boor on polynomials in tau = (t - a) / h; n[j][i] = coefficient of tau^i of the j-th function alive in the
    // span.
    std::vector<std::vector<double>> n(size, std::vector<double>(size, 0.0));
    n[0][0] = 1.0;
    for (std::size_t m = 1; m <= p; ++m) {
      std::vector<std::vector<double>> next(size, std::vector<double>(size, 0.0));
      for (std::size_t j = 0; j < m; ++j) {
        const double left = knots[k - m + 1 + j], right = knots[k + 1 + j];
        const double scale = 1.0 / (right - left);
        for (std::size_t i = 0; i < m; ++i) {
          const double v = n[j][i] * scale;
          next[j + 1][i] += v * (a - left);
          next[j + 1][i + 1] += v * h;
          next[j][i] += v * (right - a);
          next[j][i + 1] -= v * h;
        }
      }
      n = std::move(next);
    }
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) coefficients_.push_back(n[j][i]);
    }
  }
  breaks_.push_back(knots[static_cast<std::size_t>(count)]);
}

SpanRow SpanBasis::row(const SpanPlace& place, int order) const {
  SpanRow result;
  const double h = width(place.span);
  const std::size_t size = stride();
  const double* c = &coefficients_[static_cast<std::size_t>(place.span) * size * size];
  double scale = 1.0;
  for (int d = 0; d <= std::min(order, degree_); ++d) {
    auto& out = result.d[static_cast<std::size_t>(d)];
    double power = scale;
    for (int k = d; k <= degree_; ++k) {
      double factor = power;
      for (int i = 0; i < d; ++i) factor *= k - i;
      const double* line = c + static_cast<std::size_t>(k) * size;
      for (std::size_t j = 0; j < size; ++j) out[j] += factor * line[j];
      power *= place.tau;
    }
    scale /= h;
  }
  return result;
}

SpanCurve::SpanCurve(const SpanBasis& basis, std::span<const Vec2> points) : basis_(&basis) {
  const int p = basis.degree();
  coefficients_.assign(static_cast<std::size_t>(basis.spanCount()) * static_cast<std::size_t>(p + 1), Vec2::Zero());
  for (int s = 0; s < basis.spanCount(); ++s) {
    for (int k = 0; k <= p; ++k) {
      Vec2& c =
          coefficients_[static_cast<std::size_t>(s) * static_cast<std::size_t>(p + 1) + static_cast<std::size_t>(k)];
      for (int j = 0; j <= p; ++j) {
        c += basis.coefficient(s, k, j) * points[static_cast<std::size_t>(basis.point(s, j))];
      }
    }
  }
}

Jet SpanCurve::at(const SpanPlace& place, int order) const {
  const auto p = static_cast<std::size_t>(basis_->degree());
  const Vec2* c = &coefficients_[static_cast<std::size_t>(place.span) * (p + 1)];
  Jet jet;
  jet.fill(Vec2::Zero());
  jet[0] = c[p];
  for (std::size_t k = p; k-- > 0;) {  // Horner for the Taylor coefficients at tau
    for (int d = order; d >= 1; --d) {
      jet[static_cast<std::size_t>(d)] =
          jet[static_cast<std::size_t>(d)] * place.tau + jet[static_cast<std::size_t>(d) - 1];
    }
    jet[0] = jet[0] * place.tau + c[k];
  }
  const double inverse = 1.0 / basis_->width(place.span);
  double factor = 1.0;
  for (int d = 1; d <= order; ++d) {
    factor *= d * inverse;
    jet[static_cast<std::size_t>(d)] *= factor;
  }
  return jet;
}

double SpanCurve::speed(const SpanPlace& place) const {
  const auto p = static_cast<std::size_t>(basis_->degree());
  const Vec2* c = &coefficients_[static_cast<std::size_t>(place.span) * (p + 1)];
  Vec2 sum = static_cast<double>(p) * c[p];
  for (std::size_t k = p - 1; k >= 1; --k) sum = sum * place.tau + static_cast<double>(k) * c[k];
  return sum.norm() / basis_->width(place.span);
}

double SpanCurve::bendBound(int span) const {
  const auto p = static_cast<std::size_t>(basis_->degree()), first = static_cast<std::size_t>(span) * (p + 1);
  double bound = 0.0;
  for (std::size_t k = 2; k <= p; ++k) bound += static_cast<double>(k * (k - 1)) * coefficients_[first + k].norm();
  return bound;
}

double SpanCurve::bendBound(const SpanCurve& other, int span) const {
  const auto p = static_cast<std::size_t>(basis_->degree()), first = static_cast<std::size_t>(span) * (p + 1);
  double bound = 0.0;
  for (std::size_t k = 2; k <= p; ++k) {
    bound += static_cast<double>(k * (k - 1)) * (coefficients_[first + k] - other.coefficients_[first + k]).norm();
  }
  return bound;
}

std::optional<EqualArc> equalArcPlaces(const SpanCurve& curve, int count, bool closed) {
  const int parts = curve.basis().spanCount() * kPartsPerSpan;
  std::vector<double> cumulative(static_cast<std::size_t>(parts) + 1, 0.0);
  for (int k = 0; k < parts; ++k) {
    const double from = static_cast<double>(k % kPartsPerSpan) / kPartsPerSpan;
    cumulative[static_cast<std::size_t>(k) + 1] =
        cumulative[static_cast<std::size_t>(k)] +
        lengthBetween(curve, k / kPartsPerSpan, from, from + 1.0 / kPartsPerSpan);
  }
  EqualArc result;
  result.length = cumulative.back();
  if (!(result.length > 0.0) || !std::isfinite(result.length)) return std::nullopt;
  result.places.reserve(static_cast<std::size_t>(count));
  int k = 0;
  for (int i = 0; i < count; ++i) {
    const double target = result.length * i / (closed ? count : count - 1);
    while (k + 1 < parts && cumulative[static_cast<std::size_t>(k) + 1] <= target) ++k;
    const double s0 = cumulative[static_cast<std::size_t>(k)], s1 = cumulative[static_cast<std::size_t>(k) + 1];
    const int span = k / kPartsPerSpan;
    double x = placeAtLength(curve, span, static_cast<double>(k % kPartsPerSpan) / kPartsPerSpan, s1 - s0, target - s0,
                             1e-13 * result.length);
    if (i == 0) x = static_cast<double>(k % kPartsPerSpan) / kPartsPerSpan;
    if (!closed && i == count - 1) x = static_cast<double>(k % kPartsPerSpan + 1) / kPartsPerSpan;
    result.places.push_back({span, x});
  }
  if (!closed) result.places.back() = {curve.basis().spanCount() - 1, 1.0};
  return result;
}

SpanPlace footPoint(const SpanCurve& curve, const Vec2& point, SpanPlace start) {
  const SpanBasis& basis = curve.basis();
  SpanPlace place = start;
  for (int step = 0; step < 8; ++step) {
    const Jet jet = curve.at(place, 2);
    const Vec2 gap = jet[0] - point;
    const double speed2 = jet[1].squaredNorm();
    if (!(speed2 > 0.0)) return place;
    // Beyond the centre of curvature the second derivative of the distance turns negative: fall back to Gauss-Newton.
    const double bend = speed2 + gap.dot(jet[2]);
    double move = -gap.dot(jet[1]) / (bend > 0.2 * speed2 ? bend : speed2) / basis.width(place.span);
    if (!std::isfinite(move)) return place;
    move = std::clamp(move, -1.0, 1.0);
    SpanPlace next{place.span, place.tau + move};
    // The remainder of a move over a knot is rescaled to the next span's width.
    while (next.tau < 0.0 || next.tau > 1.0) {
      const bool back = next.tau < 0.0;
      int span = next.span + (back ? -1 : 1);
      if (span < 0 || span >= basis.spanCount()) {
        if (!basis.isPeriodic()) {
          next.tau = back ? 0.0 : 1.0;
          break;
        }
        span = back ? basis.spanCount() - 1 : 0;
      }
      const double rest = (back ? -next.tau : next.tau - 1.0) * basis.width(next.span) / basis.width(span);
      next = {span, back ? 1.0 - std::min(rest, 1.0) : std::min(rest, 1.0)};
    }
    const bool settled = std::abs(move) < 1e-10 || (next.span == place.span && std::abs(next.tau - place.tau) < 1e-12);
    place = next;
    if (settled) break;
  }
  return place;
}

}  // namespace batten
