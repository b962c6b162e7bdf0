// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/corner_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/curve/curvature.h"

namespace batten {
namespace {

// What counts as a corner to be rounded: less is a line, more a hairpin whose vertex runs off.
constexpr double kLeastBlendTurn = 0.01, kMostBlendTurn = 3.0;
// places of a blend: in every trial, and once for its least radius
constexpr int kBlendSamples = 64, kRadiusSamples = 200;
/// Price of curvature that turns back, beside the height of its peak.
constexpr double kTurnsBackPrice = 20.0;
/// Lengths of the first derivative to begin with, in distances to where the tangents meet.
constexpr std::array kFirstSpeeds = {1.2, 1.8, 2.6};
/// A slower start than this, in the same unit, is a cusp: its curvature there has no limit.
constexpr double kLeastBlendSpeed = 0.05;
/// Steps of the search, in the same unit.
constexpr double kFirstStep = 0.4, kLastStep = 1e-3;
constexpr int kMostBlendRounds = 400;  // bounds a search that gains ever less

/// Derivatives of arc length with respect to the parameter, at both ends: the free lengths of a blend.
struct FreeLengths {
  std::array<double, 3> start{}, end{};
};

/// Derivatives 0 to 3 with respect to the parameter at an end.
std::array<Vec2, 4> derivativesOf(const BlendEnd& end, const std::array<double, 3>& length) {
  const auto [a, b, c] = length;
  const Vec2 t = end.tangent, n = leftNormal(t);
  return {end.point, a * t, b * t + a * a * end.kappa * n,
          (c - a * a * a * end.kappa * end.kappa) * t + (3.0 * a * b * end.kappa + a * a * a * end.kappaSlope) * n};
}

/// Control points from the derivatives at both ends: the first half from the start's, the second from the end's.
std::vector<Vec2> controlPointsOf(const BlendEnd& before, const BlendEnd& behind, const FreeLengths& free, int degree) {
  const int each = (degree + 1) / 2;
  std::vector<Vec2> points(degree + 1);
  for (const bool atEnd : {false, true}) {
    std::array<Vec2, 4> d = derivativesOf(atEnd ? behind : before, atEnd ? free.end : free.start);
    // Run through backwards, the odd derivatives change their sign.
    if (atEnd) d[1] = -d[1], d[3] = -d[3];
    // Forward differences at the end: D_k = d_k (n - k)! / n!.
    std::array<Vec2, 4> difference;
    double factor = 1.0;
    for (int k = 0; k < each; ++k) {
      difference[k] = factor * d[k];
      factor /= degree - k;
    }
    constexpr int kBinomial[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
    for (int i = 0; i < each; ++i) {
      Vec2 point = Vec2::Zero();
      for (int k = 0; k <= i; ++k) point += kBinomial[i][k] * difference[k];
      points[atEnd ? degree - i : i] = point;
    }
  }
  return points;
}

/// Curvature of a Bezier curve, by differences of its control points.
double bezierCurvature(const std::vector<Vec2>& points, double t) {
  std::array<Vec2, 8> b;
  std::copy(points.begin(), points.end(), b.begin());
  const int degree = static_cast<int>(points.size()) - 1;
  for (int left = degree; left > 2; --left)
    for (int i = 0; i < left; ++i) b[i] = (1.0 - t) * b[i] + t * b[i + 1];
  const Vec2 e0 = b[1] - b[0], e1 = b[2] - b[1];
  const Vec2 first = degree * ((1.0 - t) * e0 + t * e1), second = degree * (degree - 1.0) * (e1 - e0);
  const double speed = first.norm();
  return cross(first, second) / (speed * speed * speed);
}

/// How much a sequence falls before, and rises after, an entry.
double turnsBack(const std::vector<double>& values, std::size_t peak) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    sum += std::max(0.0, i < peak ? values[i] - values[i + 1] : values[i + 1] - values[i]);
  return sum;
}

class BlendSearch {
 public:
  BlendSearch(const BlendEnd& before, const BlendEnd& behind, BlendContact contact, double size, double side)
      : before_(before), behind_(behind), degree_(contact == BlendContact::G3 ? 7 : 5), size_(size), side_(side) {}

  std::vector<Vec2> run() const {
    std::vector<Vec2> best;
    double least = std::numeric_limits<double>::infinity();
    for (const double speed : kFirstSpeeds) {
      std::vector<double> x(degree_ == 7 ? 6 : 4, 0.0);
      x[0] = x[1] = speed;
      const double cost = improve(x);
      if (!(cost < least)) continue;
      least = cost;
      best = pointsOf(x);
    }
    return best;
  }

