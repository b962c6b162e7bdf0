// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/merged_contour.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/contour/merge/stroke_smoothing.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLongestWaver = 6.0;     // distances: what the mean does over a longer way was drawn
constexpr double kGapPx = 1.5;            // points farther apart than this get others between them
constexpr double kJointPx = 3.0;          // farther apart: no stroke was there
constexpr int kMostStep = 4;              // points: neighbours on the mean lie no farther apart on the line
constexpr double kLeastAdvancePx = 0.2;   // along the line, from point to point
constexpr double kLeastSeamPx = 0.35;     // between the last and the first point of a ring
constexpr double kRoomSmoothing = 4.0;    // points
constexpr double kBundleSmoothing = 1.5;  // points: little, as every stroke is to stay inside
constexpr double kWidenedReach = 3.0;     // standard deviations of that smoothing: beyond, it averages next to nothing
constexpr int kBundleTangentReach = 3;    // points to either side

// The place, width and bundle between two points, at `part` of the way.
ContourPoint contourPointBetween(const ContourPoint& a, const ContourPoint& b, double part) {
  const auto t = static_cast<float>(part);
  ContourPoint p;
  p.at = a.at + part * (b.at - a.at);
  if (a.widthPx && b.widthPx) p.widthPx = std::lerp(*a.widthPx, *b.widthPx, t);
  if (a.bundle && b.bundle)
    p.bundle = {std::lerp(a.bundle->left, b.bundle->left, t), std::lerp(a.bundle->right, b.bundle->right, t)};
  return p;
}

// Adds points where there is less than about one a pixel: where strokes were joined or the line was stretched.
void fillGaps(Contour& c) {
  const int n = static_cast<int>(c.points.size());
  std::vector<ContourPoint> even;
  for (int i = 0; i < n; ++i) {
    const ContourPoint &here = c.points[i], &next = c.points[i + 1 < n ? i + 1 : c.closed ? 0 : i];
    const double gap = (next.at - here.at).norm();
    const int spans = gap > kGapPx ? static_cast<int>(std::lround(gap)) : 1;
    for (int k = 0; k < spans; ++k) {
      even.push_back(contourPointBetween(here, next, static_cast<double>(k) / spans));
      const bool given = gap < kJointPx && next.refined;
      even.back().refined = (k == 0 || given) && here.refined;
    }
  }
  c.points = std::move(even);
}

// The points of a line on which each comes after the one before.
Contour orderedPoints(const MeanLine& line, const std::vector<Contour>& lines) {
  Contour c;
  c.kind = ContourKind::Centreline;
  c.closed = line.closed;
  for (const MeanPoint& p : line.points) {
    if (!c.points.empty() && (p.at - c.points.back().at).dot(p.tangent) < kLeastAdvancePx) continue;  // never back
    const ContourPoint& from = lines[p.source.line].points[p.source.index];
    c.points.push_back({.at = p.at, .refined = from.refined, .widthPx = from.widthPx});
  }
  while (c.closed && c.points.size() > 3 && (c.points.front().at - c.points.back().at).norm() < kLeastSeamPx) {
    c.points.pop_back();
  }
  return c;
}

// Every value becomes the largest within the reach of the smoothing, and no value less than it was.
std::vector<float> widened(const std::vector<float>& v, bool closed) {
  const int n = static_cast<int>(v.size()), reach = static_cast<int>(std::ceil(kWidenedReach * kBundleSmoothing));
  std::vector<float> most(v.size());
  for (int i = 0; i < n; ++i)
    for (int k = i - reach; k <= i + reach; ++k) {
      if (!closed && (k < 0 || k >= n)) continue;
      most[i] = std::max(most[i], v[wrapIndex(k, n)]);
    }
  return smoothValues(most, closed, kBundleSmoothing);
}

// A function of numbers along a line, applied to either side of a bundle.
template <class Function>
std::vector<BundleWidths> onBothSides(const std::vector<BundleWidths>& bundle, const Function& function) {
  std::vector<float> left, right;
  for (const BundleWidths& b : bundle) {
    left.push_back(b.left);
    right.push_back(b.right);
  }
  left = function(left);
  right = function(right);
  std::vector<BundleWidths> made;
  made.reserve(bundle.size());
  for (int i = 0; i < std::ssize(bundle); ++i) made.push_back({left[i], right[i]});
  return made;
}

// Where the strokes lie after the points of a line have moved.
std::vector<BundleWidths> movedBundle(std::vector<BundleWidths> bundle, const std::vector<Vec2>& from,
                                      const std::vector<Vec2>& to, bool closed) {
  const std::vector<Vec2> tangent = directions(from, closed, kBundleTangentReach);
  for (int i = 0; i < std::ssize(from); ++i) {
    const auto across = static_cast<float>((to[i] - from[i]).dot(leftNormal(tangent[i])));
    bundle[i] = {std::max(0.0f, bundle[i].left - across), std::max(0.0f, bundle[i].right + across)};
  }
  return onBothSides(bundle, [closed](const std::vector<float>& v) { return widened(v, closed); });
}

bool isBridged(const Contour& stroke, int index) {
  return std::any_of(stroke.bridges.begin(), stroke.bridges.end(),
                     [index](const auto& b) { return index >= b.first && index <= b.second; });
}

// The stretches of a merged line for which the strokes only bridge a gap in the ink.
std::vector<std::pair<int, int>> bridgesOf(const Contour& c, const MeanLine& line, const std::vector<Contour>& lines) {
  std::vector<std::pair<int, int>> bridges;
  std::optional<int> before;
  for (const MeanPoint& p : line.points) {
    if (!isBridged(lines[p.source.line], p.source.index)) continue;
    int nearest = 0;
    for (int k = 1; k < std::ssize(c.points); ++k) {
      const auto distance = [&](int j) { return (c.points[j].at - p.at).squaredNorm(); };
      if (distance(k) < distance(nearest)) nearest = k;
    }
    // Neighbours on the mean are about a pixel apart: a jump begins another bridge.
    if (before && std::abs(nearest - *before) <= kMostStep) {
      bridges.back() = {std::min(bridges.back().first, nearest), std::max(bridges.back().second, nearest)};
    } else {
      bridges.emplace_back(nearest, nearest);
    }
    before = nearest;
  }
  return bridges;
}

}  // namespace

Contour mergedContour(const MeanLine& line, const std::vector<Contour>& lines, const StrokesBeside& strokes,
                      double distancePx, const RunContext& context) {
  Contour c = orderedPoints(line, lines);
  fillGaps(c);
  const std::vector<Vec2> before = positionsOf(c.points);
  std::vector<BundleWidths> bundle = strokes.bundle(before, c.closed, context);
  const std::vector<BundleWidths> room =
      onBothSides(bundle, [&](const std::vector<float>& v) { return smoothValues(v, c.closed, kRoomSmoothing); });
  const std::vector<Vec2> fair = fairWithinBundle(before, c.closed, room, kLongestWaver * distancePx);
  bundle = movedBundle(std::move(bundle), before, fair, c.closed);
  for (int i = 0; i < std::ssize(fair); ++i) {
    c.points[i].at = fair[i];
    c.points[i].bundle = bundle[i];
  }
  fillGaps(c);
  c.bridges = bridgesOf(c, line, lines);
  for (ContourPoint& p : c.points) p.unrefined = p.at;
  measureContour(c);
  return c;
}

}  // namespace batten
