// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/point_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/statistics.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kNoiseReach = 24;                // points: the noise of a scan changes slowly
constexpr int kNoiseStep = 2;                  // neighbours share pixels
constexpr int kNoiseStride = 4;                // a median is taken at every fourth point
constexpr double kNoiseAlong = 6.0;            // points: the medians are smoothed by this
constexpr double kModelErrorPx = 0.01;         // of the pixel model itself
constexpr float kGuessedSigmaPx = 0.35f;       // of a point that is known to the pixel only
constexpr double kLargestPointSigmaPx = 0.35;  // of one that was placed

/// Where nothing is known it is as next to there.
void fillUnknown(std::vector<float>& values) {
  const auto isKnown = [](float v) { return v >= 0.0f; };
  const auto first = std::find_if(values.begin(), values.end(), isKnown);
  float last = first == values.end() ? -1.0f : *first;
  for (float& v : values) {
    if (isKnown(v)) last = v;
    v = last;
  }
}

/// [grey^2] Running median of the squares per freedom: what no model explains, as next to a corner, is no noise. -1
/// where no point is known at all.
std::vector<float> noiseAlong(const std::vector<PointInformation>& points, const std::vector<std::uint8_t>& known,
                              bool closed) {
  const int n = static_cast<int>(points.size());
  std::vector<float> variance(points.size(), 0.0f);
  std::vector<double> ratios;
  for (int i = 0; i < n; i += kNoiseStride) {
    ratios.clear();
    double freedom = 0.0;
    for (int k = i - kNoiseReach; k <= i + kNoiseReach; k += kNoiseStep) {
      if (!closed && (k < 0 || k >= n)) continue;
      const auto at = static_cast<std::size_t>(wrapIndex(k, n));
      if (!known[at]) continue;
      ratios.push_back(points[at].squares / points[at].freedom);
      freedom += points[at].freedom;
    }
    float median = -1.0f;
    if (!ratios.empty()) {
      const auto count = static_cast<double>(ratios.size());
      const auto middle = upperMedian(ratios);
      // Of a chi2 the median is (1 - 2 / (9 f))^3 of the mean (Wilson and Hilferty); weights that fall off along the
      // edge make half as many degrees of freedom again.
      const double share = 1.0 - 2.0 / (9.0 * 1.5 * std::max(1.0, freedom / count));
      median = static_cast<float>(middle / (share * share * share));
    }
    for (int k = i; k < std::min(n, i + kNoiseStride); ++k) variance[k] = median;
  }
  fillUnknown(variance);
  return smoothValues(variance, closed, kNoiseAlong);
}

}  // namespace

std::vector<float> pointSigmas(const std::vector<PointInformation>& points, const std::vector<std::uint8_t>& placed,
                               bool closed) {
  const auto n = points.size();
  std::vector<std::uint8_t> known(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    known[i] = placed[i] && points[i].gain > 0.0 && points[i].freedom > 0.0 ? 1 : 0;
  }
  const std::vector<float> variance = noiseAlong(points, known, closed);
  std::vector<float> sigma(n, kGuessedSigmaPx);
  for (std::size_t i = 0; i < n; ++i) {
    if (!placed[i] || !(points[i].gain > 0.0) || variance[i] < 0.0f) continue;
    const double noise = std::sqrt(variance[i]);
    sigma[i] = static_cast<float>(std::min(std::hypot(points[i].gain * noise, kModelErrorPx), kLargestPointSigmaPx));
  }
  return sigma;
}

}  // namespace batten
