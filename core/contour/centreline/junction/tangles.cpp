// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/tangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/angle.h"
#include "core/base/disjoint_sets.h"
#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/contour/centreline/junction/arc_through.h"
#include "core/contour/centreline/junction/end_rows.h"

namespace batten {
namespace {

constexpr double kSharedInk = 1.1;      // [stroke widths] of the page: what is wider two strokes share
constexpr double kNearNodes = 1.5;      // [radii of two junctions] a shorter edge lies in their ink
constexpr double kSlitWidths = 12.0;    // [stroke widths] along paper between two strokes of a tangle
constexpr double kCommonWidths = 25.0;  // [stroke widths] two strokes lie on one another at most: at 5 degrees it is 23
// A longer inner edge [widths] of common ink has two strokes at its middle and is so many times as wide as the wider.
constexpr double kLongWidths = 3.0, kTwoStrokes = 1.05;
constexpr double kAloneWidths = 18.0;  // [stroke widths] of one stroke between two crossings
constexpr double kBold = 1.5;          // [stroke widths] of a stroke bolder than the others
constexpr double kStubWidths = 1.0;    // [stroke widths] a shorter end is a spur of the skeleton
constexpr int kTangleNodes = 3;        // two are one crossing or one stretch of shared ink (shared_ink.h)
constexpr int kMostNodes = 14, kFewestTangleEnds = 4, kMostTangleEnds = 10;
constexpr double kOwnInk = 1.15, kOwnInkPx = 0.25;  // [half-widths] and [px] an end beyond the common ink is as wide
constexpr double kEndShare = 0.5;                   // of the tangle's size: so far beyond it a stroke is an arc still,
constexpr double kEndWidths = 5.0;                  // and at least so many [stroke widths]
constexpr double kLeastSeenWidths = 2.0;            // that must be seen
constexpr int kLeastEndPoints = 6;
constexpr double kMostTurnDeg = 40.0;      // from one end to the other
constexpr double kExplainedWidths = 0.75;  // from the nearest arc: ink farther aside is of none
// [stroke widths] and [px] Paper that the skeleton runs round, as a speck where two strokes part.
constexpr double kSpeckWidths = 0.25, kSpeckPx = 0.5;
// [stroke widths per radian] Of two pairings that leave as little the one that turns less is likelier.
constexpr double kTurnWidths = 0.6;
constexpr double kSideBySideHalf = 0.27;  // tan 15 degrees: of half the angle of strokes that look side by side
constexpr double kClearSquares = 4.0;     // the next best pairing leaves so many times more where one is clear

struct TangleEnd {
  int end = 0;
  std::vector<Vec2> points;  // [px] beyond the common ink
  Vec2 out = Vec2::Zero();
  double width = 1.0;  // [px]
};

struct TangleArc {
  LocalFrame frame;
  LocalArc arc;
  double left = 0.0;  // [px^2] mean square that it leaves of its two ends
  double cost = 0.0;  // [px^2] of that and of its turn
  double widthPx = 1.0;
  double distance(const Vec2& p) const { return arc.toArc(frame.local(p)).norm(); }
};

std::vector<Vec2> localPoints(const LocalFrame& frame, const std::vector<Vec2>& points) {
  std::vector<Vec2> local;
  local.reserve(points.size());
  for (const Vec2& p : points) local.push_back(frame.local(p));
  return local;
}

class TangleFinder {
 public:
  explicit TangleFinder(const SkeletonGraph& graph) : graph_(graph), usualWidth_(2.0 * graph.medianRadius()) {}
  std::vector<Tangle> find();

