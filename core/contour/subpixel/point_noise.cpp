// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/point_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/statistics.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kNoiseReach = 24;                // points: the noise of a scan changes slowly
constexpr int kNoiseStep = 2;                  // neighbours share pixels
constexpr int kNoiseStride = 4;                // a median is taken at every fourth point
constexpr double kNoiseAlong = 6.0;            // points: the medians are smoothed by this
constexpr double kFreedomOfWeights = 1.5;      // effective degrees of freedom over the sum of the weights
constexpr double kModelErrorPx = 0.01;         // of the pixel model itself
constexpr double kLargestPointSigmaPx = 0.35;  // of one that was placed

using Information = std::vector<std::optional<PointInformation>>;

/// Where nothing is known it is as next to there; nothing where nothing is known at all.
std::optional<std::vector<float>> filled(const std::vector<std::optional<float>>& values) {
  const auto first = std::find_if(values.begin(), values.end(), [](const auto& v) { return v.has_value(); });
  if (first == values.end()) return std::nullopt;
  std::vector<float> all;
  float last = **first;
  all.reserve(values.size());
  for (const auto& v : values) all.push_back(last = v.value_or(last));
  return all;
}

/// [grey^2] Running median of the squares per freedom: what no model explains, as next to a corner, is no noise.
/// Nothing where no point is known at all.
std::optional<std::vector<float>> noiseAlong(const Information& points, bool closed) {
  const int n = static_cast<int>(points.size());
  std::vector<std::optional<float>> variance(points.size());
  std::vector<double> ratios;
  for (int i = 0; i < n; i += kNoiseStride) {
    ratios.clear();
    double freedom = 0.0;
    for (int k = i - kNoiseReach; k <= i + kNoiseReach; k += kNoiseStep) {
      if (!closed && (k < 0 || k >= n)) continue;
      const auto& point = points[wrapIndex(k, n)];
      if (!point || !(point->freedom > 0.0)) continue;
      ratios.push_back(point->squares / point->freedom);
      freedom += point->freedom;
    }
    if (ratios.empty()) continue;
    const auto count = static_cast<double>(ratios.size());
    const auto middle = upperMedian(ratios);
    // Of a chi2 the median is (1 - 2 / (9 f))^3 of the mean (Wilson and Hilferty); weights that fall off along the
    // edge make half as many degrees of freedom again.
    const double share = 1.0 - 2.0 / (9.0 * kFreedomOfWeights * std::max(1.0, freedom / count));
    const auto median = static_cast<float>(middle / (share * share * share));
    for (int k = i; k < std::min(n, i + kNoiseStride); ++k) variance[k] = median;
  }
  const auto all = filled(variance);
  if (!all) return std::nullopt;
  return smoothValues(*all, closed, kNoiseAlong);
}

}  // namespace

std::vector<float> pointSigmas(const Information& points, bool closed) {
  std::vector<float> sigma(points.size(), kGuessedSigmaPx);
  const auto variance = noiseAlong(points, closed);
  if (!variance) return sigma;
  for (int i = 0; i < std::ssize(points); ++i) {
    if (!points[i]) continue;
    const double noise = std::sqrt((*variance)[i]);
    sigma[i] = static_cast<float>(std::min(std::hypot(points[i]->gain * noise, kModelErrorPx), kLargestPointSigmaPx));
  }
  return sigma;
}

}  // namespace batten
