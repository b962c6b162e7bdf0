// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/shared_ink.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/centreline/junction/arc_through.h"
#include "core/contour/centreline/junction/end_rows.h"

namespace batten {
namespace {

constexpr double kReachShare = 0.5;   // of the shared length: so far beyond it a stroke is an arc still,
constexpr double kReachWidths = 4.0;  // and at least so many [stroke widths]
constexpr double kLeastWidths = 1.5;  // [stroke widths] of each end that must be seen
constexpr int kLeastPoints = 5;       // of each end: an arc takes three
// As mostLeftPx(), along the ink, where narrow paper between two strokes is closed.
constexpr double kAlongPx = 0.6, kAlongWidths = 0.12;
constexpr double kClearMiss = 2.0;       // the other pairing leaves more by this factor where one is clear
constexpr double kClearedWidths = 10.0;  // [stroke widths] from which on an end can spare its beginning
constexpr double kLeastWider = 1.1;      // [stroke widths] of the ink that two strokes share, in the mean
// A stroke that turns by more, as a ring, may be two branches on one side of the other stroke, which by itself must
// leave so many times more of the ink's widths.
constexpr double kRingTurnDeg = 40.0, kClearRing = 1.3;

struct OuterEnd {
  int end = 0;
  std::vector<Vec2> points;  // in the local frame
  double width = 1.0;        // [px]
};

double meanAcross(const OuterEnd& outer) {
  double sum = 0.0;
  for (const Vec2& p : outer.points) sum += p.y();
  return sum / static_cast<double>(outer.points.size());
}

// The course of the outermost stroke of this width in an end that holds several.
std::vector<Vec2> outermost(const OuterEnd& outer, bool isUpper, double width) {
  std::vector<Vec2> points = outer.points;
  const double aside = (isUpper ? 0.5 : -0.5) * (outer.width - width);
  for (Vec2& p : points) p.y() += aside;
  return points;
}

class SharedEdge {
 public:
  SharedEdge(const SkeletonGraph& graph, int edge) : graph_(graph), edge_(edge) {}

  std::optional<SharedInk> find() {
    if (!measure()) return std::nullopt;
    std::optional<Pairing> best = paired(0), other = paired(1);
    if (other && (!best || other->ink.missPx < best->ink.missPx)) std::swap(best, other);
    if (!best || !best->fits) return std::nullopt;
    best->ink.isDoubtful = other && (other->fits || other->ink.missPx < kClearMiss * best->ink.missPx);
    const double clear = clearPx();
    for (const int side : {0, 1}) {
      const SkeletonNode& node = graph_.node(*graph_.edge(edge_).node[side]);
      best->ink.discs[side] = {node.centre, node.radius + clear};
    }
    return best->ink;
  }

 private:
  bool measure();
  std::optional<OuterEnd> outerEnd(int end, const SkeletonNode& node) const;
  struct Pairing {
    SharedInk ink;
    bool fits = false;
  };
  std::optional<Pairing> paired(int other) const;
  double clearPx() const;
  bool mayCross(int other) const;
  double widthsLeftBy(double half) const;

