// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/construct/typical/typical_path_geometry.h"

namespace batten {

namespace {

/// The slack of a monotone segment is never less than about this square over its unknown: it softens the border.
constexpr double kSoftness = 0.01;
/// A segment on the border of monotone curvature begins this far inside it [logarithm of the ratio].
constexpr double kLeastRoom = 1e-3;
constexpr double kLargestElementTurn = 0.85;  // [rad] from edge to edge of a typical curve
constexpr double kLargestLogRatio = 1.7;      // of its edges: 5.5 to 1
constexpr double kLargestHermiteTurn = 0.4;   // [rad] of one Hermite piece in place of two

double slack(double v) { return 0.5 * (v + std::sqrt(v * v + 4.0 * kSoftness * kSoftness)); }
double slackSlope(double v) { return 0.5 * (1.0 + v / std::sqrt(v * v + 4.0 * kSoftness * kSoftness)); }

}  // namespace

Joint PathState::joint() const { return {point, {std::cos(angleRad), std::sin(angleRad)}, kappa}; }

double PathElement::turn() const { return std::exp(logTurn); }

double PathElement::logRatio() const {
  if (trend == Trend::Free) return shape;
  const double border = std::log(std::cos(turn())) - slack(shape);
  return trend == Trend::Rising ? border : -border;
}

std::array<double, 2> PathElement::logRatioSlopes() const {
  if (trend == Trend::Free) return {0.0, 1.0};
  const double phi = turn(), byTurn = -std::tan(phi) * phi, byShape = -slackSlope(shape);
  if (trend == Trend::Rising) return {byTurn, byShape};
  return {-byTurn, -byShape};
}

void PathElement::setLogRatio(double logRatio) {
  if (trend == Trend::Free) {
    shape = logRatio;
    return;
  }
  const double border = std::log(std::cos(turn()));
  const double room = std::max(border - (trend == Trend::Rising ? logRatio : -logRatio), kLeastRoom);
  shape = room - kSoftness * kSoftness / room;
}

void PathElement::setTrend(Trend wanted) {
  const double ratio = logRatio();
  trend = wanted;
  setLogRatio(ratio);
}

bool PathElement::isMonotone() const {
  const double border = std::log(std::cos(turn())), ratio = logRatio();
  // A curve cut exactly at its extremum is monotone but for rounding.
  return ratio <= border + 1e-12 || ratio >= -border - 1e-12;
}

bool TypicalPath::isFree(std::size_t state) const {
  if (state == 0) return true;
  if (elements[state - 1].typical) return false;
  return !(closed && state == elements.size());
}

bool TypicalPath::update() {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const PathElement& element = elements[e];
    const PathState& from = states[e];
    if (!from.point.allFinite() || !std::isfinite(from.angleRad) || !std::isfinite(from.kappa)) return false;
    if (!element.typical) {
      if (closed && e + 1 == elements.size()) states.back() = states.front();
      if (!((states[e + 1].point - from.point).norm() > 0.0)) return false;
      continue;
    }
    const double turn = element.turn(), ratio = element.logRatio();
    if (!(turn < kLargestElementTurn) || !(turn > 1e-7) || !(std::abs(ratio) < kLargestLogRatio)) return false;
    if (!(from.kappa * element.side > 0.0)) return false;
    const TypicalCurve curve = typical(e);
    states[e + 1].point = curve.controlPoints()[3];
    states[e + 1].angleRad = from.angleRad + 2.0 * curve.turnRad;
    states[e + 1].kappa = from.kappa * std::exp(-4.0 * ratio);
  }
  return true;
}

TypicalCurve TypicalPath::typical(std::size_t e) const {
  const PathElement& element = elements[e];
  const double phi = element.side * element.turn(), h = std::exp(element.logRatio());
  return {states[e].point, states[e].angleRad, 2.0 * h * std::sin(phi) / (3.0 * states[e].kappa), h, phi};
}

HermiteLength hermiteLength(const PathState& a, const PathState& b) {
  const Vec2 chord = b.point - a.point;
  const double c = chord.norm(), direction = std::atan2(chord.y(), chord.x());
  const auto wrapped = [](double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); };
  const double alpha = wrapped(a.angleRad - direction), beta = wrapped(b.angleRad - direction);
  const double stretch = 1.0 + (2.0 * alpha * alpha - alpha * beta + 2.0 * beta * beta) / 30.0;
  const double byAlpha = c * (4.0 * alpha - beta) / 30.0, byBeta = c * (4.0 * beta - alpha) / 30.0;
  // By the chord: its length, and its direction that both angles are measured from.
  const Vec2 unit = chord / c, byChord = stretch * unit - (byAlpha + byBeta) / c * leftNormal(unit);
  return {c * stretch, {-byChord.x(), -byChord.y(), byAlpha, 0.0}, {byChord.x(), byChord.y(), byBeta, 0.0}};
}