 private:
  bool isJunction(int node) const { return graph_.node(node).ends.size() >= 3; }
  bool isCommonInk(int edge) const { return 2.0 * graph_.meanRadius(edge) >= kSharedInk * usualWidth_; }
  bool isShort(int edge) const;
  bool isStub(int end) const;
  std::vector<Tangle> clusters() const;
  bool tellStrokes(Tangle& tangle);
  std::optional<TangleEnd> measure(int end, double sizePx) const;
  std::optional<TangleArc> arcOf(const TangleEnd& p, const TangleEnd& q) const;
  bool isWithinInk(const TangleArc& arc, const TangleEnd& p, const TangleEnd& q) const;
  void match(int from, double sum, int open);
  std::vector<Vec2> coursePlaces(const TangleArc& arc, const TangleEnd& p, const TangleEnd& q) const;
  struct Crossing {
    Vec2 at = Vec2::Zero(), across = Vec2::Zero();
    double halfTangent = 0.0;  // of half the angle
  };
  std::optional<Crossing> crossingOf(const std::pair<int, int>& one, const std::pair<int, int>& other) const;
  bool mayCross(const std::vector<std::pair<int, int>>& pairs) const;
  bool explainsAll(const std::vector<std::pair<int, int>>& pairs) const;
  bool isOfTwo(int edge, const std::vector<std::pair<int, int>>& pairs) const;

