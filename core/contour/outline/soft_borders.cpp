// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/soft_borders.h"

#include <algorithm>
#include <cmath>

#include "core/contour/subpixel/edge_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kNearPx = 3.0, kFarPx = 11.0;  // to either side: what a soft border rises by between them
constexpr double kSoftRatio = 2.2;              // of the rises; a ramp has 3.7, an edge blurred by 5 px 2.15
constexpr double kAlongSigma = 6.0;             // points: noise along the border
constexpr int kShortestSoft = 30;               // points
constexpr int kShortestSharp = 20;              // points: between soft stretches
constexpr int kRaggedShare = 3;                 // of the shortest soft stretch: shorter ones do not bridge sharp ones
constexpr double kNearlyAllSoft = 0.9;          // no edge to tell from

// Stretches that are soft, or sharp, as `what` says, and shorter than this become as what is around them.
void flipShortStretches(std::vector<std::uint8_t>& soft, bool closed, std::uint8_t what, int shorter) {
  const int n = static_cast<int>(soft.size());
  const auto at = [&](int i) -> std::uint8_t& { return soft[wrapIndex(i, n)]; };
  int start = 0;
  while (closed && start < n && at(start) == at(start - 1)) ++start;
  if (start == n) return;
  for (int i = start; i < start + n; ++i) {
    int end = i;
    while (end + 1 < start + n && at(end + 1) == at(i)) ++end;
    if (at(i) == what && end - i + 1 < shorter) {
      const auto other = static_cast<std::uint8_t>(1 - what);
      for (int k = i; k <= end; ++k) at(k) = other;
    }
    i = end;
  }
}

std::vector<std::uint8_t> softPoints(const Contour& c, const GreyImage& grey, const RunContext& context) {
  const int n = static_cast<int>(c.points.size());
  std::vector<std::uint8_t> soft(n, 0);
  const std::vector<EdgeRise> rises =
      edgeRises(unrefinedPositionsOf(c.points), c.closed, grey, {kNearPx, kFarPx}, kAlongSigma, context);
  if (context.isCancelled()) return soft;
  const auto onBorder = [&](const Vec2& p) {
    return p.x() < kFarPx || p.y() < kFarPx || p.x() > grey.width - kFarPx || p.y() > grey.height - kFarPx;
  };
  for (int i = 0; i < n; ++i)
    soft[i] = !onBorder(c.points[i].unrefined) && rises[i].outer > kSoftRatio * rises[i].inner ? 1 : 0;
  flipShortStretches(soft, c.closed, 1, kShortestSoft / kRaggedShare);
  flipShortStretches(soft, c.closed, 0, kShortestSharp);
  flipShortStretches(soft, c.closed, 1, kShortestSoft);
  if (std::find(soft.begin(), soft.end(), std::uint8_t{1}) == soft.end()) return soft;
  // A tone that fades somewhere is cut off by the page, not bordered by it.
  for (int i = 0; i < n; ++i)
    if (onBorder(c.points[i].unrefined)) soft[i] = 1;
  flipShortStretches(soft, c.closed, 0, kShortestSharp);
  return soft;
}

Contour stretchOf(const Contour& c, int from, int to) {
  const int n = static_cast<int>(c.points.size());
  Contour part;
  part.kind = c.kind;
  part.hole = c.hole;
  part.blurPx = c.blurPx;
  part.pencilPx = c.pencilPx;
  part.isUneven = c.isUneven;
  part.traceMode = c.traceMode;
  for (int k = from; k <= to; ++k) part.points.push_back(c.points[wrapIndex(k, n)]);
  measureContour(part);
  return part;
}

}  // namespace

std::vector<Contour> cutSoftBorders(const Contour& outline, const GreyImage& grey, const RunContext& context) {
  const int n = static_cast<int>(outline.points.size());
  if (n < kShortestSoft + kShortestSharp) return {outline};
  const std::vector<std::uint8_t> soft = softPoints(outline, grey, context);
  const auto count = std::count(soft.begin(), soft.end(), std::uint8_t{1});
  if (count == 0 || static_cast<double>(count) > kNearlyAllSoft * n) return {outline};
  const auto isSoft = [&](int i) { return soft[wrapIndex(i, n)] != 0; };
  std::vector<Contour> parts;
  int start = 0;
  while (outline.closed && !isSoft(start - 1)) ++start;
  for (int i = start; i < start + n; ++i) {
    if (isSoft(i)) continue;
    int end = i;
    while (end + 1 < start + n && !isSoft(end + 1)) ++end;
    parts.push_back(stretchOf(outline, i, end));
    i = end;
  }
  return parts;
}

}  // namespace batten
