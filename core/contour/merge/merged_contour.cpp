// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/merged_contour.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/merge/stroke_smoothing.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLongestWaver = 6.0;   // distances: what the mean does over a longer way was drawn
constexpr double kGapPx = 1.5;          // points farther apart than this get others between them
constexpr double kJointPx = 3.0;        // farther apart: no stroke was there
constexpr int kMostStep = 4;            // points: neighbours on the mean lie no farther apart on the line
constexpr double kRoomSmoothing = 4.0;  // points
constexpr double kBandSmoothing = 1.5;  // points: little, as every stroke is to stay inside

// Adds points where there is less than about one a pixel: where strokes were joined or the line was stretched.
void fillGaps(Contour& c) {
  const std::size_t n = c.points.size();
  Contour even;
  const auto add = [&](std::size_t i, std::size_t next, double part) {
    const auto between = [&](const std::vector<float>& from, std::vector<float>& to) {
      if (from.size() == n) to.push_back(std::lerp(from[i], from[next], static_cast<float>(part)));
    };
    even.points.push_back(c.points[i] + part * (c.points[next] - c.points[i]));
    between(c.widthPx, even.widthPx);
    between(c.band.left, even.band.left);
    between(c.band.right, even.band.right);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = i + 1 < n ? i + 1 : c.closed ? 0 : i;
    const double gap = (c.points[next] - c.points[i]).norm();
    const int spans = gap > kGapPx ? static_cast<int>(std::lround(gap)) : 1;
    for (int k = 0; k < spans; ++k) {
      add(i, next, static_cast<double>(k) / spans);
      const bool given = gap < kJointPx && c.refined[next] != 0;
      even.refined.push_back(k == 0 ? c.refined[i] : given ? c.refined[i] : std::uint8_t{0});
    }
  }
  c.points = std::move(even.points);
  c.refined = std::move(even.refined);
  c.widthPx = std::move(even.widthPx);
  c.band = std::move(even.band);
}

// The points of a line on which each comes after the one before.
Contour orderedPoints(const MeanLine& line, const std::vector<Contour>& lines) {
  Contour c;
  c.kind = ContourKind::Centreline;
  c.closed = line.closed;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (!c.points.empty() && (line.points[i] - c.points.back()).dot(line.tangent[i]) < 0.2) continue;  // never back
    const Contour& from = lines[line.source[i].line];
    const auto at = static_cast<std::size_t>(line.source[i].index);
    c.points.push_back(line.points[i]);
    c.refined.push_back(from.refined[at]);
    c.widthPx.push_back(from.widthPx[at]);
  }
  while (c.closed && c.points.size() > 3 && (c.points.front() - c.points.back()).norm() < 0.35) {
    c.points.pop_back();
    c.refined.pop_back();
    c.widthPx.pop_back();
  }
  return c;
}

// Every value becomes the largest within the reach of the smoothing, and no value less than it was.
std::vector<float> widened(const std::vector<float>& v, bool closed) {
  const int n = static_cast<int>(v.size()), reach = static_cast<int>(std::ceil(3.0 * kBandSmoothing));
  std::vector<float> most(v.size());
  for (int i = 0; i < n; ++i)
    for (int k = i - reach; k <= i + reach; ++k) {
      if (!closed && (k < 0 || k >= n)) continue;
      const auto at = static_cast<std::size_t>(i);
      most[at] = std::max(most[at], v[wrapIndex(k, n)]);
    }
  return smoothValues(most, closed, kBandSmoothing);
}

// Where the strokes lie after the points have moved from where they were `before`.
StrokeBand movedBand(StrokeBand band, const std::vector<Vec2>& before, const Contour& c) {
  const std::vector<Vec2> tangent = directions(before, c.closed, 3);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto across = static_cast<float>((c.points[i] - before[i]).dot(leftNormal(tangent[i])));
    band.left[i] = std::max(0.0f, band.left[i] - across);
    band.right[i] = std::max(0.0f, band.right[i] + across);
  }
  return {widened(band.left, c.closed), widened(band.right, c.closed)};
}

bool isBridged(const Contour& stroke, int index) {
  return std::any_of(stroke.bridges.begin(), stroke.bridges.end(),
                     [index](const auto& b) { return index >= b.first && index <= b.second; });
}

// The stretches of a merged line for which the strokes only bridge a gap in the ink.
std::vector<std::pair<int, int>> bridgesOf(const Contour& c, const MeanLine& line, const std::vector<Contour>& lines) {
  std::vector<std::pair<int, int>> bridges;
  int at = -1;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (!isBridged(lines[line.source[i].line], line.source[i].index)) continue;
    int nearest = 0;
    for (int k = 1; k < static_cast<int>(c.points.size()); ++k) {
      const auto distance = [&](int j) { return (c.points[j] - line.points[i]).squaredNorm(); };
      if (distance(k) < distance(nearest)) nearest = k;
    }
    // Neighbours on the mean are about a pixel apart: a jump begins another bridge.
    if (at >= 0 && std::abs(nearest - at) <= kMostStep) {
      bridges.back() = {std::min(bridges.back().first, nearest), std::max(bridges.back().second, nearest)};
    } else {
      bridges.emplace_back(nearest, nearest);
    }
    at = nearest;
  }
  return bridges;
}

}  // namespace

Contour mergedContour(const MeanLine& line, const std::vector<Contour>& lines, const StrokesBeside& strokes,
                      double distancePx, const RunContext& context) {
  Contour c = orderedPoints(line, lines);
  fillGaps(c);
  StrokeBand band = strokes.band(c.points, c.closed, context);
  const std::vector<Vec2> before = c.points;
  fairWithinBand(
      c.points, c.closed,
      {smoothValues(band.left, c.closed, kRoomSmoothing), smoothValues(band.right, c.closed, kRoomSmoothing)},
      kLongestWaver * distancePx);
  c.band = movedBand(std::move(band), before, c);
  fillGaps(c);
  c.bridges = bridgesOf(c, line, lines);
  c.chain = c.points;
  c.lengthPx = polylineLength(c.points, c.closed);
  c.areaPx = c.closed ? polygonArea(c.points) : 0.0;
  return c;
}

}  // namespace batten
