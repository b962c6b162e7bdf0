// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/skeleton/skeleton_spurs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "core/contour/centreline/skeleton/skeleton_graph.h"

namespace batten {
namespace {

constexpr double kFatCorner = 1.15;        // of the usual radius: the ink inside an acute corner is fatter
constexpr double kCornerSpur = 5.0 / 3.0;  // of a spur: so much longer is the branch to the tip of an acute corner
constexpr double kWidestTip = 2.5;         // of the usual radius: two strokes side by side, and no blot
constexpr double kStrokeBreadth = 0.7;     // of its neighbours' radius: the branch to a corner of 70 degrees has less
constexpr double kStrokeOut = 0.8;         // of a spur's length: a stroke stands out of the ink it leaves by so much
constexpr double kLeastEdgeWidths = 3.0;   // [stroke widths] shorter edges have no direction
// Out of the disc and as far again; 3 px keep a single step of a skeleton below 20 degrees where strokes are thin.
constexpr double kCornerReachRadii = 2.0, kCornerReachPx = 3.0;
constexpr double kAcute = 0.26;                      // cos 75 deg
constexpr double kTipSlack = 1.25, kRadiusPx = 0.5;  // of the branch to a tip; to which a radius is known

// [px] Length of the branch to the tip of a sharp turn of a stroke of this radius. It begins where a disc of radius
// `inside` touches both outer borders and the notch between the inner ones, which sets the angle; there the ink falls
// to the stroke's own radius at the turning point, and the branch ends on the border at most.
double branchToTip(double inside, double stroke) {
  if (inside >= 2.0 * stroke) return std::numeric_limits<double>::infinity();  // the sides lie on one another
  return std::max(0.0, inside - stroke) * inside / (2.0 * stroke - inside) + stroke;
}

class SpurPruner {
 public:
  explicit SpurPruner(SkeletonGraph& graph) : graph_(graph) {}
  void prune(double factor);

 private:
  std::optional<int> spurTip(int edge, double factor) const;
  bool closesCorner(int edge, int node) const;
  bool isBeyondTip(int edge, int node) const;
  bool isStroke(int edge, int tip, double factor) const;
  void markCorner(int edge, int side, const Vec2& centre, double reach);
  void leadToTip(int edge, int side, const Vec2& tip, double reach);
  Vec2 turningPoint(int spur, int tipSide) const;

