// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/coarse_setups.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/curve/curvature.h"
#include "core/solve/dense_solve.h"

namespace batten {
namespace {

constexpr int kCoarseDegree = 5;  // below it the slope of the curvature jumps at knots
/// Numbers of spans, each about 1.6 times the one before.
constexpr std::array kOpenSpans = {1, 2, 3, 5, 8, 13, 21, 34, 55, 89};
constexpr std::array kClosedSpans = {5, 6, 8, 13, 21, 34, 55, 89};  // a periodic quintic has five at least
/// Share of the sketched curve's spans that a start may have: more would win nothing over the curve itself.
constexpr double kMostSpans = 0.75;
/// Of the mean span: breakpoints nearer to each other are as good as one.
constexpr double kShortestSpan = 1e-3;
/// A sketch of fewer extrema does not tremble; one of more may, and is tried over so many spans.
constexpr int kTrembles = 6;
constexpr std::array kCalmSpans = {13, 5, 3};  // the most first

/// Breakpoints 0..1, by shares of the arc length.
std::vector<double> breaksFor(const FairingSetup& sketch, int spans) {
  const SpanBasis& basis = sketch.basis;
  const int sketched = basis.spanCount();
  const double samples = sketch.closed ? sketch.sampleCount() : sketch.sampleCount() - 1;
  std::vector<double> share, density;
  for (int k = 0; k <= sketched; ++k) {
    const double at = k == 0 ? 0.0 : k == sketched ? 1.0 : sketch.sampleAt({k, 0.0}) / samples;
    share.push_back(k == 0 ? at : std::max(at, share.back()));
    density.push_back(0.5 * share.back() + 0.5 * k / sketched);
  }
  std::vector<double> breaks{0.0};
  std::size_t k = 0;
  for (int j = 1; j < spans; ++j) {
    const double wanted = static_cast<double>(j) / spans;
    while (k + 2 < density.size() && density[k + 1] < wanted) ++k;
    const double part = (wanted - density[k]) / (density[k + 1] - density[k]);
    breaks.push_back(share[k] + std::clamp(part, 0.0, 1.0) * (share[k + 1] - share[k]));
  }
  breaks.push_back(1.0);
  return breaks;
}

std::vector<double> clampedKnots(const std::vector<double>& breaks) {
  std::vector<double> knots(kCoarseDegree, 0.0);
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), kCoarseDegree, 1.0);
  return knots;
}

std::vector<double> periodicKnots(const std::vector<double>& breaks) {
  const int spans = static_cast<int>(breaks.size()) - 1;
  std::vector<double> knots;
  for (int i = -kCoarseDegree; i <= spans + kCoarseDegree; ++i) {
    const int lap = i >= 0 ? i / spans : -((spans - 1 - i) / spans);
    knots.push_back(i == spans ? 1.0 : breaks[i - lap * spans] + lap);
  }
  return knots;
}

SpanPlace placeAt(const SpanBasis& basis, double u) {
  int span = 0;
  while (span + 1 < basis.spanCount() && basis.begin(span + 1) <= u) ++span;
  return {span, std::clamp((u - basis.begin(span)) / basis.width(span), 0.0, 1.0)};
}

/// Least squares at the samples of the sketch; open curves keep their ends.
std::optional<std::vector<Vec2>> nearestPoints(const FairingSetup& sketch, const SpanBasis& basis) {
  const int count = basis.pointCount(), samples = sketch.sampleCount();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count), right = Eigen::MatrixXd::Zero(count, 2);
  for (int i = 0; i < samples; ++i) {
    const SpanPlace place = placeAt(basis, sketch.fraction(i));
    const SpanRow row = basis.row(place, 0);
    const Vec2 at = sketch.reference.at(sketch.start.places[i], 0)[0];
    for (int j = 0; j <= kCoarseDegree; ++j) {
      right.row(basis.point(place.span, j)) += row.d[0][j] * at.transpose();
      for (int k = 0; k <= kCoarseDegree; ++k)
        matrix(basis.point(place.span, j), basis.point(place.span, k)) += row.d[0][j] * row.d[0][k];
    }
  }
  std::vector<Vec2> points(count);
  if (sketch.closed) {
    const Eigen::MatrixXd solved = solveSymmetric(matrix, right);
    if (!solved.allFinite()) return std::nullopt;
    for (int j = 0; j < count; ++j) points[j] = solved.row(j).transpose();
    return points;
  }
  points.front() = sketch.reference.at({0, 0.0}, 0)[0];
  points.back() = sketch.reference.at({sketch.basis.spanCount() - 1, 1.0}, 0)[0];
  const int inner = count - 2;
  const Eigen::MatrixXd rest = right.middleRows(1, inner) - matrix.block(1, 0, inner, 1) * points.front().transpose() -
                               matrix.block(1, count - 1, inner, 1) * points.back().transpose();
  const Eigen::MatrixXd solved = solveSymmetric(matrix.block(1, 1, inner, inner), rest);
  if (!solved.allFinite()) return std::nullopt;
  for (int j = 0; j < inner; ++j) points[j + 1] = solved.row(j).transpose();
  return points;
}

