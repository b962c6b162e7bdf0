// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_curve.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace batten {

namespace {

constexpr double kLargestTurn = std::numbers::pi / 2.0;  // from edge to edge; the curve turns by twice as much

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The real root of h^3 + c h^2 + h = k for k > 0 and |c| <= 1, where the left side increases.
double ratioFor(double c, double k) {
  double low = 0.0, high = 1.0;
  while (high * (high * (high + c) + 1.0) < k) high *= 2.0;
  double h = std::cbrt(k);
  for (int i = 0; i < 100; ++i) {
    const double f = h * (h * (h + c) + 1.0) - k;
    (f > 0.0 ? high : low) = h;
    double next = h - f / (h * (3.0 * h + 2.0 * c) + 1.0);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - h) <= 1e-16 * h) break;
    h = next;
  }
  return h;
}

bool possible(double phi, double kappa) {
  return std::isfinite(phi) && std::isfinite(kappa) && phi * kappa > 0.0 && std::abs(phi) < kLargestTurn;
}

}  // namespace

std::array<Vec2, 4> TypicalCurve::controlPoints() const {
  std::array<Vec2, 4> points{start, start, start, start};
  double length = edge;
  for (std::size_t i = 1; i < 4; ++i) {
    points[i] = points[i - 1] + length * direction(angleRad + static_cast<double>(i - 1) * turnRad);
    length *= ratio;
  }
  return points;
}

double TypicalCurve::size() const { return edge * (1.0 + ratio * std::cos(turnRad) + ratio * ratio); }

double TypicalCurve::startCurvature() const { return 2.0 * ratio * std::sin(turnRad) / (3.0 * edge); }

double TypicalCurve::endCurvature() const { return startCurvature() / (ratio * ratio * ratio * ratio); }

Joint TypicalCurve::startJoint() const { return {start, direction(angleRad), startCurvature()}; }

Joint TypicalCurve::endJoint() const {
  return {controlPoints()[3], direction(angleRad + 2.0 * turnRad), endCurvature()};
}

bool TypicalCurve::isMonotone() const {
  // A curve cut exactly at its extremum is monotone but for rounding.
  constexpr double kRounding = 1e-12;
  return ratio <= std::cos(turnRad) * (1.0 + kRounding) || ratio * std::cos(turnRad) >= 1.0 - kRounding;
}

TypicalCurve TypicalCurve::toParameter(double e) const {
  const std::complex<double> z = 1.0 + e * (std::polar(ratio, turnRad) - 1.0);
  TypicalCurve other = *this;
  other.edge = e * edge;
  other.ratio = std::abs(z);
  other.turnRad = std::arg(z);
  return other;
}

std::optional<TypicalCurve> typicalFromForm(const Vec2& start, double angleRad, double startCurvature, double size,
                                            double changeOfAngleRad) {
  const double phi = 0.5 * changeOfAngleRad;
  if (!possible(phi, startCurvature) || !(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  const double h = ratioFor(std::cos(phi), 1.5 * size * startCurvature / std::sin(phi));
  return TypicalCurve{start, angleRad, size / (1.0 + h * std::cos(phi) + h * h), h, phi};
}

std::optional<TypicalCurve> typicalFromCurvatures(const Vec2& start, double angleRad, double startCurvature,
                                                  double endCurvature, double changeOfAngleRad) {
  const double phi = 0.5 * changeOfAngleRad;
  if (!possible(phi, startCurvature) || !possible(phi, endCurvature)) return std::nullopt;
  const double h = std::pow(startCurvature / endCurvature, 0.25);
  return TypicalCurve{start, angleRad, 2.0 * h * std::sin(phi) / (3.0 * startCurvature), h, phi};
}

FormGradient formGradient(const TypicalCurve& c) {
  // F(l, h, phi) = l (1 + h cos phi + h^2) - dS = 0; h^3 + cos(phi) h^2 + h - 3 dS kappa0 / (2 sin phi) = 0.
  const double h = c.ratio, l = c.edge, cosine = std::cos(c.turnRad), sine = std::sin(c.turnRad);
  const double size = c.size(), k = 1.5 * size * c.startCurvature() / sine;
  FormGradient g;
  g.ratioByTurn = (h * h * sine - k * cosine / sine) / (3.0 * h * h + 2.0 * cosine * h + 1.0);
  const double sum = 1.0 + h * cosine + h * h;
  g.edgeByTurn = -l / sum * ((cosine + 2.0 * h) * g.ratioByTurn - h * sine);
  // C(1) = l (1 + z + z^2), z = h e^(i phi).
  const std::complex<double> z = std::polar(h, c.turnRad), i(0.0, 1.0), dz = z * (g.ratioByTurn / h + i);
  const std::complex<double> end = g.edgeByTurn * (1.0 + z + z * z) + l * (dz + 2.0 * z * dz);
  g.endByTurn = {end.real(), end.imag()};
  return g;
}

}  // namespace batten
