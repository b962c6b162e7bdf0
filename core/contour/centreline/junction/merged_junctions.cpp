// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/merged_junctions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/segment_foot.h"
#include "core/contour/centreline/junction/shared_ink.h"
#include "core/contour/centreline/junction/tangles.h"
#include "core/contour/centreline/skeleton/skeleton_graph.h"

namespace batten {
namespace {

constexpr double kSharedWidth = 1.1;      // of a single stroke
constexpr double kTwoStrokesWidth = 1.4;  // of a single stroke: between 1 where two cross and 2 where they part
constexpr double kTouchingShare = 1.5;    // how much longer than lines that cross do those that touch lie together
constexpr double kCrossingEdges = 1.5;    // of what they share: shorter edges are those of a bundle
// [mean radii] Of shared ink, off its chord: where it bends more, what leads straight through it would leave it.
constexpr double kMostSag = 1.0;
constexpr double kLeavingWidths = 4.0;  // [stroke widths] over which the direction of an edge is taken
constexpr double kOnwardCos = 0.7;      // 45 degrees: what turns more at a link does not go on through it
constexpr double kOneJunction = 1.5;    // of the radii of two junctions: nearer ones are one crossing
constexpr double kFaceRadii = 0.6;      // [median radii] of paper: narrower is a fault in the ink, not a face
constexpr double kWithinDisc = 1.1;     // of its radius: what stays within is part of the junction

class JunctionMerger {
 public:
  JunctionMerger(SkeletonGraph& graph, JunctionsOf of)
      : graph_(graph),
        of_(of),
        sets_(graph.nodeCount()),
        shared_(graph.edgeCount()),
        isInTangle_(graph.nodeCount(), false),
        isLink_(graph.edgeCount(), false),
        isInner_(graph.edgeCount(), false) {}
  void merge(std::span<const JunctionChoice> choices);

 private:
  using Link = std::pair<double, int>;  // length [px], edge

  double sharedLength(int link) const;
  JunctionDisc discOf(const std::vector<int>& nodes) const;
  bool isOneCrossing(const std::vector<int>& nodes) const;
  bool holdsPaper(const std::vector<int>& nodes, int link) const;
  double paperWidth(int edge, const std::vector<int>& others) const;
  std::vector<Link> shortLinks();
  std::vector<int> joinLinked(const std::vector<Link>& links);
  void moveToDiscs();
  void leadThrough(const SharedInk& shared, int node);
  void leadThrough(const Tangle& tangle, int node);
  void dropWithinDiscs();
  void noteNarrowest(const std::vector<int>& inner);

  bool isOfBundles() const { return of_ == JunctionsOf::Bundles; }