 private:
  std::vector<Vec2> pointsOf(const std::vector<double>& x) const {
    FreeLengths free;
    free.start = {x[0] * size_, x[2] * size_, x.size() > 4 ? x[4] * size_ : 0.0};
    // Seen from the end, the parameter runs the other way: the second derivative of the length keeps its sign there.
    free.end = {x[1] * size_, -x[3] * size_, x.size() > 4 ? x[5] * size_ : 0.0};
    return controlPointsOf(before_, behind_, free, degree_);
  }

  double cost(const std::vector<double>& x) const {
    if (!(x[0] > kLeastBlendSpeed && x[1] > kLeastBlendSpeed)) return std::numeric_limits<double>::infinity();
    const std::vector<Vec2> points = pointsOf(x);
    std::vector<double> bend;
    for (int i = 0; i <= kBlendSamples; ++i)
      bend.push_back(side_ * size_ * bezierCurvature(points, static_cast<double>(i) / kBlendSamples));
    if (!std::all_of(bend.begin(), bend.end(), [](double b) { return std::isfinite(b); }))
      return std::numeric_limits<double>::infinity();
    const auto [low, high] = std::minmax_element(bend.begin(), bend.end());
    const std::size_t peak = high - bend.begin();
    return std::max(*high, -*low) + kTurnsBackPrice * turnsBack(bend, peak);
  }

  /// Pattern search of Hooke and Jeeves without pattern moves: few unknowns, and a cost with kinks.
  double improve(std::vector<double>& x) const {
    double best = cost(x), step = kFirstStep;
    for (int round = 0; round < kMostBlendRounds && step > kLastStep; ++round) {
      bool better = false;
      for (std::size_t i = 0; i < x.size(); ++i) {
        for (const double change : {step, -step}) {
          std::vector<double> tried = x;
          tried[i] += change;
          // Both ends together, too: most corners are much alike on both sides.
          for (const bool both : {false, true}) {
            if (both) tried[i ^ 1U] += change;
            const double now = cost(tried);
            if (!(now < best)) continue;
            best = now;
            x = tried;
            better = true;
          }
        }
      }
      if (!better) step *= 0.5;
    }
    return best;
  }

  const BlendEnd &before_, &behind_;
  int degree_;
  double size_, side_;
};

}  // namespace

BlendEnd blendEndAt(const NurbsCurve& curve, double u) {
  const auto d = curve.derivatives(u, 3);
  const double v = d[1].norm(), turn = cross(d[1], d[2]);
  BlendEnd end;
  end.point = d[0];
  end.tangent = d[1] / v;
  end.kappa = turn / (v * v * v);
  end.kappaSlope = (cross(d[1], d[3]) - 3.0 * d[1].dot(d[2]) * turn / (v * v)) / (v * v * v * v);
  return end;
}

double smallestRadius(const NurbsCurve& curve) {
  double largest = 0.0;
  for (int i = 0; i <= kRadiusSamples; ++i) {
    const double u = curve.start() + (curve.end() - curve.start()) * i / kRadiusSamples;
    largest = std::max(largest, std::abs(curvature(curve, u).value_or(std::numeric_limits<double>::infinity())));
  }
  return 1.0 / largest;
}

std::optional<CornerBlend> blendCorner(const BlendEnd& before, const BlendEnd& behind, BlendContact contact) {
  const double turn = std::atan2(cross(before.tangent, behind.tangent), before.tangent.dot(behind.tangent));
  const double side = turn > 0.0 ? 1.0 : -1.0;
  if (!(std::abs(turn) > kLeastBlendTurn && std::abs(turn) < kMostBlendTurn)) return std::nullopt;
  const Vec2 chord = behind.point - before.point;
  const double sine = cross(before.tangent, behind.tangent);
  const double toVertex = cross(chord, behind.tangent) / sine, fromVertex = cross(before.tangent, chord) / sine;
  if (!(toVertex > 0.0) || !(fromVertex > 0.0)) return std::nullopt;
  std::vector<Vec2> points = BlendSearch(before, behind, contact, std::min(toVertex, fromVertex), side).run();
  if (points.empty()) return std::nullopt;
  std::vector<double> knots(points.size(), 0.0);
  knots.insert(knots.end(), points.size(), 1.0);
  const int degree = static_cast<int>(points.size()) - 1;
  auto curve = NurbsCurve::make(degree, std::move(knots), std::move(points));
  if (!curve) return std::nullopt;
  const double radius = smallestRadius(*curve);
  return CornerBlend{std::move(*curve), radius};
}

}  // namespace batten
