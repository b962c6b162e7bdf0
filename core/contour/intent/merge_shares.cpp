// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/merge_shares.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

std::vector<MergeShares> mergeSharesOf(const std::vector<Strip>& strips, const std::vector<Contour>& merged,
                                       double widthPx, double reach, const RunContext& context) {
  constexpr double kSameWayCos = 0.8;  // 37 degrees
  constexpr int kEvery = 2;            // points of a merged line
  constexpr int kMergedReach = 5;      // points: of the chord of a direction
  struct MergedPlace {
    int line;
    Vec2 at, tangent;
  };
  PointGrid<MergedPlace> grid(reach);
  for (int l = 0; l < std::ssize(merged); ++l) {
    const std::vector<Vec2> points = positionsOf(merged[l].points);
    const std::vector<Vec2> tangents = directions(points, merged[l].closed, kMergedReach);
    for (std::size_t i = 0; i < points.size(); i += kEvery)
      grid.add(points[i] / widthPx, {l, points[i] / widthPx, tangents[i]});
  }
  std::vector<MergeShares> shares(strips.size());
  for (int s = 0; s < std::ssize(strips) && !context.isCancelled(); ++s)
    for (const StripSample& sample : strips[s].samples) {
      std::optional<int> line;
      double nearest = reach;
      grid.around(sample.at, [&](const MergedPlace& p) {
        const double d = (p.at - sample.at).norm();
        if (d >= nearest || std::abs(p.tangent.dot(sample.tangent)) < kSameWayCos) return;
        nearest = d;
        line = p.line;
      });
      if (line) shares[s][*line] += 1.0 / strips[s].count();
    }
  return shares;
}

double alikeness(const MergeShares& a, const MergeShares& b) {
  double sum = 0.0;
  for (const auto& [line, share] : a) {
    const auto other = b.find(line);
    if (other != b.end()) sum += std::min(share, other->second);
  }
  return sum;
}

double coverage(const MergeShares& a) {
  double sum = 0.0;
  for (const auto& [line, share] : a) sum += share;
  return sum;
}

std::vector<double> mergeFeatures(const MergeShares& a, const MergeShares& b, double number) {
  const double alike = alikeness(a, b);
  return {alike, alike * number, std::max(0.0, std::min(coverage(a), coverage(b)) - alike)};
}

}  // namespace batten
