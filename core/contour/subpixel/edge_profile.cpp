// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/edge_profile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/contour/subpixel/cubic_weights.h"
#include "core/contour/subpixel/profile_samples.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kAverageReach = 3.0;  // standard deviations: beyond, the weights are below 1 %
constexpr int kSamplingGrain = 1024;   // points per block: about a millisecond
// The part of the contrast by which the grey must turn back before another edge is believed in. Grain and noise of the
// averaged profile stay well below it on anything that is a line at all.
constexpr double kTurnBack = 0.2;
constexpr int kSearchSamples = 4;            // to either side of the chain, 2 px: the mask is no farther off
constexpr double kFartherWorse = 0.15;       // [1/px] of the steepness: a nearer edge wins over a slightly steeper one
constexpr double kFarthestCrossingPx = 1.5;  // of the half level from where the grey falls steepest
constexpr int kDirectionReach = 3;           // points to either side

// Position of an extremum between samples by the parabola through three of them.
double parabolicOffset(double left, double mid, double right) {
  const double bend = left - 2.0 * mid + right;
  if (!(std::abs(bend) > 0.0)) return 0.0;
  return std::clamp(0.5 * (left - right) / bend, -0.5, 0.5);
}

// How far the grey keeps its trend.
struct Trend {
  int last = 0;         // the sample where it is most extreme, before it turns back
  bool turned = false;  // or else the last sample there is
};

// Walks from sample `from` in direction `step` while the grey keeps its trend (`sign` = -1 falling, +1 rising).
Trend followTrend(const float* p, int from, int step, double sign, double turnBack) {
  int best = from;
  for (int k = from; k >= 0 && k < kProfileSamples; k += step) {
    if (sign * p[k] > sign * p[best]) best = k;
    if (sign * (p[best] - p[k]) > turnBack) return {best, true};
  }
  return {step > 0 ? kProfileSamples - 1 : 0, false};
}

}  // namespace

double sampleCubic(const GreyImage& grey, const Vec2& at) {
  const double x = at.x() - 0.5, y = at.y() - 0.5;
  const double fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const CubicWeights across = cubicWeights(x - fx), down = cubicWeights(y - fy);
  const double wx[] = {across.before, across.here, across.next, across.after};
  const double wy[] = {down.before, down.here, down.next, down.after};
  double sum = 0.0;
  if (ix >= 1 && iy >= 1 && ix + 2 < grey.width && iy + 2 < grey.height) {
    for (int j = 0; j < 4; ++j) {
      const std::uint16_t* p = grey.row(iy - 1 + j) + ix - 1;
      sum += wy[j] * (wx[0] * p[0] + wx[1] * p[1] + wx[2] * p[2] + wx[3] * p[3]);
    }
  } else {
    for (int j = 0; j < 4; ++j) {
      const std::uint16_t* p = grey.row(std::clamp(iy - 1 + j, 0, grey.height - 1));
      for (int i = 0; i < 4; ++i) sum += wy[j] * wx[i] * p[std::clamp(ix - 1 + i, 0, grey.width - 1)];
    }
  }
  return sum / GreyImage::kGreyUnit;
}

double sampleLinear(const GreyImage& grey, const Vec2& at) {
  const double x = std::clamp(at.x() - 0.5, 0.0, grey.width - 1.0);
  const double y = std::clamp(at.y() - 0.5, 0.0, grey.height - 1.0);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const int jx = std::min(ix + 1, grey.width - 1), jy = std::min(iy + 1, grey.height - 1);
  const double fx = x - ix, fy = y - iy;
  const std::uint16_t* a = grey.row(iy);
  const std::uint16_t* b = grey.row(jy);
  return ((1 - fy) * ((1 - fx) * a[ix] + fx * a[jx]) + fy * ((1 - fx) * b[ix] + fx * b[jx])) / GreyImage::kGreyUnit;
}

EdgeProfiles sampleProfiles(const GreyImage& grey, std::span<const Vec2> base, std::span<const Vec2> normal, bool cubic,
                            const RunContext& context) {
  EdgeProfiles profiles;
  profiles.grey.resize(base.size() * kProfileSamples);
  parallelFor(context, static_cast<int>(base.size()), kSamplingGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) sampleProfile(grey, base[i], normal[i], cubic, profiles.row(i));
  });
  return profiles;
}

EdgeProfiles averageAlong(const EdgeProfiles& profiles, bool closed, double sigma, const RunContext& context) {
  EdgeProfiles out;
  out.grey.resize(profiles.grey.size());
  const int n = profiles.count();
  const int half = std::max(1, static_cast<int>(std::ceil(kAverageReach * sigma)));
  std::vector<float> weight(2 * half + 1);
  for (int d = -half; d <= half; ++d) {
    weight[d + half] = static_cast<float>(std::exp(-0.5 * (d / sigma) * (d / sigma)));
  }
  parallelFor(context, n, kSamplingGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      float sum[kProfileSamples] = {};
      float total = 0.0f;
      for (int d = -half; d <= half; ++d) {
        const int j = closed ? wrapIndex(i + d, n) : i + d;
        if (j < 0 || j >= n) continue;
        const float w = weight[d + half];
        const float* row = profiles.row(j);
        for (int k = 0; k < kProfileSamples; ++k) sum[k] += w * row[k];
        total += w;
      }
      float* target = out.row(i);
      for (int k = 0; k < kProfileSamples; ++k) target[k] = sum[k] / total;
    }
  });
  return out;
}