/// Turns the second control point of an end onto the sketch's tangent and moves the third across it to the sketch's
/// curvature, where they are held.
void holdEnd(const FairingSetup& sketch, const SpanBasis& basis, bool atEnd, const EndHold& hold,
             std::vector<Vec2>& points) {
  if (!hold.tangent && !hold.curvature) return;
  const int last = basis.pointCount() - 1, sign = atEnd ? -1 : 1, first = atEnd ? last : 0;
  const Jet wanted =
      atEnd ? sketch.reference.at({sketch.basis.spanCount() - 1, 1.0}, 4) : sketch.reference.at({0, 0.0}, 4);
  if (!(wanted[1].norm() > 0.0)) return;
  const Vec2 tangent = wanted[1].normalized();
  Vec2& second = points[first + sign];
  second = points[first] + sign * (second - points[first]).norm() * tangent;
  if (!hold.curvature) return;
  const SpanPlace place = atEnd ? SpanPlace{basis.spanCount() - 1, 1.0} : SpanPlace{0, 0.0};
  const SpanCurve now(basis, points);
  const CurvatureJet has = curvatureJet(now.at(place, 4)), asked = curvatureJet(wanted);
  const double share = basis.row(place, 2).d[2][atEnd ? kCoarseDegree - 2 : 2];
  points[first + 2 * sign] += (asked.kappa - has.kappa) * has.speed * has.speed / share * leftNormal(tangent);
}

}  // namespace

std::shared_ptr<const FairingSetup> coarseSetup(const std::shared_ptr<const FairingSetup>& sketch, int spans) {
  const int holds = (sketch->startHold.curvature ? 2
                     : sketch->startHold.tangent ? 1
                                                 : 0) +
                    (sketch->endHold.curvature ? 2
                     : sketch->endHold.tangent ? 1
                                               : 0);
  if (spans > kMostSpans * sketch->basis.spanCount()) return nullptr;
  if (!sketch->closed && spans + kCoarseDegree < 4 + holds) return nullptr;
  auto setup = std::make_shared<FairingSetup>();
  const std::vector<double> breaks = breaksFor(*sketch, spans);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    if (!(breaks[i] - breaks[i - 1] > kShortestSpan / spans)) return nullptr;
  }
  setup->sketch = sketch;
  setup->startHold = sketch->startHold;
  setup->endHold = sketch->endHold;
  setup->closed = sketch->closed;
  setup->check = sketch->check;
  setup->extent = sketch->extent;
  setup->reference = sketch->reference;
  setup->start = sketch->start;
  const std::vector<double> knots = clampedKnots(breaks);
  std::vector<Vec2> clampedPoints(spans + kCoarseDegree, Vec2::Zero());
  if (sketch->closed) {
    setup->periodic.knots = periodicKnots(breaks);
    setup->basis = SpanBasis(kCoarseDegree, setup->periodic.knots, spans + kCoarseDegree, spans);
  } else {
    setup->basis = SpanBasis(kCoarseDegree, knots, spans + kCoarseDegree, 0);
  }
  auto points = nearestPoints(*sketch, setup->basis);
  if (!points) return nullptr;
  if (!sketch->closed) {
    holdEnd(*sketch, setup->basis, false, sketch->startHold, *points);
    holdEnd(*sketch, setup->basis, true, sketch->endHold, *points);
    clampedPoints = *points;
  }
  setup->points = std::move(*points);
  auto original = NurbsCurve::make(kCoarseDegree, knots, clampedPoints);
  if (original && sketch->closed) {
    setup->periodic.points = setup->points;
    original = fromPeriodic(setup->periodic, *original);
  }
  if (!original) return nullptr;
  setup->original = std::move(*original);
  setup->unknowns = Unknowns(setup->basis, SpanCurve(setup->basis, setup->points), sketch->startHold, sketch->endHold);
  return setup;
}

std::vector<std::shared_ptr<const FairingSetup>> coarseSetups(const std::shared_ptr<const FairingSetup>& sketch) {
  std::vector<std::shared_ptr<const FairingSetup>> setups;
  const std::span<const int> counts = sketch->closed ? std::span<const int>(kClosedSpans) : kOpenSpans;
  for (const int spans : counts) {
    if (sketch->check.isCancelled()) break;
    if (auto setup = coarseSetup(sketch, spans)) setups.push_back(std::move(setup));
  }
  return setups;
}

std::vector<std::shared_ptr<const FairingSetup>> calmSetups(const std::shared_ptr<const FairingSetup>& sketch) {
  std::vector<std::shared_ptr<const FairingSetup>> result;
  if (sketch->isPart) return result;
  int extrema = countedExtrema(sketch->original, sketch->closed, sketch->check);
  for (const int spans : kCalmSpans) {
    if (extrema < kTrembles) break;
    auto calm = coarseSetup(sketch, spans);
    const int left = calm ? countedExtrema(calm->original, calm->closed, calm->check) : extrema;
    if (2 * left >= extrema) continue;
    result.push_back(std::move(calm));
    extrema = left;
  }
  return result;
}

}  // namespace batten