  const SkeletonGraph& graph_;
  double usualWidth_;
  // Of the tangle in hand.
  std::vector<TangleEnd> ends_;
  std::vector<StrokePathPoint> ink_;  // of its inner edges
  std::map<std::pair<int, int>, TangleArc> arcs_;
  std::vector<bool> used_;
  std::vector<std::pair<int, int>> now_, best_;
  double bestSum_ = 0.0, nextSum_ = 0.0;
};

bool TangleFinder::isShort(int edge) const {
  const SkeletonEdge& e = graph_.edge(edge);
  return e.length <= kNearNodes * (graph_.node(*e.node[0]).radius + graph_.node(*e.node[1]).radius) + 1.0;
}

// A spur of the skeleton, within the common ink.
bool TangleFinder::isStub(int end) const {
  const SkeletonEdge& e = graph_.edge(end / 2);
  const std::optional<int> far = e.node[1 - end % 2];
  return far && graph_.node(*far).ends.size() == 1 && e.length <= kStubWidths * usualWidth_;
}

// Junctions that hang together, with their inner edges and outer ends.
std::vector<Tangle> TangleFinder::clusters() const {
  DisjointSets sets(graph_.nodeCount());
  std::vector<bool> isCommon(graph_.nodeCount(), false), isInner(graph_.edgeCount(), false);
  const auto isLink = [&](int i) {
    const SkeletonEdge& e = graph_.edge(i);
    return e.alive && !e.ring && e.node[0] != e.node[1] && isJunction(*e.node[0]) && isJunction(*e.node[1]);
  };
  for (int i = 0; i < graph_.edgeCount(); ++i) {
    if (!isLink(i) || !(isCommonInk(i) || isShort(i))) continue;
    if (graph_.edge(i).length > kCommonWidths * usualWidth_) continue;
    isInner[i] = true;
    sets.join(*graph_.edge(i).node[0], *graph_.edge(i).node[1]);
    for (const std::optional<int> node : graph_.edge(i).node) isCommon[*node] = isCommon[*node] || isCommonInk(i);
  }
  // Beside a slit of paper two strokes of the tangle run apart and meet again.
  for (int i = 0; i < graph_.edgeCount(); ++i) {
    if (isInner[i] || !isLink(i) || graph_.edge(i).length > kSlitWidths * usualWidth_) continue;
    const int a = *graph_.edge(i).node[0], b = *graph_.edge(i).node[1];
    if (!isCommon[a] || !isCommon[b]) continue;
    isInner[i] = true;
    sets.join(a, b);
  }
  // Round a speck of paper.
  for (int i = 0; i < graph_.edgeCount(); ++i) {
    const SkeletonEdge& e = graph_.edge(i);
    if (e.alive && !e.ring && e.node[0] == e.node[1] && e.length <= kSlitWidths * usualWidth_) isInner[i] = true;
  }
  std::map<int, Tangle> byRoot;
  for (int i = 0; i < graph_.nodeCount(); ++i)
    if (isJunction(i)) byRoot[sets.root(i)].nodes.push_back(i);
  std::vector<Tangle> found;
  for (auto& [root, tangle] : byRoot) {
    if (std::ssize(tangle.nodes) < kTangleNodes || std::ssize(tangle.nodes) > kMostNodes) continue;
    for (const int node : tangle.nodes) {
      for (const int end : graph_.node(node).ends) {
        if (!isStub(end) && !isInner[end / 2]) {
          tangle.outer.push_back(end);
        } else if (isStub(end) || end % 2 == 0) {
          tangle.inner.push_back(end / 2);
        }
      }
    }
    std::sort(tangle.outer.begin(), tangle.outer.end());
    if (std::ssize(tangle.outer) >= kFewestTangleEnds && std::ssize(tangle.outer) <= kMostTangleEnds)
      found.push_back(std::move(tangle));
  }
  return found;
}

// Nothing where too little of the stroke is seen beyond the common ink.
std::optional<TangleEnd> TangleFinder::measure(int end, double sizePx) const {
  const SkeletonEdge& e = graph_.edge(end / 2);
  const EdgeFromEnd points(e.points, end % 2);
  const SkeletonNode& node = graph_.node(*e.node[end % 2]);
  std::vector<float> radii;
  for (const StrokePathPoint& p : e.points) radii.push_back(p.radius);
  const double usual = static_cast<double>(upperMedian(radii));
  const std::optional<int> far = e.node[1 - end % 2];
  const bool isFarJunction = far && isJunction(*far);
  const double reach = std::max(kEndShare * sizePx, kEndWidths * 2.0 * usual);
  TangleEnd found;
  found.end = end;
  double arc = 0.0, width = 0.0;
  for (int k = 0; k < points.size() && arc <= reach; ++k) {
    const auto radius = static_cast<double>(points[k].radius);
    const Vec2& at = points[k].at;
    if (found.points.empty() &&
        ((at - node.centre).norm() < kTrimRadii * node.radius || radius > kOwnInk * usual + kOwnInkPx))
      continue;
    if (isFarJunction && (at - graph_.node(*far).centre).norm() < kTrimRadii * graph_.node(*far).radius) break;
    if (!found.points.empty()) arc += (at - found.points.back()).norm();
    found.points.push_back(at);
    width += 2.0 * radius;
  }
  if (std::ssize(found.points) < kLeastEndPoints) return std::nullopt;
  found.width = width / static_cast<double>(found.points.size());
  found.out = found.points.back() - found.points.front();
  if (arc < kLeastSeenWidths * found.width || !(found.out.norm() > 0.0)) return std::nullopt;
  found.out.normalize();
  return found;
}

// Places about a pixel apart on an arc between its ends.
std::vector<Vec2> TangleFinder::coursePlaces(const TangleArc& arc, const TangleEnd& p, const TangleEnd& q) const {
  const Vec2 from = p.points.front(), way = q.points.front() - from;
  const int steps = std::max(1, static_cast<int>(way.norm()));
  std::vector<Vec2> places;
  for (int k = 1; k < steps; ++k) {
    const Vec2 local = arc.frame.local(from + way * (static_cast<double>(k) / steps));
    const Vec2 on = local + arc.arc.toArc(local);
    places.push_back(arc.frame.origin + arc.frame.page(on));
  }
  return places;
}

// Whether the ink is there all along, by the discs of its skeleton.
bool TangleFinder::isWithinInk(const TangleArc& arc, const TangleEnd& p, const TangleEnd& q) const {
  return std::ranges::all_of(coursePlaces(arc, p, q), [&](const Vec2& at) {
    return std::ranges::any_of(ink_, [&](const StrokePathPoint& s) {
      return (s.at - at).norm() <= static_cast<double>(s.radius) + kSpeckWidths * usualWidth_ + kSpeckPx;
    });
  });
}

std::optional<TangleFinder::Crossing> TangleFinder::crossingOf(const std::pair<int, int>& one,
                                                               const std::pair<int, int>& other) const {
  const TangleArc &arc = arcs_.at(one), &crossed = arcs_.at(other);
  std::optional<bool> wasLeft;
  for (const Vec2& at : coursePlaces(arc, ends_[one.first], ends_[one.second])) {
    const Vec2 local = crossed.frame.local(at), across = crossed.arc.normalAt(local);
    const bool isLeft = across.dot(crossed.arc.toArc(local)) > 0.0;
    if (wasLeft && *wasLeft != isLeft) {
      const Vec2 own = arc.frame.page(arc.arc.normalAt(arc.frame.local(at))), its = crossed.frame.page(across);
      return Crossing{at, own, std::tan(0.5 * std::asin(std::min(1.0, std::abs(cross(own, its)))))};
    }
    wasLeft = isLeft;
  }
  return std::nullopt;
}

// Where two strokes cross one lies on the other: ink that is wider there than the wider of them and what runs beside
// holds both side by side.
bool TangleFinder::mayCross(const std::vector<std::pair<int, int>>& pairs) const {
  const auto areSideBySide = [&](const std::pair<int, int>& one, const std::pair<int, int>& other) {
    const std::optional<Crossing> crossing = crossingOf(one, other);
    if (!crossing) return false;
    const Vec2& at = crossing->at;
    const auto [thinner, wider] = std::minmax({arcs_.at(one).widthPx, arcs_.at(other).widthPx});
    double low = -0.5 * wider, high = 0.5 * wider;
    for (const std::pair<int, int>& beside : pairs) {
      const TangleArc& arc = arcs_.at(beside);
      if (beside == one || beside == other || arc.distance(at) > 0.5 * (arc.widthPx + wider) + thinner) continue;
      const double away = crossing->across.dot(arc.frame.page(arc.arc.toArc(arc.frame.local(at))));
      low = std::min(low, away - 0.5 * arc.widthPx);
      high = std::max(high, away + 0.5 * arc.widthPx);
    }
    // At larger angles the ink is soon wider.
    const double reach = std::min(wider, 0.5 * kLyingShare * thinner / std::max(1e-9, crossing->halfTangent));
    std::vector<float> radii;
    for (const StrokePathPoint& s : ink_)
      if ((s.at - at).norm() <= reach) radii.push_back(s.radius);
    const double most = high - low + kLyingShare * thinner + kGridOfWidthPx;
    return crossing->halfTangent <= kSideBySideHalf && !radii.empty() &&
           2.0 * static_cast<double>(elementOfRank(radii, std::ssize(radii) / 4)) > most;
  };
  for (auto one = pairs.begin(); one != pairs.end(); ++one)
    if (std::any_of(pairs.begin(), one, [&](const auto& other) { return areSideBySide(*one, other); })) return false;
  return true;
}

std::optional<TangleArc> TangleFinder::arcOf(const TangleEnd& p, const TangleEnd& q) const {
  const Vec2 along = q.points.front() - p.points.front();
  if (!(along.norm() > 0.0) || turnDeg(-p.out, q.out) > kMostTurnDeg) return std::nullopt;
  if (along.dot(p.out) > 0.0 || along.dot(q.out) < 0.0) return std::nullopt;  // they lie the wrong way round
  TangleArc found;
  found.frame = {0.5 * (p.points.front() + q.points.front()), along.normalized()};
  const std::vector<Vec2> a = localPoints(found.frame, p.points), b = localPoints(found.frame, q.points);
  const std::optional<LocalArc> arc = arcThrough(a, b);
  if (!arc) return std::nullopt;
  found.arc = *arc;
  found.widthPx = 0.5 * (p.width + q.width);
  const double wider = 0.5 * (p.width - q.width);
  found.left = 0.5 * (squaresLeft(*arc, a) + squaresLeft(*arc, b)) + wider * wider;
  const double most = mostLeftPx(found.widthPx);
  if (!(found.left <= most * most) || !isWithinInk(found, p, q)) return std::nullopt;
  const double turn = kTurnWidths * found.widthPx * turnDeg(-p.out, q.out) * kRadPerDeg;
  found.cost = found.left + turn * turn;
  return found;
}

// All ways to pair the ends from `from` on, of which `open` stay alone.
void TangleFinder::match(int from, double sum, int open) {
  const int n = static_cast<int>(ends_.size());
  while (from < n && used_[from]) ++from;
  if (from == n) {
    if (sum < bestSum_) {
      nextSum_ = bestSum_;
      bestSum_ = sum;
      best_ = now_;
    } else {
      nextSum_ = std::min(nextSum_, sum);
    }
    return;
  }
  for (int other = from + 1; other < n; ++other) {
    const auto arc = arcs_.find({from, other});
    if (used_[other] || arc == arcs_.end()) continue;
    used_[other] = true;
    now_.emplace_back(from, other);
    match(from + 1, sum + arc->second.cost, open);
    now_.pop_back();
    used_[other] = false;
  }
  if (open > 0) {
    used_[from] = true;
    match(from + 1, sum, open - 1);
    used_[from] = false;
  }
}

bool TangleFinder::explainsAll(const std::vector<std::pair<int, int>>& pairs) const {
  return std::ranges::all_of(ink_, [&](const StrokePathPoint& s) {
    return std::ranges::any_of(pairs, [&](const std::pair<int, int>& pair) {
      const TangleArc& arc = arcs_.at(pair);
      return arc.distance(s.at) <= kExplainedWidths * arc.widthPx;
    });
  });
}

// Whether a long edge that looks like common ink is: two strokes lie on one another there, or it is a stretch of one
// that is no bolder than usual, between two crossings. Of a bold stroke it would be the own middle.
bool TangleFinder::isOfTwo(int edge, const std::vector<std::pair<int, int>>& pairs) const {
  const SkeletonEdge& e = graph_.edge(edge);
  if (!isCommonInk(edge) || e.length <= kLongWidths * 2.0 * graph_.meanRadius(edge)) return true;
  const Vec2 middle = e.points[e.points.size() / 2].at;
  double widest = 0.0;
  int strokes = 0;
  for (const std::pair<int, int>& pair : pairs) {
    const TangleArc& arc = arcs_.at(pair);
    if (arc.distance(middle) > kExplainedWidths * arc.widthPx) continue;
    widest = std::max(widest, arc.widthPx);
    ++strokes;
  }
  if (strokes >= 2) return 2.0 * graph_.meanRadius(edge) >= kTwoStrokes * widest;
  return e.length <= kAloneWidths * usualWidth_ && widest <= kBold * usualWidth_;
}

bool TangleFinder::tellStrokes(Tangle& tangle) {
  ends_.clear();
  ink_.clear();
  arcs_.clear();
  Vec2 low = graph_.node(tangle.nodes.front()).centre, high = low;
  for (const int node : tangle.nodes) {
    low = low.cwiseMin(graph_.node(node).centre);
    high = high.cwiseMax(graph_.node(node).centre);
  }
  for (const int edge : tangle.inner)
    ink_.insert(ink_.end(), graph_.edge(edge).points.begin(), graph_.edge(edge).points.end());
  for (const int end : tangle.outer) {
    std::optional<TangleEnd> measured = measure(end, (high - low).norm());
    if (!measured) return false;
    // Up to where the stroke is alone the ink is common too.
    const EdgeFromEnd points(graph_.edge(end / 2).points, end % 2);
    for (int k = 0; k < points.size(); ++k) {
      ink_.push_back(points[k]);
      if (points[k].at == measured->points.front()) break;
    }
    ends_.push_back(std::move(*measured));
  }
  const int n = static_cast<int>(ends_.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (std::optional<TangleArc> arc = arcOf(ends_[a], ends_[b])) arcs_.emplace(std::pair(a, b), std::move(*arc));
  used_.assign(n, false);
  now_.clear();
  best_.clear();
  bestSum_ = nextSum_ = std::numeric_limits<double>::infinity();
  match(0, 0.0, n % 2);
  if (!std::isfinite(bestSum_) || !explainsAll(best_) || !mayCross(best_)) return false;
  if (!std::ranges::all_of(tangle.inner, [&](int edge) { return isOfTwo(edge, best_); })) return false;
  tangle.isDoubtful = nextSum_ < kClearSquares * bestSum_;
  for (const auto& [a, b] : best_) tangle.strokes.emplace_back(ends_[a].end, ends_[b].end);
  for (const TangleEnd& end : ends_) {
    const SkeletonNode& node = graph_.node(*graph_.edge(end.end / 2).node[end.end % 2]);
    tangle.discs.push_back(
        {node.centre, std::max(node.radius, (end.points.front() - node.centre).norm() / kTrimRadii)});
  }
  return true;
}

std::vector<Tangle> TangleFinder::find() {
  std::vector<Tangle> tangles = clusters();
  std::erase_if(tangles, [&](Tangle& tangle) { return !tellStrokes(tangle); });
  return tangles;
}

}  // namespace

std::vector<Tangle> findTangles(const SkeletonGraph& graph) { return TangleFinder(graph).find(); }

}  // namespace batten