  const SkeletonGraph& graph_;
  int edge_;
  LocalFrame frame_;
  std::array<std::array<OuterEnd, 2>, 2> ends_;  // [side of the edge]
  double width_ = 1.0;                           // [px] of one stroke
};

std::optional<OuterEnd> SharedEdge::outerEnd(int end, const SkeletonNode& node) const {
  const SkeletonEdge& e = graph_.edge(end / 2);
  const EdgeFromEnd points(e.points, end % 2);
  OuterEnd outer{end, {}, 0.0};
  const double reach =
      std::max(kReachShare * graph_.edge(edge_).length, kReachWidths * 2.0 * graph_.meanRadius(end / 2));
  const std::optional<int> far = e.node[1 - end % 2];
  double arc = 0.0;
  for (int k = 0; k < points.size() && arc <= reach; ++k) {
    const Vec2& at = points[k].at;
    if ((at - node.centre).norm() < kTrimRadii * node.radius) continue;
    if (far && (at - graph_.node(*far).centre).norm() < kTrimRadii * graph_.node(*far).radius) break;
    if (!outer.points.empty()) arc += (at - points[k - 1].at).norm();
    outer.points.push_back(frame_.local(at));
    outer.width += 2.0 * static_cast<double>(points[k].radius);
  }
  outer.width /= std::max<double>(1.0, static_cast<double>(outer.points.size()));
  if (std::ssize(outer.points) < kLeastPoints || arc < kLeastWidths * outer.width) return std::nullopt;
  return outer;
}

bool SharedEdge::measure() {
  const SkeletonEdge& shared = graph_.edge(edge_);
  const Vec2 along = shared.points.back().at - shared.points.front().at;
  if (!(along.norm() > 0.0)) return false;
  frame_ = {shared.points[shared.points.size() / 2].at, along.normalized()};
  std::vector<double> widths;
  for (const int side : {0, 1}) {
    const SkeletonNode& node = graph_.node(*shared.node[side]);
    if (node.ends.size() != 3) return false;
    int k = 0;
    for (const int end : node.ends) {
      if (end / 2 == edge_) continue;
      std::optional<OuterEnd> outer = outerEnd(end, node);
      if (!outer || k == 2) return false;
      widths.push_back(outer->width);
      ends_[side][k++] = std::move(*outer);
    }
    if (k != 2) return false;
  }
  width_ = 0.25 * (widths[0] + widths[1] + widths[2] + widths[3]);
  return 2.0 * graph_.meanRadius(edge_) >= kLeastWider * width_;
}

// Beyond the disc where they part, two strokes touch for a while. Of a small ring nothing else would be left.
double SharedEdge::clearPx() const {
  const auto isLong = [&](const OuterEnd& outer) {
    return graph_.edge(outer.end / 2).length >= kClearedWidths * outer.width;
  };
  const bool areLong = std::ranges::all_of(ends_, [&](const auto& side) { return std::ranges::all_of(side, isLong); });
  return areLong ? 0.5 * width_ : 0.0;
}

// [px^2] Mean square of what a stroke of this half-width leaves of the ink's, by itself.
double SharedEdge::widthsLeftBy(double half) const {
  double sum = 0.0;
  for (const StrokePathPoint& s : graph_.edge(edge_).points) {
    const double wider = static_cast<double>(s.radius) - half;
    sum += wider * wider;
  }
  return sum / std::max<double>(1.0, static_cast<double>(graph_.edge(edge_).points.size()));
}

// Where strokes cross, one lies on the other: the ink is narrower by one than that of strokes side by side.
bool SharedEdge::mayCross(int other) const {
  double row = 0.0;
  for (const auto& side : ends_) row = std::max(row, side[0].width + side[1].width);
  const double thinner = std::min(std::max(ends_[0][0].width, ends_[1][other].width),
                                  std::max(ends_[0][1].width, ends_[1][1 - other].width));
  return mayLieOnAnother(2.0 * graph_.narrowRadius(edge_), row, thinner);
}

// The first end of one side goes on to end `other` of the other. Where both keep to their sides each may be one of a
// bundle: of an end that is wider the outermost stroke goes on.
std::optional<SharedEdge::Pairing> SharedEdge::paired(int other) const {
  const auto isUpper = [&](int side, int k) { return meanAcross(ends_[side][k]) > meanAcross(ends_[side][1 - k]); };
  const bool keepSides = isUpper(0, 0) == isUpper(1, other);
  std::array<LocalArc, 2> arcs;
  std::array<double, 2> halves;  // [px] of the widths
  double left = 0.0;
  std::array<double, 2> turns;  // [deg] from one end to the other
  for (const int k : {0, 1}) {
    const OuterEnd &p = ends_[0][k], &q = ends_[1][k == 0 ? other : 1 - other];
    const double width = std::min(p.width, q.width);
    const std::vector<Vec2> a = keepSides ? outermost(p, isUpper(0, k), width) : p.points;
    const std::vector<Vec2> b = keepSides ? outermost(q, isUpper(0, k), width) : q.points;
    const std::optional<LocalArc> arc = arcThrough(a, b);
    if (!arc) return std::nullopt;
    arcs[k] = *arc;
    halves[k] = keepSides ? 0.5 * width : 0.25 * (p.width + q.width);
    turns[k] = turnDeg(p.points.front() - p.points.back(), q.points.back() - q.points.front());
    const double wider = keepSides ? 0.0 : 0.5 * (p.width - q.width);
    left += 0.25 * (squaresLeft(*arc, a) + squaresLeft(*arc, b) + 2.0 * wider * wider);
  }
  double along = 0.0, widths = 0.0;
  int count = 0;
  for (const StrokePathPoint& s : graph_.edge(edge_).points) {
    const Vec2 at = frame_.local(s.at);
    const Vec2 across = arcs[0].normalAt(at);
    const double a = across.dot(arcs[0].toArc(at)), b = across.dot(arcs[1].toArc(at));
    const double low = std::min(a - halves[0], b - halves[1]), high = std::max(a + halves[0], b + halves[1]);
    const double aside = 0.5 * (low + high), wider = 0.5 * (high - low) - static_cast<double>(s.radius);
    along += aside * aside + wider * wider;
    widths += wider * wider;
    ++count;
  }
  along /= std::max(1, count);
  widths /= std::max(1, count);
  const double most = mostLeftPx(width_), mostAlong = kAlongPx + kAlongWidths * width_;
  Pairing found;
  found.fits = left <= most * most && along <= mostAlong * mostAlong && (keepSides || mayCross(other));
  for (const int k : {0, 1}) {
    if (turns[k] > kRingTurnDeg && !(widthsLeftBy(halves[1 - k]) > kClearRing * kClearRing * widths))
      found.fits = false;
  }
  found.ink.missPx = std::sqrt(left + along);
  if (!std::isfinite(found.ink.missPx)) return std::nullopt;
  found.ink.strokes = {std::pair(ends_[0][0].end, ends_[1][other].end),
                       std::pair(ends_[0][1].end, ends_[1][1 - other].end)};
  return found;
}

}  // namespace

std::optional<SharedInk> findSharedInk(const SkeletonGraph& graph, int edge) { return SharedEdge(graph, edge).find(); }

}  // namespace batten