std::vector<EdgeRise> edgeRises(std::span<const Vec2> chain, bool closed, const GreyImage& grey,
                                std::array<double, 2> reachPx, double sigma, const RunContext& context) {
  constexpr double kStairSigma = 4.0;  // points: the staircase of the cracks
  const std::vector<Vec2> base = smoothPolyline(chain, closed, kStairSigma);
  const std::vector<Vec2> along = directions(base, closed, kDirectionReach);
  std::vector<float> inner(base.size()), outer(base.size());
  parallelFor(context, static_cast<int>(base.size()), kSamplingGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Vec2 inward = leftNormal(along[i]);  // with y down: ink lies to the right of travel
      const auto rise = [&](double u) {
        return static_cast<float>(sampleLinear(grey, base[i] - u * inward) - sampleLinear(grey, base[i] + u * inward));
      };
      inner[i] = rise(reachPx[0]);
      outer[i] = rise(reachPx[1]);
    }
  });
  inner = smoothValues(inner, closed, sigma);
  outer = smoothValues(outer, closed, sigma);
  std::vector<EdgeRise> rises(base.size());
  for (int i = 0; i < std::ssize(rises); ++i) rises[i] = {inner[i], outer[i]};
  return rises;
}

EdgeSpan findEdgeSpan(const float* p) {
  EdgeSpan span;
  const auto [low, high] = std::minmax_element(p, p + kProfileSamples);
  // The steepest fall within 2 px of the chain; nearer ones win over slightly steeper ones.
  int centre = kProfileHalf;
  double steepest = 0.0;
  for (int k = kProfileHalf - kSearchSamples; k <= kProfileHalf + kSearchSamples; ++k) {
    const double fall = (p[k - 1] - p[k + 1]) * (1.0 - kFartherWorse * std::abs(profileU(k)));
    if (fall > steepest) {
      steepest = fall;
      centre = k;
    }
  }
  span.centre = profileU(centre);
  if (!(steepest > 0.0)) return span;
  const double turnBack = kTurnBack * (*high - *low);
  const auto [hi, inkTurned] = followTrend(p, centre, 1, -1.0, turnBack);
  const auto [lo, paperTurned] = followTrend(p, centre, -1, 1.0, turnBack);
  span.lo = profileU(lo);
  span.hi = profileU(hi);
  // A border seen twice lies as far beyond the middle as this edge lies before it.
  if (inkTurned && hi > 0 && hi < kProfileSamples - 1) {
    span.hi = profileU(hi) + kProfileStepPx * parabolicOffset(p[hi - 1], p[hi], p[hi + 1]);
    if (span.hi > span.centre) span.inkTwin = 2.0 * (span.hi - span.centre);
  }
  if (paperTurned && lo > 0 && lo < kProfileSamples - 1) {
    span.lo = profileU(lo) + kProfileStepPx * parabolicOffset(p[lo - 1], p[lo], p[lo + 1]);
    if (span.lo < span.centre) span.paperTwin = 2.0 * (span.centre - span.lo);
  }
  float inkLevel = p[centre], paperLevel = p[centre];
  for (int k = lo; k <= hi; ++k) {
    inkLevel = std::min(inkLevel, p[k]);
    paperLevel = std::max(paperLevel, p[k]);
  }
  span.contrast = paperLevel - inkLevel;
  return span;
}

double halfLevelCrossing(const float* p, const EdgeSpan& span) {
  double inkSum = 0.0, paperSum = 0.0;
  int inkCount = 0, paperCount = 0;
  const double inkFrom = span.centre + std::min(kSideFromPx, kSideShare * (span.hi - span.centre));
  const double paperTo = span.centre - std::min(kSideFromPx, kSideShare * (span.centre - span.lo));
  for (int k = 0; k < kProfileSamples; ++k) {
    const double u = profileU(k);
    if (u >= inkFrom && u <= span.hi + kHalfStepPx) {
      inkSum += p[k];
      ++inkCount;
    } else if (u <= paperTo && u >= span.lo - kHalfStepPx) {
      paperSum += p[k];
      ++paperCount;
    }
  }
  if (inkCount == 0 || paperCount == 0) return span.centre;
  const double half = 0.5 * (inkSum / inkCount + paperSum / paperCount);
  double best = span.centre;
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k + 1 < kProfileSamples; ++k) {
    if (!(p[k] >= half && p[k + 1] < half)) continue;
    const double u = profileU(k) + kProfileStepPx * (p[k] - half) / (p[k] - p[k + 1]);
    if (std::abs(u - span.centre) < distance) {
      distance = std::abs(u - span.centre);
      best = u;
    }
  }
  return distance <= kFarthestCrossingPx ? best : span.centre;
}

const NormalTable& NormalTable::instance() {
  static const NormalTable table;
  return table;
}

NormalTable::NormalTable() {
  for (int i = 0; i < std::ssize(cdf_); ++i) {
    const double x = static_cast<double>(i) / kPerUnit - kRange;
    cdf_[i] = static_cast<float>(0.5 * std::erfc(-x / std::numbers::sqrt2));
    pdf_[i] = static_cast<float>(std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi));
  }
}

}  // namespace batten
