// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/soft_edges.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/contour/outline/edge_fade.h"
#include "core/contour/outline/subpixel_edges.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSoftBlurPx = 1.4;    // a profile of 4 px to each side says too little of the blur, and less in noise
constexpr double kLeastBlurPx = 1.1;   // on a smaller copy; below, the larger one shows the edge as well
constexpr int kLargestScale = 8;       // an edge over some 60 px is none
constexpr int kFewestPoints = 40;      // on a smaller copy
constexpr double kLeastRefined = 0.8;  // of what was placed before, else the smaller copy shows no edge there
constexpr double kCrackSigma = 1.0;    // points of the smaller copy: the staircase of the cracks
constexpr int kSmallestPage = 64;      // px
constexpr double kBeforeSeam = 1e-9;   // points: just before a closed line comes round

/// Means of 2 x 2 pixels.
GreyImage halved(const GreyImage& grey, const RunContext& context) {
  GreyImage half(grey.width / 2, grey.height / 2);
  parallelFor(context, half.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint16_t *a = grey.row(2 * y), *b = grey.row(2 * y + 1);
      std::uint16_t* to = half.row(y);
      for (int x = 0; x < half.width; ++x) {
        const unsigned sum = 2u + a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1];
        to[x] = static_cast<std::uint16_t>(sum / 4u);
      }
    }
  });
  return half;
}

/// An outline in the pixels of a smaller copy: about a point a pixel there.
Contour shrunk(const Contour& contour, int scale) {
  Contour small;
  small.kind = contour.kind;
  small.closed = contour.closed;
  small.hole = contour.hole;
  const std::vector<Vec2> smooth =
      smoothPolyline(unrefinedPositionsOf(contour.points), contour.closed, kCrackSigma * scale);
  const int n = static_cast<int>(smooth.size()), count = std::max(2, n / scale);
  const double step =
      contour.closed ? static_cast<double>(n) / count : static_cast<double>(n - 1) / static_cast<double>(count - 1);
  for (int k = 0; k < count; ++k) {
    const double at = std::min(k * step, static_cast<double>(n - 1));
    const int i = static_cast<int>(at);
    const int next = contour.closed ? (i + 1) % n : std::min(i + 1, n - 1);
    const double f = at - i;
    const Vec2 place = ((1.0 - f) * smooth[i] + f * smooth[next]) / scale;
    small.points.push_back({.at = place, .unrefined = place});
  }
  return small;
}

/// 0..1 per point: where the grey goes on changing beyond 3 px to each side of the line, so that the scan itself shows
/// too little of the edge. Outlines are soft in parts: a tone against a mask is sharp there and fades elsewhere.
std::vector<float> softness(const Contour& contour, const GreyImage& grey, double blurPx, const RunContext& context) {
  constexpr double kInnerPx = 3.0, kOuterBlurs = 2.5;  // to either side: what a scan shows, and a soft edge covers
  constexpr double kLeastShare = 0.9;                  // of the outer rise: a sharp edge has as much within the inner
  constexpr double kMeasureSigma = 8.0, kBlendSigma = 4.0;  // points: noise along the line; of soft and sharp
  const double reach = std::max(2.0 * kInnerPx, kOuterBlurs * blurPx);
  const std::vector<EdgeRise> rises =
      edgeRises(unrefinedPositionsOf(contour.points), contour.closed, grey, {kInnerPx, reach}, kMeasureSigma, context);
  std::vector<float> soft;
  soft.reserve(rises.size());
  for (const EdgeRise& rise : rises)
    soft.push_back(rise.inner < static_cast<float>(kLeastShare) * rise.outer ? 1.0f : 0.0f);
  return smoothValues(soft, contour.closed, kBlendSigma);
}

