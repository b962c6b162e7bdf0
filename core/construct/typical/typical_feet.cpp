// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_feet.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/curve/foot_step.h"

namespace batten {
namespace {

constexpr int kFootSteps = 15;
constexpr double kLongestFootStep = 0.5, kFirstFoot = -0.3, kLastFoot = 1.5;  // [parameter]
constexpr double kFootSettled = 1e-8;                                         // [parameter]

std::complex<double> asComplex(const Vec2& v) { return {v.x(), v.y()}; }
Vec2 asVector(const std::complex<double>& z) { return {z.real(), z.imag()}; }

}  // namespace

std::vector<CurveFoot> feetOn(const TypicalCurve& c, std::span<const Vec2> points) {
  const std::complex<double> z = std::polar(c.ratio, c.turnRad), edge = std::polar(c.edge, c.angleRad);
  std::vector<CurveFoot> feet;
  double t = 0.0;
  for (const Vec2& p : points) {
    std::complex<double> d1, away;
    for (int i = 0; i < kFootSteps; ++i) {
      const std::complex<double> w = 1.0 + t * (z - 1.0);
      away = asComplex(c.start) + edge * t * (w * w + w + 1.0) - asComplex(p);
      d1 = 3.0 * edge * w * w;
      const double step = footStep(asVector(away), asVector(d1), asVector(6.0 * edge * w * (z - 1.0)));
      t = std::clamp(t + std::clamp(step, -kLongestFootStep, kLongestFootStep), kFirstFoot, kLastFoot);
      if (std::abs(step) < kFootSettled) break;
    }
    feet.push_back({-(std::conj(d1) * away).imag() / std::max(std::abs(d1), 1e-300), t});
  }
  return feet;
}

}  // namespace batten
