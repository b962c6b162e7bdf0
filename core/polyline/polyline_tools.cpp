// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/polyline_tools.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

std::vector<double> gaussianKernel(double sigma) {
  const int half = std::max(1, static_cast<int>(std::ceil(3.0 * sigma)));
  std::vector<double> kernel(half + 1);
  double sum = 0.0;
  for (int i = 0; i <= half; ++i) {
    kernel[i] = std::exp(-0.5 * (i / sigma) * (i / sigma));
    sum += (i == 0 ? 1.0 : 2.0) * kernel[i];
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

// Weighted moments of the positions, scaled to about 1 so that the normal equations stay well conditioned.
struct Moments {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> b = Eigen::Matrix<double, 3, 2>::Zero();
};

Moments momentsOf(std::span<const double> s, std::span<const Vec2> points, std::span<const double> weights,
                  double scale, const Vec2& origin) {
  Moments m;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double u = s[i] / scale;
    const double w = weights.empty() ? 1.0 : weights[i];
    const Eigen::Vector3d row(1.0, u, 0.5 * u * u);
    m.a += w * row * row.transpose();
    m.b += w * row * (points[i] - origin).transpose();
  }
  return m;
}

}  // namespace

double polylineLength(std::span<const Vec2> points, bool closed) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  if (closed && points.size() > 1) length += (points.front() - points.back()).norm();
  return length;
}

double polygonArea(std::span<const Vec2> points) {
  if (points.size() < 3) return 0.0;
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    twice += cross(points[i] - points[0], points[i + 1] - points[0]);
  }
  return 0.5 * std::abs(twice);
}

