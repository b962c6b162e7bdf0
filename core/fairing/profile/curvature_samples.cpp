// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/curvature_samples.h"

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/span_curve.h"

namespace batten {
namespace {

constexpr int kCurvaturePlaces = 4;  // a span

}  // namespace

std::vector<double> CurvatureSamples::perimeters() const {
  std::vector<double> all;
  all.reserve(count());
  for (int i = 0; i < count(); ++i) all.push_back(perimeter(i));
  return all;
}

std::vector<CurvatureSample> CurvatureSamples::places() const {
  std::vector<CurvatureSample> all;
  all.reserve(count());
  for (int i = 0; i < count(); ++i) all.push_back({perimeter(i), kappa[i]});
  return all;
}

/// Plain B-splines take the fast way; what it refuses, the general one.
CurvatureSamples sampledCurvature(const NurbsCurve& curve, int least) {
  CurvatureSamples result;
  const int spans = static_cast<int>(curve.breaks().size()) - 1;
  const int count = std::max(least, kCurvaturePlaces * spans + 1);
  result.kappa.assign(count, 0.0);
  if (!curve.isRational() && curve.degree() >= 2 && curve.degree() <= kMaxDegree) {
    const SpanBasis basis(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
    const SpanCurve fast(basis, curve.controlPoints());
    if (const auto places = equalArcPlaces(fast, count, false)) {
      result.lengthMm = places->length;
      for (std::size_t i = 0; i < result.kappa.size(); ++i) {
        const Jet jet = fast.at(places->places[i], 2);
        const double speed = jet[1].norm(), kappa = cross(jet[1], jet[2]) / (speed * speed * speed);
        result.kappa[i] = std::isfinite(kappa) ? kappa : 0.0;
      }
      return result;
    }
  }
  const std::vector<CurveSample> samples = sampleByArcLength(curve, count);
  for (std::size_t i = 0; i < samples.size() && i < result.kappa.size(); ++i) result.kappa[i] = samples[i].kappa;
  result.lengthMm = ArcLength(curve).total();
  return result;
}

}  // namespace batten