  SkeletonGraph& graph_;
  JunctionsOf of_;
  DisjointSets sets_;                             // of nodes that become one
  std::vector<std::optional<SharedInk>> shared_;  // per edge
  std::vector<bool> isInTangle_;                  // per node
  std::vector<bool> isLink_, isInner_;            // per edge: short enough to be within one junction; within one
};

// [px] How long two strokes that cross or touch at the angle seen at both ends of a link can share one skeleton; 0: the
// link is no such place.
double JunctionMerger::sharedLength(int link) const {
  const SkeletonEdge& l = graph_.edge(link);
  double angle = 0.0, others = 0.0;
  bool isFree = true;
  for (int side = 0; side < 2; ++side) {
    const SkeletonNode& n = graph_.node(*l.node[side]);
    if (n.ends.size() != 3) return 0.0;
    for (const int end : n.ends) {
      if (end / 2 == link) continue;
      others += 0.25 * graph_.meanRadius(end / 2);
      isFree = isFree && graph_.edge(end / 2).length >= kCrossingEdges * l.length;
    }
  }
  // Of strokes that cross alone, from border to border: the middle of an even number of pixels lies half a pixel off.
  const double own = 2.0 * others + 1.0, width = isFree ? own : std::min(own, 2.0 * graph_.medianRadius());
  for (int side = 0; side < 2; ++side) {
    const SkeletonNode& n = graph_.node(*l.node[side]);
    const double reach = kLeavingWidths * width + n.radius;
    Vec2 inward = Vec2::Zero(), out[2];
    int k = 0;
    for (const int end : n.ends) {
      const Vec2 d = leavingDirection(graph_.edge(end / 2), end % 2, n.centre, reach);
      if (end == 2 * link + side) {
        inward = d;
      } else if (k < 2) {
        out[k++] = d;
      }
    }
    if (k != 2 || inward.dot(out[0]) > -kOnwardCos || inward.dot(out[1]) > -kOnwardCos) return 0.0;
    angle += 0.5 * std::acos(std::clamp(out[0].dot(out[1]), -1.0, 1.0));
  }
  // Two strokes that part on either side are wider than one; a line between two things that hang on it is not.
  if (graph_.meanRadius(link) < kSharedWidth * others) return 0.0;
  constexpr double kLeast = 0.2, kMost = 1.05;  // 12 and 60 degrees
  const double touching = isFree && graph_.meanRadius(link) >= kTwoStrokesWidth * others ? kTouchingShare : 1.0;
  return angle > kMost ? 0.0 : touching * 2.0 * width / std::sin(0.5 * std::max(kLeast, angle));
}

// [px] Farthest from the chord.
double sagOf(const SkeletonEdge& edge) {
  double sag = 0.0;
  for (const StrokePathPoint& p : edge.points)
    sag = std::max(sag, footOnSegment(p.at, edge.points.front().at, edge.points.back().at).away.norm());
  return sag;
}

bool isWithin(const SkeletonEdge& edge, const JunctionDisc& disc) {
  return std::ranges::all_of(
      edge.points, [&](const StrokePathPoint& p) { return (p.at - disc.centre).norm() <= kWithinDisc * disc.radius; });
}

// The disc that holds the discs of all these nodes, around their mean.
JunctionDisc JunctionMerger::discOf(const std::vector<int>& nodes) const {
  JunctionDisc disc;
  for (const int n : nodes) disc.centre += graph_.node(n).centre;
  disc.centre /= static_cast<double>(nodes.size());
  for (const int n : nodes)
    disc.radius = std::max(disc.radius, (graph_.node(n).centre - disc.centre).norm() + graph_.node(n).radius);
  return disc;
}

// Whether one disc not much larger than theirs holds these nodes: else they are a small drawing and no crossing.
bool JunctionMerger::isOneCrossing(const std::vector<int>& nodes) const {
  constexpr double kMostReach = 2.5;  // of the largest radius
  double largest = 0.0;
  for (const int n : nodes) largest = std::max(largest, graph_.node(n).radius);
  return discOf(nodes).radius <= kMostReach * largest + 1.0;
}

// [px] Width of the paper between an edge and these others, where it is widest.
double JunctionMerger::paperWidth(int edge, const std::vector<int>& others) const {
  double widest = 0.0;
  for (const StrokePathPoint& p : graph_.edge(edge).points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int other : others) {
      for (const StrokePathPoint& q : graph_.edge(other).points)
        nearest = std::min(nearest, (p.at - q.at).norm() - static_cast<double>(p.radius + q.radius));
    }
    widest = std::max(widest, nearest);
  }
  return widest;
}

// Whether these nodes, joined by a link, have paper in their midst: an edge that would be lost in their disc was drawn
// around it, as the bow of an e, or edges on both sides of the link, as of a ring that a bar parts. In the middle of an
// 8 the link is shorter than the ink is broad.
bool JunctionMerger::holdsPaper(const std::vector<int>& nodes, int link) const {
  const JunctionDisc disc = discOf(nodes);
  const auto isMember = [&](std::optional<int> n) { return n && std::ranges::find(nodes, *n) != nodes.end(); };
  std::vector<int> within{link}, between;
  for (const int n : nodes) {
    for (const int end : graph_.node(n).ends) {
      const int i = end / 2;
      const SkeletonEdge& e = graph_.edge(i);
      if (i == link || end % 2 != 0 || !isMember(e.node[0]) || !isMember(e.node[1])) continue;
      (isInner_[i] ? within : between).push_back(i);
    }
  }
  const SkeletonEdge& l = graph_.edge(link);
  const bool isBar = l.length > graph_.node(*l.node[0]).radius + graph_.node(*l.node[1]).radius + 1.0;
  int around = 0;
  for (const int e : between) {
    if (paperWidth(e, within) < kFaceRadii * graph_.medianRadius()) continue;
    ++around;
    if (isLink_[e] || isWithin(graph_.edge(e), disc) || (isBar && around == 2)) return true;
  }
  return false;
}

// Edges between junctions that may be one, the shortest first.
std::vector<JunctionMerger::Link> JunctionMerger::shortLinks() {
  std::vector<Link> links;
  for (int i = 0; i < graph_.edgeCount(); ++i) {
    const SkeletonEdge& l = graph_.edge(i);
    if (!l.alive || l.ring) continue;
    const SkeletonNode &a = graph_.node(*l.node[0]), &b = graph_.node(*l.node[1]);
    if (a.ends.size() < 3 || b.ends.size() < 3) continue;
    if (isInTangle_[*l.node[0]] || isInTangle_[*l.node[1]]) continue;
    shared_[i] = isOfBundles() ? std::nullopt : findSharedInk(graph_, i);
    isLink_[i] = shared_[i] || liesInDiscs(l, a, b) ||
                 (l.length <= sharedLength(i) && sagOf(l) <= kMostSag * graph_.meanRadius(i));
    if (isLink_[i]) links.emplace_back(l.length, i);
  }
  std::sort(links.begin(), links.end());
  return links;
}

// Joins the nodes of these links as long as they are a crossing: all of a small drawing could be one.
// @return the links that lie within one of the sets then.
std::vector<int> JunctionMerger::joinLinked(const std::vector<Link>& links) {
  // Of each set, at its root.
  std::vector<std::vector<int>> members(graph_.nodeCount());
  std::vector<int> inner, outerEnds;
  for (int i = 0; i < graph_.nodeCount(); ++i) {
    members[i] = {i};
    outerEnds.push_back(static_cast<int>(graph_.node(i).ends.size()));
  }
  for (const auto& [length, link] : links) {
    const int a = sets_.root(*graph_.edge(link).node[0]), b = sets_.root(*graph_.edge(link).node[1]);
    if (a != b) {
      // Where four strokes leave each of them they are two crossings of a hatching.
      const bool areWhole = std::min(outerEnds[a], outerEnds[b]) >= 4;
      if (!isOfBundles() && areWhole && length > std::max(graph_.node(a).radius, graph_.node(b).radius)) continue;
      std::vector<int> all = members[a];
      all.insert(all.end(), members[b].begin(), members[b].end());
      if (!isOfBundles() && all.size() > 2 && !isOneCrossing(all)) continue;
      if (of_ == JunctionsOf::Pen && holdsPaper(all, link)) continue;
      sets_.join(a, b);
      members[sets_.root(a)] = std::move(all);
      outerEnds[sets_.root(a)] = outerEnds[a] + outerEnds[b];
    }
    outerEnds[sets_.root(a)] -= 2;
    inner.push_back(link);
    isInner_[link] = true;
  }
  return inner;
}

// Each set becomes its root: at the mean of its nodes, with the disc that holds the discs of all of them.
void JunctionMerger::moveToDiscs() {
  const int count = graph_.nodeCount();
  std::vector<std::vector<int>> members(count);  // of each set, at its root
  for (int i = 0; i < count; ++i) members[sets_.root(i)].push_back(i);
  for (int root = 0; root < count; ++root) {
    if (members[root].empty()) continue;
    const JunctionDisc disc = discOf(members[root]);
    SkeletonNode& node = graph_.node(root);
    for (const int i : members[root]) {
      if (i == root) continue;
      for (const int end : graph_.node(i).ends) {
        graph_.edge(end / 2).node[end % 2] = root;
        node.ends.push_back(end);
      }
      graph_.node(i).ends.clear();
    }
    node.centre = disc.centre;
    node.radius = disc.radius;
    std::sort(node.ends.begin(), node.ends.end());
  }
}

// What lies wholly within one disc is no stroke.
void JunctionMerger::dropWithinDiscs() {
  for (int i = 0; i < graph_.edgeCount(); ++i) {
    const SkeletonEdge& l = graph_.edge(i);
    if (!l.alive || l.ring || l.node[0] != l.node[1]) continue;
    const SkeletonNode& n = graph_.node(*l.node[0]);
    if (n.leading() != nullptr) continue;
    if (isWithin(l, {n.centre, n.radius})) graph_.removeEdge(i);
  }
}

// The strokes of shared ink, where no other junction became part of its node.
void JunctionMerger::leadThrough(const SharedInk& shared, int node) {
  SkeletonNode& n = graph_.node(node);
  LedThrough led;
  led.discs.resize(4);
  if (n.ends.size() != led.discs.size()) return;
  const auto indexOf = [&](int end) { return static_cast<int>(std::ranges::find(n.ends, end) - n.ends.begin()); };
  for (const auto& [from, to] : shared.strokes) {
    const int a = indexOf(from), b = indexOf(to);
    if (std::max(a, b) == std::ssize(n.ends)) return;
    led.pairs.emplace_back(std::min(a, b), std::max(a, b));
    led.discs[a] = shared.discs[0];
    led.discs[b] = shared.discs[1];
  }
  std::sort(led.pairs.begin(), led.pairs.end());
  led.isDoubtful = shared.isDoubtful;
  n.led = std::move(led);
}

void JunctionMerger::leadThrough(const Tangle& tangle, int node) {
  SkeletonNode& n = graph_.node(node);
  if (n.ends != tangle.outer) return;
  LedThrough led;
  led.discs = tangle.discs;
  led.isDoubtful = tangle.isDoubtful;
  const auto indexOf = [&](int end) { return static_cast<int>(std::ranges::find(n.ends, end) - n.ends.begin()); };
  for (const auto& [from, to] : tangle.strokes) led.pairs.emplace_back(std::minmax(indexOf(from), indexOf(to)));
  std::sort(led.pairs.begin(), led.pairs.end());
  n.led = std::move(led);
}

// How narrow the ink is within each set.
void JunctionMerger::noteNarrowest(const std::vector<int>& inner) {
  for (const int edge : inner) {
    std::optional<double>& narrowestPx = graph_.node(sets_.root(*graph_.edge(edge).node[0])).narrowestPx;
    const double radius = graph_.narrowRadius(edge);
    narrowestPx = narrowestPx ? std::min(*narrowestPx, radius) : radius;
  }
}

void JunctionMerger::merge(std::span<const JunctionChoice> choices) {
  std::vector<Tangle> tangles;
  if (!isOfBundles()) tangles = findTangles(graph_);
  const auto isChosen = [&](const Vec2& at) {
    return std::ranges::any_of(
        choices, [&](const JunctionChoice& choice) { return (choice.positionPx - at).norm() <= choice.reachPx; });
  };
  std::erase_if(tangles, [&](const Tangle& tangle) {
    return std::ranges::any_of(tangle.nodes, [&](int node) { return isChosen(graph_.node(node).centre); }) ||
           std::ranges::any_of(tangle.inner, [&](int edge) {
             return std::ranges::any_of(graph_.edge(edge).points, isChosen, &StrokePathPoint::at);
           });
  });
  for (const Tangle& tangle : tangles)
    for (const int node : tangle.nodes) isInTangle_[node] = true;
  std::vector<int> inner = joinLinked(shortLinks());
  for (const Tangle& tangle : tangles) {
    for (const int node : tangle.nodes) sets_.join(tangle.nodes.front(), node);
    inner.insert(inner.end(), tangle.inner.begin(), tangle.inner.end());
  }
  noteNarrowest(inner);
  std::vector<std::pair<int, int>> sharedAt;  // edge, node
  for (const int edge : inner) {
    if (shared_[edge]) sharedAt.emplace_back(edge, *graph_.edge(edge).node[0]);
    graph_.removeEdge(edge);
  }
  moveToDiscs();
  for (const auto& [edge, node] : sharedAt) leadThrough(*shared_[edge], sets_.root(node));
  for (const Tangle& tangle : tangles) leadThrough(tangle, sets_.root(tangle.nodes.front()));
  dropWithinDiscs();
  for (int i = 0; i < graph_.nodeCount(); ++i) graph_.splice(i);
}

}  // namespace

bool liesInDiscs(const SkeletonEdge& edge, const SkeletonNode& a, const SkeletonNode& b) {
  return edge.length <= kOneJunction * (a.radius + b.radius) + 1.0;
}

void mergeJunctions(SkeletonGraph& graph, JunctionsOf of, std::span<const JunctionChoice> choices) {
  JunctionMerger(graph, of).merge(choices);
}

}  // namespace batten
