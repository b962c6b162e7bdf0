// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_simple.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "core/curve/bernstein.h"
#include "core/curve/bezier_quintics.h"
#include "core/polyline/circle_fit.h"
#include "core/solve/dense_solve.h"

namespace batten {
namespace {

// length of a piece that shows no bend, and one that shows no change of it
constexpr double kStraightBelowPx = 12.0, kQuadraticBelowPx = 25.0;
constexpr int kFewestCurved = 4, kFewestCubic = 8;  // points: fewer show no bend, no change of it
constexpr int kHighestDegree = 5;
constexpr double kPointsPerDegree = 3.0;   // at least: fewer would be led through their noise
constexpr int kMissPoints = 3;             // over which a miss is a mean: a few px of line, as noise is short
constexpr double kMuchNearer = 0.7;        // of the miss before: less is not worth a degree
constexpr double kSolved = 1e-6;           // of the right side: a solution that misses it by more is none
constexpr int kCircleRounds = 8;           // of Gauss and Newton, from a good start
constexpr double kCircleSettled = 1e-10;   // of the radius: a smaller step changes nothing
constexpr double kLoopCutoffShare = 0.25;  // of the length of a small closed line: shorter waves are noise
constexpr double kLoopSpacingPx = 16.0;    // of its knots
constexpr double kPinWeight = 1e8;         // of an exact end, in weights of a point; openCurve() sets the last digits

/// A piece of 2 to 6 Bezier points.
Result<NurbsCurve> bezier(const std::vector<Vec2>& points, double length) {
  const Quintic quintic = elevatedToQuintic(points);
  std::vector<double> knots(6, 0.0);
  knots.insert(knots.end(), 6, length);
  return NurbsCurve::make(5, std::move(knots), {quintic.begin(), quintic.end()});
}

// A polynomial through points, by its Bezier points.
struct OpenFit {
  std::vector<Vec2> points;  ///< [px]
  bool isSound = false;      ///< The system had a solution.
};

// Least squares over parameters t in 0..length. A straight piece of few points joins its ends; otherwise only corners
// are exact.
OpenFit fitPolynomial(const FairData& data, const FairPins& pins, const std::vector<double>& t, int degree,
                      bool isFew) {
  const double length = t.back();
  const int n = degree + 1;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n), right = Eigen::MatrixXd::Zero(n, 2);
  const auto add = [&](double u, const Vec2& p, double w) {
    const auto values = bernsteinPolynomials(degree, u);
    const Eigen::Map<const Eigen::VectorXd> b(values.data(), n);
    normal += w * b * b.transpose();
    right += w * b * p.transpose();
  };
  for (int i = 0; i < std::ssize(data.points); ++i) {
    if (data.points[i].use) add(t[i] / length, data.points[i].at, 1.0);
  }
  const Vec2 first = pins.start.value_or(data.points.front().at), last = pins.end.value_or(data.points.back().at);
  if (pins.start || isFew) add(0.0, first, kPinWeight);
  if (pins.end || isFew) add(1.0, last, kPinWeight);
  const Eigen::MatrixXd solution = solveSymmetric(normal, right);
  OpenFit fit;
  for (int i = 0; i < n; ++i) fit.points.emplace_back(solution(i, 0), solution(i, 1));
  fit.isSound = solution.allFinite() && (normal * solution - right).norm() <= kSolved * (1.0 + right.norm());
  if (pins.start) fit.points.front() = first;
  if (pins.end) fit.points.back() = last;
  return fit;
}

// [px] Largest distance of the points from the curve at their parameters, in the mean of a few neighbours: what is not
// their noise.
double missOf(const FairData& data, const std::vector<double>& t, const std::vector<Vec2>& points) {
  std::vector<Vec2> off;
  for (int i = 0; i < std::ssize(data.points); ++i) {
    if (!data.points[i].use) continue;
    const auto values = bernsteinPolynomials(static_cast<int>(points.size()) - 1, t[i] / t.back());
    Vec2 on = Vec2::Zero();
    for (std::size_t k = 0; k < points.size(); ++k) on += values[k] * points[k];
    off.push_back(data.points[i].at - on);
  }
  const int count = static_cast<int>(off.size()), taken = std::min(kMissPoints, count);
  double most = 0.0;
  for (int i = 0; i + taken <= count && taken > 0; ++i) {
    Vec2 sum = Vec2::Zero();
    for (int k = 0; k < taken; ++k) sum += off[i + k];
    most = std::max(most, sum.norm() / taken);
  }
  return most;
}

Result<NurbsCurve> openCurve(const FairData& data, const FairPins& pins, const std::vector<double>& t,
                             double tolerancePx) {
  const double length = t.back();
  const int used = static_cast<int>(std::ranges::count(data.points, true, &FairPoint::use));
  const bool isFew = used < kFewestCurved, isStraight = length < kStraightBelowPx || isFew;
  int degree = isStraight ? 1 : length < kQuadraticBelowPx || used < kFewestCubic ? 2 : 3;
  OpenFit fit = fitPolynomial(data, pins, t, degree, isFew);
  // A small letter turns as much as a large one: what a low degree misses by more than noise asks for a higher one.
  const int highest = isFew ? 1 : std::min(kHighestDegree, static_cast<int>(used / kPointsPerDegree));
  double miss = fit.isSound ? missOf(data, t, fit.points) : std::numeric_limits<double>::infinity();
  while (miss > tolerancePx && degree < highest) {
    OpenFit higher = fitPolynomial(data, pins, t, ++degree, isFew);
    const double missed = higher.isSound ? missOf(data, t, higher.points) : std::numeric_limits<double>::infinity();
    if (!(missed < kMuchNearer * miss)) continue;
    fit = std::move(higher);
    miss = missed;
  }
  if (!fit.isSound)
    fit.points = {pins.start.value_or(data.points.front().at), pins.end.value_or(data.points.back().at)};
  return bezier(fit.points, length);
}

}  // namespace