/// Takes what was found on a copy that is `scale` times smaller, where the edge is soft and was found there.
void enlarge(Contour& contour, const Contour& small, int scale, const std::vector<float>& soft) {
  const int n = static_cast<int>(contour.points.size()), m = static_cast<int>(small.points.size());
  const std::vector<Vec2> smallAt = positionsOf(small.points);
  const double step =
      contour.closed ? static_cast<double>(m) / n : static_cast<double>(m - 1) / static_cast<double>(n - 1);
  for (int i = 0; i < n; ++i) {
    const double at = std::min(i * step, static_cast<double>(m) - (contour.closed ? kBeforeSeam : 1.0));
    const int k = static_cast<int>(at);
    const int next = contour.closed ? (k + 1) % m : std::min(k + 1, m - 1);
    const double f = at - k;
    const ContourPoint &before = small.points[k], &after = small.points[next];
    ContourPoint& p = contour.points[i];
    if (!before.refined || !after.refined || !before.sigmaPx || !after.sigmaPx || !p.sigmaPx) continue;
    const double share = static_cast<double>(soft[i]);
    const Vec2 found = scale * pointBetween(smallAt, contour.closed, at);
    const double sigma =
        scale * std::lerp(static_cast<double>(*before.sigmaPx), static_cast<double>(*after.sigmaPx), f);
    p.at += share * (found - p.at);
    p.sigmaPx = static_cast<float>(std::lerp(static_cast<double>(*p.sigmaPx), sigma, share));
    if (share > 0.5) p.refined = true;
  }
  for (const auto& [first, last] : contour.bridges) {
    for (int i = first; i <= last; ++i) {
      contour.points[i].at = contour.points[i].unrefined;
      contour.points[i].refined = false;
    }
  }
  contour.blurPx = scale * small.blurPx.value_or(0.0);
  measureContour(contour);
}

double refinedShare(const Contour& c) {
  const auto refined = std::count_if(c.points.begin(), c.points.end(), [](const ContourPoint& p) { return p.refined; });
  return static_cast<double>(refined) / static_cast<double>(c.points.size());
}

/// Takes what this copy shows, if it shows an edge; true where a smaller one might show it better.
bool refineOn(Contour& contour, const GreyImage& scan, const GreyImage& grey, int scale, const RunContext& context) {
  if (std::ssize(contour.points) < kFewestPoints * scale) return false;
  Contour small = shrunk(contour, scale);
  refineOutline(small, grey, context);
  if (context.isCancelled() || !small.points.front().sigmaPx) return false;
  if (!small.blurPx || *small.blurPx < kLeastBlurPx) return false;
  if (refinedShare(small) < kLeastRefined * refinedShare(contour)) return false;
  undoFade(small, grey, context);
  const std::vector<float> soft = softness(contour, scan, scale * *small.blurPx, context);
  if (context.isCancelled()) return false;
  enlarge(contour, small, scale, soft);
  return *small.blurPx >= kSoftBlurPx;
}

/// Cheap against placing it once more: most scans are a little blurred, few are soft.
bool isSoftSomewhere(const Contour& contour, const GreyImage& grey, const RunContext& context) {
  if (!contour.blurPx || *contour.blurPx < kSoftBlurPx || contour.points.empty() || !contour.points.front().sigmaPx)
    return false;
  const std::vector<float> soft = softness(contour, grey, *contour.blurPx, context);
  return std::count_if(soft.begin(), soft.end(), [](float s) { return s > 0.5f; }) >= kFewestPoints;
}

}  // namespace

void refineSoftOutlines(ContourSet& set, const GreyImage& grey, const RunContext& context) {
  std::vector<Contour*> soft;
  for (Contour& contour : set.contours) {
    if (contour.kind == ContourKind::Outline && isSoftSomewhere(contour, grey, context)) soft.push_back(&contour);
  }
  GreyImage copy;
  for (int scale = 2; scale <= kLargestScale && !soft.empty(); scale *= 2) {
    const GreyImage& from = scale == 2 ? grey : copy;
    if (std::min(from.width, from.height) < 2 * kSmallestPage) return;
    copy = halved(from, context);
    std::vector<std::uint8_t> isSoft(soft.size(), 0);
    RunContext alone = context;
    alone.threads = 1;
    parallelFor(context, static_cast<int>(soft.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end && !context.isCancelled(); ++i) {
        isSoft[i] = refineOn(*soft[i], grey, copy, scale, alone) ? 1 : 0;
      }
    });
    if (context.isCancelled()) return;
    std::vector<Contour*> next;
    for (int i = 0; i < std::ssize(soft); ++i)
      if (isSoft[i]) next.push_back(soft[i]);
    soft = std::move(next);
  }
}

}  // namespace batten
