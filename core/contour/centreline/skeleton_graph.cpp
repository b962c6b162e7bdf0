// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/skeleton_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <unordered_map>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kSharedWidth = 1.1;       // of a single stroke
constexpr double kTwoStrokesWidth = 1.4;   // of a single stroke: between 1 where two cross and 2 where they part
constexpr double kTouchingShare = 1.5;     // how much longer than lines that cross do those that touch lie together
constexpr double kCrossingLegs = 1.5;      // of what they share: shorter legs are those of a bundle
constexpr double kFatCorner = 1.15;        // of the usual radius: the ink inside an acute corner is fatter
constexpr double kCornerSpur = 5.0 / 3.0;  // of a spur: so much longer is the branch to the tip of an acute corner
constexpr double kWidestTip = 2.5;         // of the usual radius: two strokes side by side, and no blot
constexpr double kLeastLegWidths = 3.0;    // [stroke widths] shorter legs have no direction
constexpr double kLeavingWidths = 4.0;     // [stroke widths] over which the direction of an edge is taken
constexpr double kOnwardCos = 0.7;         // 45 degrees: what turns more at a link does not go on through it
constexpr double kOneJunction = 1.5;       // of the radii of two junctions: nearer ones are one crossing
constexpr double kWithinDisc = 1.1;        // of its radius: what stays within is part of the junction
// Out of the disc and as far again; 3 px keep a single step of a skeleton below 20 degrees where strokes are thin.
constexpr double kCornerReachRadii = 2.0, kCornerReachPx = 3.0;
constexpr double kAcute = 0.26;  // cos 75 deg

double lengthOf(const std::vector<StrokePathPoint>& points, bool closed) {
  double sum = 0.0;
  for (int i = 1; i < std::ssize(points); ++i) sum += (points[i].at - points[i - 1].at).norm();
  if (closed && points.size() > 1) sum += (points.front().at - points.back().at).norm();
  return sum;
}