std::vector<double> cumulativeLength(std::span<const Vec2> points) {
  std::vector<double> s(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
  return s;
}

std::vector<Vec2> smoothPolyline(std::span<const Vec2> points, bool closed, double sigma) {
  std::vector<Vec2> out(points.begin(), points.end());
  const int n = static_cast<int>(points.size());
  if (n < 3 || sigma <= 0.0) return out;
  const std::vector<double> kernel = gaussianKernel(std::min(sigma, n / 6.0));
  const int half = static_cast<int>(kernel.size()) - 1;
  const auto at = [&](int i) -> Vec2 {
    if (closed) return points[wrapIndex(i, n)];
    if (i < 0) return 2.0 * points.front() - points[std::min(-i, n - 1)];
    if (i >= n) return 2.0 * points.back() - points[std::max(2 * (n - 1) - i, 0)];
    return points[i];
  };
  for (int i = 0; i < n; ++i) {
    const bool inside = i >= half && i + half < n;
    Vec2 sum = kernel[0] * points[i];
    const Vec2* here = points.data() + i;
    for (int k = 1; inside && k <= half; ++k) sum += kernel[k] * (here[-k] + here[k]);
    for (int k = 1; !inside && k <= half; ++k) sum += kernel[k] * (at(i - k) + at(i + k));
    out[i] = sum;
  }
  return out;
}

namespace {

BATTEN_HOT_LOOP void addTaps(const float* values, int k, double weight, double* __restrict sums, int count) {
  const float *before = values - k, *after = values + k;
  for (int i = 0; i < count; ++i) sums[i] += weight * (before[i] + after[i]);
}

}  // namespace

std::vector<float> smoothValues(std::span<const float> values, bool closed, double sigma) {
  std::vector<float> out(values.begin(), values.end());
  const int n = static_cast<int>(values.size());
  if (n < 3 || sigma <= 0.0) return out;
  const std::vector<double> kernel = gaussianKernel(std::min(sigma, n / 6.0));
  const int half = static_cast<int>(kernel.size()) - 1;
  const auto at = [&](int i) -> double {
    if (closed) return values[wrapIndex(i, n)];
    const int reflected = i < 0 ? -i : (i >= n ? 2 * (n - 1) - i : i);
    return values[std::clamp(reflected, 0, n - 1)];
  };
  // Tap by tap over all values, which is several times as fast as value by value and adds up in the same order.
  const int inner = std::max(0, n - 2 * half);
  std::vector<double> sums(values.begin(), values.end());
  for (double& sum : sums) sum *= kernel[0];
  for (int k = 1; k <= half && inner > 0; ++k) addTaps(values.data() + half, k, kernel[k], sums.data() + half, inner);
  for (int i = 0; i < n; ++i) {
    double& sum = sums[i];
    const bool inside = i >= half && i + half < n;
    for (int k = 1; !inside && k <= half; ++k) sum += kernel[k] * (at(i - k) + at(i + k));
    out[i] = static_cast<float>(sum);
  }
  return out;
}

Vec2 pointBetween(std::span<const Vec2> points, bool closed, double place) {
  const int n = static_cast<int>(points.size());
  const int k = std::clamp(static_cast<int>(std::floor(place)), 0, closed ? n - 1 : n - 2);
  const double t = std::clamp(place - k, 0.0, 1.0);
  const auto at = [&](int i) -> Vec2 {
    if (closed) return points[wrapIndex(i, n)];
    if (i < 0) return 2.0 * points[0] - points[1];
    if (i >= n) return 2.0 * points[points.size() - 1] - points[points.size() - 2];
    return points[i];
  };
  const Vec2 a = at(k - 1), b = at(k), c = at(k + 1), d = at(k + 2);
  return b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

std::vector<Vec2> directions(std::span<const Vec2> points, bool closed, int reach) {
  const int n = static_cast<int>(points.size());
  std::vector<Vec2> out(points.size(), Vec2::UnitX());
  Vec2 last = Vec2::UnitX();
  bool known = false;
  std::vector<int> unknown;
  for (int i = 0; i < n; ++i) {
    const int a = closed ? wrapIndex(i - reach, n) : std::max(0, i - reach);
    const int b = closed ? wrapIndex(i + reach, n) : std::min(n - 1, i + reach);
    const Vec2 d = points[b] - points[a];
    const double length = d.norm();
    if (length > 0.0) {
      last = d / length;
      if (!known) {
        for (const int j : unknown) out[j] = last;
      }
      known = true;
    } else if (!known) {
      unknown.push_back(i);
    }
    out[i] = last;
  }
  return out;
}

LocalQuadratic fitLocalQuadratic(std::span<const double> s, std::span<const Vec2> points,
                                 std::span<const double> weights, int maxOrder) {
  LocalQuadratic fit;
  if (s.empty()) return fit;
  double scale = 0.0;
  for (const double v : s) scale = std::max(scale, std::abs(v));
  if (!(scale > 0.0)) scale = 1.0;
  const Vec2& origin = points[points.size() / 2];
  const Moments m = momentsOf(s, points, weights, scale, origin);
  int order = std::clamp(std::min(maxOrder, static_cast<int>(s.size()) - 1), 0, 2);
  Eigen::Matrix<double, 3, 2> c = Eigen::Matrix<double, 3, 2>::Zero();
  for (; order >= 0; --order) {
    const int k = order + 1;
    const Eigen::MatrixXd a = m.a.topLeftCorner(k, k);
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(a);
    // The positions are scaled to -1..1, so that no diagonal entry is small by itself: a pivot this small against the
    // largest diagonal entry means that the positions do not determine the order.
    const Eigen::VectorXd pivots = ldlt.vectorD();
    if (ldlt.info() != Eigen::Success || pivots.minCoeff() <= 1e-10 * a.diagonal().maxCoeff()) continue;
    c.topRows(k) = ldlt.solve(m.b.topRows(k));
    break;
  }
  if (order < 0) {
    fit.r0 = origin;
    fit.order = 0;
    return fit;
  }
  fit.order = order;
  fit.r0 = origin + c.row(0).transpose();
  fit.r1 = c.row(1).transpose() / scale;
  fit.r2 = c.row(2).transpose() / (scale * scale);
  double sum = 0.0, weightSum = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    sum += w * (points[i] - fit.at(s[i])).squaredNorm();
    weightSum += w;
  }
  fit.residualRms = weightSum > 0.0 ? std::sqrt(sum / weightSum) : 0.0;
  return fit;
}

}  // namespace batten