double TypicalPath::hermiteLength(std::size_t e) const {
  return batten::hermiteLength(states[e], states[e + 1]).length;
}

Quintic TypicalPath::quintic(std::size_t e) const {
  if (!elements[e].typical) return quinticHermite(states[e].joint(), states[e + 1].joint(), hermiteLength(e));
  const auto q = typical(e).controlPoints();
  return elevatedCubic(q[0], q[1], q[2], q[3]);
}

void TypicalPath::split(std::size_t e, double t) {
  const PathGeometry geometry(*this, e);
  const auto d = geometry.at(t, 2);
  PathState middle{d[0], std::atan2(d[1].y(), d[1].x()), 0.0};
  middle.angleRad = states[e].angleRad + std::remainder(middle.angleRad - states[e].angleRad, 2.0 * std::numbers::pi);
  PathElement first = elements[e], second = first;
  if (first.typical) {
    const std::complex<double> z = std::polar(std::exp(first.logRatio()), first.side * first.turn());
    const std::complex<double> w = 1.0 + t * (z - 1.0), rest = z / w;
    first.logTurn = std::log(std::abs(std::arg(w)));
    first.setLogRatio(std::log(std::abs(w)));
    second.logTurn = std::log(std::abs(std::arg(rest)));
    second.setLogRatio(std::log(std::abs(rest)));
    middle.kappa = states[e].kappa * std::exp(-4.0 * first.logRatio());
  } else {
    middle.kappa = cross(d[1], d[2]) / std::pow(d[1].norm(), 3.0);
  }
  elements[e] = second;
  elements.insert(elements.begin() + static_cast<std::ptrdiff_t>(e), first);
  states.insert(states.begin() + static_cast<std::ptrdiff_t>(e) + 1, middle);
  update();
}

bool TypicalPath::join(std::size_t e) {
  const double turn = elements[e].turn() + elements[e + 1].turn();
  const double ratio = elements[e].logRatio() + elements[e + 1].logRatio();
  if (!elements[e].typical || !elements[e + 1].typical || !(turn < kLargestElementTurn)) return false;
  elements[e].logTurn = std::log(turn);
  elements[e].setLogRatio(ratio);
  elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(e) + 1);
  states.erase(states.begin() + static_cast<std::ptrdiff_t>(e) + 1);
  return update();
}

bool TypicalPath::joinAsHermite(std::size_t e) {
  // Typical curves that turn more than a hint are what this path is made of.
  constexpr double kHint = 0.06;
  for (const std::size_t one : {e, e + 1}) {
    if (elements[one].typical && elements[one].turn() > kHint) return false;
  }
  double turn = 0.0;
  for (const std::size_t one : {e, e + 1}) turn += std::abs(states[one + 1].angleRad - states[one].angleRad);
  if (!(turn < kLargestHermiteTurn)) return false;
  elements[e] = {};
  elements[e].typical = false;
  elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(e) + 1);
  states.erase(states.begin() + static_cast<std::ptrdiff_t>(e) + 1);
  return update();
}

bool TypicalPath::makeTypical(std::size_t e) {
  const PathState &a = states[e], &b = states[e + 1];
  const double turn = std::remainder(b.angleRad - a.angleRad, 2.0 * std::numbers::pi);
  if (elements[e].typical || !(a.kappa * b.kappa > 0.0) || !(a.kappa * turn > 0.0)) return false;
  if (!(std::abs(turn) < kMostStartTurnRad) || !(std::abs(turn) > kLeastStartTurnRad)) return false;
  // The size of the stretch decides the mean curvature, as the curvatures at the ends are less certain.
  const double mean = std::abs(turn) / hermiteLength(e);
  const double ratio = std::clamp(0.25 * std::log(a.kappa / b.kappa), -kMostStartLogRatio, kMostStartLogRatio);
  PathElement element;
  element.side = a.kappa > 0.0 ? 1.0 : -1.0;
  element.logTurn = std::log(0.5 * std::abs(turn));
  element.shape = ratio;
  element.setTrend(ratio < 0.0 ? Trend::Rising : Trend::Falling);
  elements[e] = element;
  if (isFree(e)) states[e].kappa = element.side * mean * std::exp(2.0 * ratio);
  return update();
}

std::optional<std::size_t> firstSliver(const TypicalPath& path) {
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    if (!((path.states[e + 1].point - path.states[e].point).norm() > kShortestSegment)) return e;
  }
  return std::nullopt;
}

}  // namespace batten