// Sets of indices that belong together.
class Groups {
 public:
  explicit Groups(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

// Node pixels of all chains, numbered in order of appearance; those side by side are one node.
struct NodePixels {
  std::unordered_map<std::int64_t, int> number;
  std::vector<SkeletonPixel> pixels;
  int of(const SkeletonPixel& p) {
    const std::int64_t key = (static_cast<std::int64_t>(p.y) << 32) | static_cast<std::int64_t>(p.x);
    const auto [it, fresh] = number.try_emplace(key, static_cast<int>(pixels.size()));
    if (fresh) pixels.push_back(p);
    return it->second;
  }
};

bool isLink(const SkeletonChain& c) { return !c.closed && c.pixels.size() == 2 && !c.freeStart && !c.freeEnd; }

// Direction in which an edge leaves its end `side`: of the chord of about `reach` px from there.
Vec2 leaving(const SkeletonEdge& edge, int side, const Vec2& from, double reach) {
  const int n = static_cast<int>(edge.points.size());
  Vec2 at = from;
  for (int k = 0; k < n; ++k) {
    at = edge.points[side == 0 ? k : n - 1 - k].at;
    if ((at - from).norm() >= reach) break;
  }
  const Vec2 d = at - from;
  return d.norm() > 0.0 ? Vec2(d / d.norm()) : Vec2::Zero();
}

}  // namespace

SkeletonGraph::SkeletonGraph(const std::vector<SkeletonChain>& chains, const BitImage& ink) {
  NodePixels pixels;
  for (const SkeletonChain& c : chains) {
    if (c.closed) continue;
    pixels.of(c.pixels.front());
    pixels.of(c.pixels.back());
  }
  Groups groups(static_cast<int>(pixels.pixels.size()));
  for (const SkeletonChain& c : chains) {
    if (isLink(c)) groups.join(pixels.of(c.pixels.front()), pixels.of(c.pixels.back()));
  }
  std::vector<int> nodeOf(pixels.pixels.size()), members;
  for (int i = 0; i < std::ssize(nodeOf); ++i) {
    const int root = groups.root(i);  // the first of its group, so that its node is known
    if (root == i) {
      nodeOf[i] = nodeCount();
      nodes_.emplace_back();
      members.push_back(0);
    } else {
      nodeOf[i] = nodeOf[root];
    }
    SkeletonNode& node = nodes_[nodeOf[i]];
    const SkeletonPixel& p = pixels.pixels[i];
    node.centre += Vec2(p.x + 0.5, p.y + 0.5);
    node.radius = std::max(node.radius, inkRadius(ink, p.x, p.y));
    ++members[nodeOf[i]];
  }
  for (int i = 0; i < nodeCount(); ++i) nodes_[i].centre /= members[i];

  std::vector<float> radii;
  for (const SkeletonChain& c : chains) {
    if (isLink(c) || c.pixels.size() < 2) continue;
    SkeletonEdge edge;
    for (const SkeletonPixel& p : c.pixels) {
      // From the pixel's centre to the border of the ink: half a pixel before the nearest paper centre.
      const auto radius = static_cast<float>(std::max(0.5, inkRadius(ink, p.x, p.y) - 0.5));
      edge.points.push_back({Vec2(p.x + 0.5, p.y + 0.5), radius, StrokePart::Ink});
      radii.push_back(radius);
    }
    edge.ring = c.closed;
    edge.length = lengthOf(edge.points, c.closed);
    const int number = edgeCount();
    if (!c.closed) {
      edge.node = {nodeOf[pixels.of(c.pixels.front())], nodeOf[pixels.of(c.pixels.back())]};
      for (const int side : {0, 1}) nodes_[*edge.node[side]].ends.push_back(2 * number + side);
    }
    edges_.push_back(std::move(edge));
  }
  if (!radii.empty()) medianRadius_ = upperMedian(radii);
  for (int i = 0; i < nodeCount(); ++i) splice(i);
}

void SkeletonGraph::reverse(int edge) {
  SkeletonEdge& l = edges_[edge];
  std::reverse(l.points.begin(), l.points.end());
  // Each end becomes the other one, where it meets its node; a loop has both ends at one node.
  std::array<int*, 2> places = {nullptr, nullptr};
  for (const int side : {0, 1}) {
    if (!l.node[side]) continue;
    std::vector<int>& ends = nodes_[*l.node[side]].ends;
    const auto found = std::find(ends.begin(), ends.end(), 2 * edge + side);
    if (found != ends.end()) places[side] = &*found;
  }
  for (const int side : {0, 1})
    if (places[side] != nullptr) *places[side] = 2 * edge + 1 - side;
  std::swap(l.node[0], l.node[1]);
}

// `from` starts where `into` ends.
void SkeletonGraph::appendEdge(int into, int from) {
  SkeletonEdge& a = edges_[into];
  SkeletonEdge& b = edges_[from];
  const bool twice = !a.points.empty() && !b.points.empty() && (a.points.back().at - b.points.front().at).norm() < 0.5;
  a.points.insert(a.points.end(), b.points.begin() + (twice ? 1 : 0), b.points.end());
  a.node[1] = b.node[1];
  for (int& end : nodes_[*a.node[1]].ends) {
    if (end == 2 * from + 1) end = 2 * into + 1;
  }
  a.length = lengthOf(a.points, false);
  b = SkeletonEdge{};
  b.alive = false;
}

void SkeletonGraph::splice(int node) {
  SkeletonNode& n = nodes_[node];
  if (n.ends.size() != 2) return;
  const int a = n.ends[0] / 2, b = n.ends[1] / 2;
  if (a == b) {
    SkeletonEdge& edge = edges_[a];
    edge.ring = true;
    edge.node = {};
    if (edge.points.size() > 1 && (edge.points.front().at - edge.points.back().at).norm() < 0.5) edge.points.pop_back();
    edge.length = lengthOf(edge.points, true);
    n.ends.clear();
    return;
  }
  if (n.ends[0] % 2 == 0) reverse(a);
  if (n.ends[1] % 2 == 1) reverse(b);
  n.ends.clear();
  appendEdge(a, b);
}

void SkeletonGraph::removeEdge(int edge) {
  SkeletonEdge& l = edges_[edge];
  for (const int side : {0, 1}) {
    if (l.node[side]) std::erase(nodes_[*l.node[side]].ends, 2 * edge + side);
  }
  l = SkeletonEdge{};
  l.alive = false;
}

// A sharp turn of one stroke: the two other edges lie close together and the branch points out between them.
bool SkeletonGraph::closesCorner(int edge, int node) const {
  const SkeletonNode& n = nodes_[node];
  if (n.ends.size() != 3) return false;
  const double reach = kCornerReachRadii * n.radius + kCornerReachPx;
  Vec2 spur = Vec2::Zero(), other[2];
  int k = 0;
  for (const int end : n.ends) {
    const Vec2 d = leaving(edges_[end / 2], end % 2, n.centre, reach);
    if (end / 2 == edge) {
      spur = d;
    } else if (k < 2) {
      other[k++] = d;
    }
  }
  if (k != 2) return false;
  return other[0].dot(other[1]) > kAcute && spur.dot(other[0] + other[1]) < 0.0;
}

// The side of an edge at which it ends free, if it is a spur.
std::optional<int> SkeletonGraph::spurTip(int edge, double factor) const {
  const SkeletonEdge& l = edges_[edge];
  if (!l.alive || l.ring || l.node[0] == l.node[1]) return std::nullopt;
  const bool tips[2] = {nodes_[*l.node[0]].ends.size() == 1, nodes_[*l.node[1]].ends.size() == 1};
  if (tips[0] == tips[1]) return std::nullopt;
  const int tip = tips[0] ? 0 : 1, junction = *l.node[1 - tip];
  const double r = nodes_[junction].radius, rw = medianRadius_ + 0.5;
  const double width = 2.0 * std::min(r, 2.0 * rw);
  if (l.length <= factor * width + 1.0) return tip;
  // An acute corner is fat inside and has a long branch to its tip.
  const bool isCorner =
      r > kFatCorner * rw && l.length <= factor * kCornerSpur * width + 1.0 && closesCorner(edge, junction);
  return isCorner ? std::optional(tip) : std::nullopt;
}

void SkeletonGraph::markCorner(int edge, int side, const Vec2& centre, double reach) {
  std::vector<StrokePathPoint>& p = edges_[edge].points;
  const int n = static_cast<int>(p.size());
  for (int k = 0; k < n; ++k) {
    StrokePathPoint& point = p[side == 0 ? k : n - 1 - k];
    if ((point.at - centre).norm() > reach) break;
    point.part = StrokePart::Corner;
  }
}

// An edge that ends where two legs of an acute corner become one body of ink goes straight on to the tip instead: what
// it has within `reach` of its end is pulled to the other leg.
void SkeletonGraph::leadToTip(int edge, int side, const Vec2& tip, double reach) {
  std::vector<StrokePathPoint>& p = edges_[edge].points;
  if (side == 0) std::reverse(p.begin(), p.end());
  const Vec2 end = p.back().at;
  while (p.size() > 1 && (p.back().at - end).norm() <= reach) p.pop_back();
  const Vec2 from = p.back().at;
  const int steps = static_cast<int>(std::ceil((tip - from).norm()));
  for (int k = 1; k <= steps; ++k)
    p.push_back({from + (tip - from) * k / steps, static_cast<float>(medianRadius_), StrokePart::Corner});
  if (side == 0) std::reverse(p.begin(), p.end());
  edges_[edge].length = lengthOf(p, false);
}

// Where the pen turned at the tip of an acute corner: a spur ends there or nearer to the border of the ink.
Vec2 SkeletonGraph::turningPoint(int spur, int tipSide) const {
  const std::vector<StrokePathPoint>& p = edges_[spur].points;
  const int n = static_cast<int>(p.size());
  const StrokePathPoint& last = tipSide == 1 ? p.back() : p.front();
  const double beyond = std::clamp(medianRadius_ - static_cast<double>(last.radius), 0.0, edges_[spur].length);
  double arc = 0.0;
  for (int k = 1; k < n; ++k) {
    const Vec2& at = p[tipSide == 1 ? n - 1 - k : k].at;
    arc += (at - p[tipSide == 1 ? n - k : k - 1].at).norm();
    if (arc >= beyond) return beyond > 0.0 ? at : last.at;
  }
  return last.at;
}

void SkeletonGraph::pruneSpurs(double factor) {
  if (!(factor > 0.0)) return;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](int edge) {
    if (spurTip(edge, factor)) queue.emplace(edges_[edge].length, edge);
  };
  for (int i = 0; i < edgeCount(); ++i) offer(i);
  while (!queue.empty()) {
    const auto [length, edge] = queue.top();
    queue.pop();
    if (!edges_[edge].alive || edges_[edge].length != length) continue;
    const std::optional<int> tip = spurTip(edge, factor);
    if (!tip) continue;
    const int node = *edges_[edge].node[1 - *tip];
    const bool corner = closesCorner(edge, node);
    const Vec2 turning = turningPoint(edge, *tip);
    removeEdge(edge);
    SkeletonNode& n = nodes_[node];
    if (corner) {
      const double reach = n.radius + 2.0 * medianRadius_;
      const bool isTip =
          n.radius <= kWidestTip * (medianRadius_ + 0.5) && std::all_of(n.ends.begin(), n.ends.end(), [&](int end) {
            return edges_[end / 2].length >= kLeastLegWidths * 2.0 * medianRadius_;
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
    splice(node);
    for (const int end : ends) offer(end / 2);
  }
}

double SkeletonGraph::meanRadius(int edge) const {
  double sum = 0.0;
  for (const StrokePathPoint& p : edges_[edge].points) sum += static_cast<double>(p.radius);
  return sum / std::max<double>(1.0, static_cast<double>(edges_[edge].points.size()));
}

// [px] How long two strokes that cross or touch at the angle seen at both ends of a link can share one skeleton; 0: the
// link is no such place.
double SkeletonGraph::sharedLength(int link) const {
  const SkeletonEdge& l = edges_[link];
  double angle = 0.0, others = 0.0;
  bool isFree = true;
  for (int side = 0; side < 2; ++side) {
    const SkeletonNode& n = nodes_[*l.node[side]];
    if (n.ends.size() != 3) return 0.0;
    for (const int end : n.ends) {
      if (end / 2 == link) continue;
      others += 0.25 * meanRadius(end / 2);
      isFree = isFree && edges_[end / 2].length >= kCrossingLegs * l.length;
    }
  }
  // Of strokes that cross alone, from border to border: the middle of an even number of pixels lies half a pixel off.
  const double width = isFree ? 2.0 * others + 1.0 : 2.0 * medianRadius_;
  for (int side = 0; side < 2; ++side) {
    const SkeletonNode& n = nodes_[*l.node[side]];
    const double reach = kLeavingWidths * width + n.radius;
    Vec2 inward = Vec2::Zero(), out[2];
    int k = 0;
    for (const int end : n.ends) {
      const Vec2 d = leaving(edges_[end / 2], end % 2, n.centre, reach);
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
  if (meanRadius(link) < kSharedWidth * others) return 0.0;
  constexpr double kLeast = 0.2, kMost = 1.05;  // 12 and 60 degrees
  const double touching = isFree && meanRadius(link) >= kTwoStrokesWidth * others ? kTouchingShare : 1.0;
  return angle > kMost ? 0.0 : touching * 2.0 * width / std::sin(0.5 * std::max(kLeast, angle));
}

// Whether one disc not much larger than theirs holds these nodes: else they are a small drawing and no crossing.
bool SkeletonGraph::isOneCrossing(const std::vector<int>& nodes) const {
  constexpr double kMostReach = 2.5;  // of the largest radius
  double largest = 0.0, reach = 0.0;
  Vec2 centre = Vec2::Zero();
  for (const int n : nodes) centre += nodes_[n].centre / static_cast<double>(nodes.size());
  for (const int n : nodes) {
    largest = std::max(largest, nodes_[n].radius);
    reach = std::max(reach, (nodes_[n].centre - centre).norm() + nodes_[n].radius);
  }
  return reach <= kMostReach * largest + 1.0;
}

void SkeletonGraph::mergeJunctions(bool ofBundles) {
  const int count = edgeCount();
  std::vector<double> radius;
  std::vector<std::vector<int>> members(nodes_.size());
  for (int i = 0; i < nodeCount(); ++i) {
    radius.push_back(nodes_[i].radius);
    members[i] = {i};
  }
  Groups groups(nodeCount());
  std::vector<std::pair<double, int>> links;
  for (int i = 0; i < count; ++i) {
    const SkeletonEdge& l = edges_[i];
    if (!l.alive || l.ring) continue;
    const int a = *l.node[0], b = *l.node[1];
    if (nodes_[a].ends.size() < 3 || nodes_[b].ends.size() < 3) continue;
    if (l.length <= std::max(kOneJunction * (radius[a] + radius[b]) + 1.0, sharedLength(i)))
      links.emplace_back(l.length, i);
  }
  // The nearest first, as long as they are a crossing: all of a small drawing could be one.
  std::sort(links.begin(), links.end());
  std::vector<int> inner, outerEnds;  // of each group, at its root
  for (const SkeletonNode& node : nodes_) outerEnds.push_back(static_cast<int>(node.ends.size()));
  for (const auto& [length, link] : links) {
    const int a = groups.root(*edges_[link].node[0]), b = groups.root(*edges_[link].node[1]);
    if (a != b) {
      // Where four strokes leave each of them they are two crossings of a hatching.
      const bool areWhole = std::min(outerEnds[a], outerEnds[b]) >= 4;
      if (!ofBundles && areWhole && length > std::max(radius[a], radius[b])) continue;
      std::vector<int> all = members[a];
      all.insert(all.end(), members[b].begin(), members[b].end());
      if (!ofBundles && all.size() > 2 && !isOneCrossing(all)) continue;
      groups.join(a, b);
      members[groups.root(a)] = std::move(all);
      outerEnds[groups.root(a)] = outerEnds[a] + outerEnds[b];
    }
    outerEnds[groups.root(a)] -= 2;
    inner.push_back(link);
  }
  for (const int edge : inner) removeEdge(edge);
  // Centre of each cluster first, then the disc that holds the discs of all its members.
  std::vector<Vec2> sum(nodes_.size(), Vec2::Zero());
  std::vector<int> size(nodes_.size(), 0);
  for (int i = 0; i < nodeCount(); ++i) {
    const int root = groups.root(i);
    sum[root] += nodes_[i].centre;
    ++size[root];
  }
  std::vector<double> disc(nodes_.size(), 0.0);
  for (int i = 0; i < nodeCount(); ++i) {
    const int root = groups.root(i);
    disc[root] = std::max(disc[root], (nodes_[i].centre - sum[root] / size[root]).norm() + radius[i]);
    if (root == i) continue;
    for (const int end : nodes_[i].ends) {
      edges_[end / 2].node[end % 2] = root;
      nodes_[root].ends.push_back(end);
    }
    nodes_[i].ends.clear();
  }
  for (int i = 0; i < nodeCount(); ++i) {
    if (size[i] == 0) continue;
    nodes_[i].centre = sum[i] / size[i];
    nodes_[i].radius = disc[i];
    std::sort(nodes_[i].ends.begin(), nodes_[i].ends.end());
  }
  // What lies wholly within one disc is no stroke.
  for (int i = 0; i < count; ++i) {
    const SkeletonEdge& l = edges_[i];
    if (!l.alive || l.ring || l.node[0] != l.node[1]) continue;
    const SkeletonNode& n = nodes_[*l.node[0]];
    const bool within = std::all_of(l.points.begin(), l.points.end(), [&](const StrokePathPoint& p) {
      return (p.at - n.centre).norm() <= kWithinDisc * n.radius;
    });
    if (within) removeEdge(i);
  }
  for (int i = 0; i < nodeCount(); ++i) splice(i);
}

}  // namespace batten