std::vector<WeightedPoint> blockMeans(const FairFrame& frame) {
  std::vector<WeightedPoint> means;
  for (const FairBlock& block : frame.blocks) {
    const PlaneDerivatives d = frame.base.at(block.u, 1);
    means.push_back({d[0] + block.offset * leftNormal(d[1]).normalized(), frame.blockLength * block.weight});
  }
  return means;
}

std::optional<CircleFit> fitCircle(std::span<const WeightedPoint> data) {
  std::vector<Vec2> points;
  std::vector<double> weights;
  for (const WeightedPoint& p : data) {
    points.push_back(p.at);
    weights.push_back(p.weight);
  }
  // A good start, since the points surround the centre.
  const auto start = algebraicCircle(points, weights);
  if (!start) return std::nullopt;
  CircleFit fit{start->centre, start->radius, 0.0};
  Eigen::Matrix3d normal;
  Eigen::Vector3d right;
  for (int round = 0; round < kCircleRounds; ++round) {
    normal.setZero();
    right.setZero();
    fit.squares = 0.0;
    for (const auto& [at, weight] : data) {
      const Vec2 d = at - fit.centre;
      const double distance = d.norm();
      if (!(distance > 0.0)) return std::nullopt;
      const Eigen::Vector3d row(d.x() / distance, d.y() / distance, 1.0);
      const double e = distance - fit.radius;
      normal += weight * row * row.transpose();
      right += weight * row * e;
      fit.squares += weight * e * e;
    }
    const Eigen::Vector3d step = normal.fullPivLu().solve(right);
    if (!step.allFinite()) return std::nullopt;
    fit.centre += step.head<2>();
    fit.radius += step[2];
    if (step.norm() < kCircleSettled * std::abs(fit.radius)) break;
  }
  if (!(fit.radius > 0.0) || !std::isfinite(fit.squares) || !fit.centre.allFinite()) return std::nullopt;
  return fit;
}

UniformQuintic circleCurve(const CircleFit& circle, const Vec2& first, bool left) {
  const double length = 2.0 * std::numbers::pi * circle.radius;
  constexpr int spans = 24;  // already far finer than any scan
  const double turn = 2.0 * std::numbers::pi / spans;
  const double radius = circle.radius * 120.0 / (66.0 + 52.0 * std::cos(turn) + 2.0 * std::cos(2.0 * turn));
  const Vec2 out = first - circle.centre;
  const double start = std::atan2(out.y(), out.x());
  std::vector<Vec2> coefficients;
  for (int i = 0; i < spans; ++i) {
    const double angle = start + (left ? 1.0 : -1.0) * turn * (i - 2);  // the third of six is centred at the first knot
    coefficients.push_back(circle.centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return UniformQuintic({length, spans, true}, std::move(coefficients));
}

std::optional<LineFit> fitLine(std::span<const WeightedPoint> data) {
  LineFit fit;
  double total = 0.0;
  for (const auto& [at, weight] : data) {
    fit.point += weight * at;
    total += weight;
  }
  if (!(total > 0.0)) return std::nullopt;
  fit.point /= total;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& [at, weight] : data) {
    const Vec2 p = at - fit.point;
    spread += weight * p * p.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(spread);
  if (!(eigen.eigenvalues()[1] > 0.0)) return std::nullopt;
  fit.direction = eigen.eigenvectors().col(1);
  for (const auto& [at, weight] : data) {
    const double e = cross(fit.direction, at - fit.point);
    fit.squares += weight * e * e;
  }
  return fit;
}

Result<NurbsCurve> lineCurve(const LineFit& line, const Vec2& first, const Vec2& last, const FairPins& pins) {
  const auto onLine = [&](const Vec2& p, const Vec2& through) -> Vec2 {
    return through + (p - through).dot(line.direction) * line.direction;
  };
  const Vec2 a = pins.start ? *pins.start : onLine(first, pins.end.value_or(line.point));
  const Vec2 b = pins.end ? *pins.end : onLine(last, pins.start.value_or(line.point));
  return bezier({a, b}, (b - a).norm());
}

Result<NurbsCurve> simpleCurve(const FairData& data, const FairPins& pins, double tolerancePx) {
  const auto nothing = [] {
    return fail(ErrorCode::Numerical, "A line is too short for a curve; drop short lines or specks.");
  };
  if (data.points.size() < 2) return nothing();
  std::vector<double> t, weights;
  std::vector<Vec2> points;
  for (const FairPoint& p : data.points) {
    t.push_back(points.empty() ? 0.0 : t.back() + (p.at - points.back()).norm());
    points.push_back(p.at);
    weights.push_back(p.use ? 1.0 : 0.0);
  }
  if (!(t.back() > 0.0) || !std::isfinite(t.back())) return nothing();
  if (!data.closed) return openCurve(data, pins, t, tolerancePx);
  const double length = t.back() + (points.front() - points.back()).norm();
  const double lambda = cutoffPenalty(data.density, kLoopCutoffShare * length);
  const auto loop = fitUniformQuintic(fairKnots(length, kLoopSpacingPx, true), t, points, weights, lambda);
  if (!loop) return nothing();
  return loop->toNurbs();
}

}  // namespace batten