  SkeletonGraph& graph_;
};

// A sharp turn of one stroke: the two other edges lie close together and the branch points out between them.
bool SpurPruner::closesCorner(int edge, int node) const {
  const SkeletonNode& n = graph_.node(node);
  if (n.ends.size() != 3) return false;
  const double reach = kCornerReachRadii * n.radius + kCornerReachPx;
  Vec2 spur = Vec2::Zero(), other[2];
  int k = 0;
  for (const int end : n.ends) {
    const Vec2 d = leavingDirection(graph_.edge(end / 2), end % 2, n.centre, reach);
    if (end / 2 == edge) {
      spur = d;
    } else if (k < 2) {
      other[k++] = d;
    }
  }
  if (k != 2) return false;
  return other[0].dot(other[1]) > kAcute && spur.dot(other[0] + other[1]) < 0.0;
}

// Whether a branch goes farther than to the tip of a sharp turn there, as the leg of an A below its bar.
bool SpurPruner::isBeyondTip(int edge, int node) const {
  double radius = std::numeric_limits<double>::infinity();  // of the sides
  for (const int end : graph_.node(node).ends)
    if (end / 2 != edge) radius = std::min(radius, graph_.meanRadius(end / 2));
  return graph_.edge(edge).length > kTipSlack * branchToTip(graph_.node(node).radius + kRadiusPx, radius) + 1.0;
}

// A short stroke, as the stem of a letter beyond its bowl: it stands out of the ink of the others as broad as they are,
// while the branch to a corner or a bump of a border grows narrow before it is out.
bool SpurPruner::isStroke(int edge, int tip, double factor) const {
  const SkeletonEdge& l = graph_.edge(edge);
  const SkeletonNode& n = graph_.node(*l.node[1 - tip]);
  double usual = graph_.medianRadius();
  int longEdges = 0;
  for (const int end : n.ends) {
    if (end / 2 == edge) continue;
    const double radius = graph_.meanRadius(end / 2);
    if (graph_.edge(end / 2).length >= kLeastEdgeWidths * 2.0 * radius) ++longEdges;
    usual = std::min(usual, radius);
  }
  // Where it leaves one line, that may end nearby, as in a letter; around a mesh of a net or a hole of the grain all
  // edges are short.
  const int others = static_cast<int>(n.ends.size()) - 1;
  if (longEdges < (others == 2 ? 1 : others)) return false;
  double out = 0.0;
  for (const StrokePathPoint& p : l.points) {
    const double radius = static_cast<double>(p.radius);
    if (radius >= kStrokeBreadth * usual) out = std::max(out, (p.at - n.centre).norm() + radius - n.radius);
  }
  return out >= kStrokeOut * factor * 2.0 * usual;
}

// The side of an edge at which it ends free, if it is a spur.
std::optional<int> SpurPruner::spurTip(int edge, double factor) const {
  const SkeletonEdge& l = graph_.edge(edge);
  if (!l.alive || l.ring || l.node[0] == l.node[1]) return std::nullopt;
  const bool tips[2] = {graph_.node(*l.node[0]).ends.size() == 1, graph_.node(*l.node[1]).ends.size() == 1};
  if (tips[0] == tips[1]) return std::nullopt;
  const int tip = tips[0] ? 0 : 1, junction = *l.node[1 - tip];
  const double r = graph_.node(junction).radius, rw = graph_.medianRadius() + 0.5;
  const double width = 2.0 * std::min(r, 2.0 * rw);
  if (l.length <= factor * width + 1.0) {
    const bool isTip = closesCorner(edge, junction) && !isBeyondTip(edge, junction);
    const bool isKept = isStroke(edge, tip, factor) && !isTip;
    return isKept ? std::nullopt : std::optional(tip);
  }
  // An acute corner is fat inside and has a long branch to its tip.
  const bool isCorner =
      r > kFatCorner * rw && l.length <= factor * kCornerSpur * width + 1.0 && closesCorner(edge, junction);
  return isCorner ? std::optional(tip) : std::nullopt;
}

void SpurPruner::markCorner(int edge, int side, const Vec2& centre, double reach) {
  std::vector<StrokePathPoint>& p = graph_.edge(edge).points;
  const int n = static_cast<int>(p.size());
  for (int k = 0; k < n; ++k) {
    StrokePathPoint& point = p[side == 0 ? k : n - 1 - k];
    if ((point.at - centre).norm() > reach) break;
    point.part = StrokePart::Corner;
  }
}

// An edge that ends where two sides of an acute corner become one body of ink goes straight on to the tip instead: what
// it has within `reach` of its end is pulled to the other side.
void SpurPruner::leadToTip(int edge, int side, const Vec2& tip, double reach) {
  std::vector<StrokePathPoint>& p = graph_.edge(edge).points;
  if (side == 0) std::reverse(p.begin(), p.end());
  const Vec2 end = p.back().at;
  while (p.size() > 1 && (p.back().at - end).norm() <= reach) p.pop_back();
  const Vec2 from = p.back().at;
  const int steps = static_cast<int>(std::ceil((tip - from).norm()));
  for (int k = 1; k <= steps; ++k)
    p.push_back({from + (tip - from) * k / steps, static_cast<float>(graph_.medianRadius()), StrokePart::Corner});
  if (side == 0) std::reverse(p.begin(), p.end());
  graph_.edge(edge).length = strokePathLength(p, false);
}

// Where the pen turned at the tip of an acute corner: a spur ends there or nearer to the border of the ink.
Vec2 SpurPruner::turningPoint(int spur, int tipSide) const {
  const std::vector<StrokePathPoint>& p = graph_.edge(spur).points;
  const int n = static_cast<int>(p.size());
  const StrokePathPoint& last = tipSide == 1 ? p.back() : p.front();
  const double beyond =
      std::clamp(graph_.medianRadius() - static_cast<double>(last.radius), 0.0, graph_.edge(spur).length);
  double arc = 0.0;
  for (int k = 1; k < n; ++k) {
    const Vec2& at = p[tipSide == 1 ? n - 1 - k : k].at;
    arc += (at - p[tipSide == 1 ? n - k : k - 1].at).norm();
    if (arc >= beyond) return beyond > 0.0 ? at : last.at;
  }
  return last.at;
}

void SpurPruner::prune(double factor) {
  if (!(factor > 0.0)) return;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](int edge) {
    if (spurTip(edge, factor)) queue.emplace(graph_.edge(edge).length, edge);
  };
  for (int i = 0; i < graph_.edgeCount(); ++i) offer(i);
  while (!queue.empty()) {
    const auto [length, edge] = queue.top();
    queue.pop();
    if (!graph_.edge(edge).alive || graph_.edge(edge).length != length) continue;
    const std::optional<int> tip = spurTip(edge, factor);
    if (!tip) continue;
    const int node = *graph_.edge(edge).node[1 - *tip];
    const bool corner = closesCorner(edge, node);
    const Vec2 turning = turningPoint(edge, *tip);
    graph_.removeEdge(edge);
    SkeletonNode& n = graph_.node(node);
    if (corner) {
      const double reach = n.radius + 2.0 * graph_.medianRadius();
      const bool isTip = n.radius <= kWidestTip * (graph_.medianRadius() + 0.5) &&
                         std::all_of(n.ends.begin(), n.ends.end(), [&](int end) {
                           return graph_.edge(end / 2).length >= kLeastEdgeWidths * 2.0 * graph_.medianRadius();
                         });
      for (const int end : n.ends) {
        if (isTip) {
          leadToTip(end / 2, end % 2, turning, reach);
        } else {
          markCorner(end / 2, end % 2, n.centre, reach);
        }
      }
      if (isTip) n.centre = turning;
    }
    const std::vector<int> ends = n.ends;
    graph_.splice(node);
    for (const int end : ends) offer(end / 2);
  }
}

}  // namespace

void pruneSpurs(SkeletonGraph& graph, double factor) { SpurPruner(graph).prune(factor); }

}  // namespace batten
