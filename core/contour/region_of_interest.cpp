// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/region_of_interest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/image/bits/run_pieces.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kFarthestCornerPx = 1e7;  // of a region: far beyond any page; a limit of input

/// Where the row through y meets the sides of a polygon, sorted.
std::vector<double> crossings(const RegionOfInterest& region, double y) {
  std::vector<double> at;
  const auto& corners = region.cornersPx;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    at.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// Pixels whose centres lie in the region.
void fillRegion(BitImage& mask, const RegionOfInterest& region) {
  for (int y = 0; y < mask.height; ++y) {
    const std::vector<double> at = crossings(region, y + 0.5);
    for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
      const auto pixel = [&](double x) {
        return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(mask.width)));
      };
      const int x0 = pixel(at[i]), x1 = pixel(at[i + 1]);
      if (x1 > x0) setBits(mask, {y, x0, x1});
    }
  }
}

/// The points first..first + count - 1 (modulo the size) as an open line.
Contour part(const Contour& whole, std::size_t first, std::size_t count) {
  Contour cut;
  cut.kind = whole.kind;
  cut.hole = whole.hole;
  cut.blurPx = whole.blurPx;
  cut.pencilPx = whole.pencilPx;
  cut.isUneven = whole.isUneven;
  cut.traceMode = whole.traceMode;
  const std::size_t n = whole.points.size();
  for (std::size_t i = 0; i < count; ++i) cut.points.push_back(whole.points[(first + i) % n]);
  const int last = static_cast<int>(count) - 1, size = static_cast<int>(n);
  for (const auto& [from, to] : whole.bridges) {
    for (const int turn : {-size, 0}) {  // a part may run over the end of a closed line
      const int a = from - turn - static_cast<int>(first), b = to - turn - static_cast<int>(first);
      if (b >= 0 && a <= last) cut.bridges.emplace_back(std::max(a, 0), std::min(b, last));
    }
  }
  measureContour(cut);
  return cut;
}

void addParts(std::vector<Contour>& kept, Contour&& line, std::span<const RegionOfInterest> regions) {
  const std::size_t n = line.points.size();
  std::vector<std::uint8_t> inside(n);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += inside[i] = isInside(regions, line.points[i].at) ? 1 : 0;
  if (count == n) {
    kept.push_back(std::move(line));
    return;
  }
  // A closed line is gone round from a point outside on, so that no part is cut by its seam.
  std::size_t begin = 0;
  while (line.closed && begin < n && inside[begin]) ++begin;
  for (std::size_t k = 0; k < n;) {
    const auto at = [&](std::size_t i) { return (begin + i) % n; };
    if (!inside[at(k)]) {
      ++k;
      continue;
    }
    std::size_t end = k;
    while (end < n && inside[at(end)]) ++end;
    if (end - k >= 2) kept.push_back(part(line, at(k), end - k));
    k = end;
  }
}

}  // namespace

RegionOfInterest rectangleRegion(const Vec2& a, const Vec2& b) {
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  return {{low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())}};
}

std::optional<Error> validate(const RegionOfInterest& region) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (region.cornersPx.size() < 3) return bad("A region needs at least three corners.");
  for (const Vec2& p : region.cornersPx) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kFarthestCornerPx)
      return bad("A corner of a region has no valid position.");
  }
  if (!(polygonArea(region.cornersPx) > 0.0)) return bad("A region must have an area.");
  return std::nullopt;
}

bool isInside(std::span<const RegionOfInterest> regions, const Vec2& px) {
  for (const RegionOfInterest& region : regions) {
    bool isLeftOdd = false;
    const auto& corners = region.cornersPx;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      if ((a.y() <= px.y()) == (b.y() <= px.y())) continue;
      if (a.x() + (px.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) <= px.x()) isLeftOdd = !isLeftOdd;
    }
    if (isLeftOdd) return true;
  }
  return false;
}

BitImage inkTouching(const BitImage& ink, std::span<const RegionOfInterest> regions, const RunContext& context) {
  BitImage mask(ink.width, ink.height);
  for (const RegionOfInterest& region : regions) {
    if (context.isCancelled()) return mask;
    fillRegion(mask, region);
  }
  return keepPieces(ink, {.seeds = &mask}, context);
}

ContourSet keepInside(ContourSet set, std::span<const RegionOfInterest> regions, double minLengthPx) {
  std::vector<Contour> kept;
  for (Contour& line : set.contours) addParts(kept, std::move(line), regions);
  std::erase_if(kept, [&](const Contour& c) { return c.lengthPx < minLengthPx; });
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Contour& a, const Contour& b) { return a.lengthPx > b.lengthPx; });
  set.contours = std::move(kept);
  std::erase_if(set.junctions, [&](const StrokeJunction& junction) {
    return !junction.choice && !isInside(regions, junction.positionPx);
  });
  return set;
}

}  // namespace batten
