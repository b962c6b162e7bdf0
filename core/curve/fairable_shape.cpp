// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/fairable_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/held_end.h"
#include "core/curve/knot_operations.h"
#include "core/curve/periodic_form.h"
#include "core/solve/banded_least_squares.h"

namespace batten {
namespace {

constexpr int kFairableDegree = 5;           // whose curvature has a continuous slope
constexpr double kLongestSpan = 1.0 / 16.0;  // of the length
constexpr int kMostParts = 64;               // of one span
// of the curve: numbers that are tried in turn
constexpr std::array kSmoothSpans = {16, 24, 32, 48, 64, 96, 128, 192, 256};
constexpr int kPlacesPerSpan = 12;  // samples of each

/// Quintic knots over equal spans of the length: clamped, or running on over the seam.
std::vector<double> evenKnots(int spans, double length, bool closed) {
  std::vector<double> knots;
  for (int i = -kFairableDegree; i <= spans + kFairableDegree; ++i) {
    const int at = closed ? i : std::clamp(i, 0, spans);
    knots.push_back(length * at / spans);
  }
  return knots;
}

std::optional<NurbsCurve> openFit(const std::vector<CurveSample>& samples, int spans) {
  const double length = samples.back().s;
  auto knots = evenKnots(spans, length, false);
  const int count = spans + kFairableDegree;
  const Vec2 first = samples.front().point, last = samples.back().point;
  BandedLeastSquares system(count - 2, kFairableDegree + 1, false);
  for (const CurveSample& sample : samples) {
    const BasisRow row = basis(kFairableDegree, knots, count, sample.s, 0);
    std::array<double, kFairableDegree + 1> values{};
    Vec2 right = sample.point;
    std::optional<int> from;
    int used = 0;
    for (int j = 0; j <= kFairableDegree; ++j) {
      const double value = row.values[0][j];
      const int column = row.first + j;
      if (column == 0 || column == count - 1) {
        right -= value * (column == 0 ? first : last);
        continue;
      }
      if (!from) from = column - 1;
      values[used++] = value;
    }
    if (from) system.add(*from, std::span(values).first(used), right);
  }
  auto inner = system.solve();
  if (!inner) return std::nullopt;
  std::vector<Vec2> points{first};
  points.insert(points.end(), inner->begin(), inner->end());
  points.push_back(last);
  auto made = NurbsCurve::make(kFairableDegree, std::move(knots), std::move(points));
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

std::optional<NurbsCurve> closedFit(const std::vector<CurveSample>& samples, int spans) {
  const double length = samples.back().s;
  PeriodicForm form;
  form.knots = evenKnots(spans, length, true);
  const int count = spans + kFairableDegree;
  BandedLeastSquares system(spans, kFairableDegree + 1, true);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const BasisRow row = basis(kFairableDegree, form.knots, count, samples[i].s, 0);
    std::array<double, kFairableDegree + 1> values{};
    for (std::size_t j = 0; j < values.size(); ++j) values[j] = row.values[0][j];
    system.add(row.first, values, samples[i].point);
  }
  auto solved = system.solve();
  if (!solved) return std::nullopt;
  form.points = std::move(*solved);
  const std::vector<Vec2> none(count, Vec2::Zero());
  const auto like = NurbsCurve::make(kFairableDegree, evenKnots(spans, length, false), none);
  if (!like) return std::nullopt;
  auto made = fromPeriodic(form, *like);
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

/// With the direction and the curvature that the ends of another curve have.
std::optional<NurbsCurve> withEndsOf(const NurbsCurve& curve, NurbsCurve fitted) {
  for (const bool atEnd : {false, true}) {
    const double u = atEnd ? curve.end() : curve.start();
    const Vec2 along = curve.derivatives(u, 1)[1];
    const auto kappa = curvature(curve, u);
    if (!(along.norm() > 0.0) || !kappa) continue;
    auto held = withEnd(fitted, atEnd, along.normalized(), *kappa);
    if (!held) return std::nullopt;
    fitted = std::move(*held);
  }
  return fitted;
}

}  // namespace

std::optional<NurbsCurve> fairableShape(const NurbsCurve& curve) {
  if (curve.isRational()) return std::nullopt;
  const int degree = std::max(kFairableDegree, curve.degree());
  auto shape = curve.degree() < degree ? elevated(curve, degree) : Result<NurbsCurve>(curve);
  if (!shape) return std::nullopt;
  const ArcLength arc(*shape);
  const double longest = kLongestSpan * arc.total();
  const std::vector<double> breaks = shape->breaks();
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double length = arc.at(breaks[i]) - arc.at(breaks[i - 1]);
    const int parts = std::clamp(static_cast<int>(std::ceil(length / longest)), 1, kMostParts);
    for (int k = 1; k < parts; ++k) {
      auto finer = insertKnot(*shape, breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / parts, 1);
      if (!finer) return std::nullopt;
      shape = std::move(finer);
    }
  }
  if (*shape == curve) return std::nullopt;
  return std::move(*shape);
}

std::optional<NurbsCurve> smoothShape(const NurbsCurve& curve, bool closed, double tolerance) {
  if (curve.isEmpty()) return std::nullopt;
  for (const int spans : kSmoothSpans) {
    const auto samples = sampleByArcLength(curve, kPlacesPerSpan * spans + 1);
    if (!(samples.back().s > 0.0)) return std::nullopt;
    auto fitted = closed ? closedFit(samples, spans) : openFit(samples, spans);
    if (fitted && !closed) fitted = withEndsOf(curve, std::move(*fitted));
    if (fitted && deviation(*fitted, curve).max <= tolerance) return fitted;
  }
  return std::nullopt;
}

}  // namespace batten
