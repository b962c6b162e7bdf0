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

constexpr double kSharedWidth = 1.1;  // of a single stroke

double lengthOf(const std::vector<StrokePathPoint>& points, bool closed) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i].at - points[i - 1].at).norm();
  if (closed && points.size() > 1) sum += (points.front().at - points.back().at).norm();
  return sum;
}

// Sets of indices that belong together.
class Groups {
 public:
  explicit Groups(int n) : parent_(idx(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[idx(i)] != i) i = parent_[idx(i)] = parent_[idx(parent_[idx(i)])];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[idx(std::max(a, b))] = std::min(a, b);
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

// Direction in which a edge leaves its end `side`, looked at over about `reach` px.
Vec2 leaving(const SkeletonEdge& edge, int side, const Vec2& from, double reach) {
  const auto n = edge.points.size();
  Vec2 at = from;
  for (std::size_t k = 0; k < n; ++k) {
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
  std::vector<int> nodeOf(pixels.pixels.size(), -1), members;
  for (std::size_t i = 0; i < nodeOf.size(); ++i) {
    const int root = groups.root(static_cast<int>(i));
    if (root == static_cast<int>(i)) {
      nodeOf[i] = static_cast<int>(nodes_.size());
      nodes_.emplace_back();
      members.push_back(0);
    } else {
      nodeOf[i] = nodeOf[idx(root)];
    }
    SkeletonNode& node = nodes_[idx(nodeOf[i])];
    const SkeletonPixel& p = pixels.pixels[i];
    node.centre += Vec2(p.x + 0.5, p.y + 0.5);
    node.radius = std::max(node.radius, inkRadius(ink, p.x, p.y));
    ++members[idx(nodeOf[i])];
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].centre /= members[i];

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
    const int number = static_cast<int>(edges_.size());
    if (!c.closed) {
      edge.node[0] = nodeOf[idx(pixels.of(c.pixels.front()))];
      edge.node[1] = nodeOf[idx(pixels.of(c.pixels.back()))];
      nodes_[idx(edge.node[0])].ends.push_back(2 * number);
      nodes_[idx(edge.node[1])].ends.push_back(2 * number + 1);
    }
    edges_.push_back(std::move(edge));
  }
  if (!radii.empty()) medianRadius_ = upperMedian(radii);
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) splice(i);
}

void SkeletonGraph::reverse(int edge) {
  SkeletonEdge& l = edges_[idx(edge)];
  std::reverse(l.points.begin(), l.points.end());
  std::swap(l.node[0], l.node[1]);
  for (const int side : {0, 1}) {
    if (l.node[side] < 0) continue;
    for (int& end : nodes_[idx(l.node[side])].ends) {
      if (end == 2 * edge + 1 - side) {
        end = -1 - (2 * edge + side);  // marked, so that a loop is not turned back
        break;
      }
    }
  }
  for (const int side : {0, 1}) {
    if (l.node[side] < 0) continue;
    for (int& end : nodes_[idx(l.node[side])].ends) end = end < 0 ? -1 - end : end;
  }
}

// `from` starts where `into` ends.
void SkeletonGraph::appendEdge(int into, int from) {
  SkeletonEdge& a = edges_[idx(into)];
  SkeletonEdge& b = edges_[idx(from)];
  const bool twice = !a.points.empty() && !b.points.empty() && (a.points.back().at - b.points.front().at).norm() < 0.5;
  a.points.insert(a.points.end(), b.points.begin() + (twice ? 1 : 0), b.points.end());
  a.node[1] = b.node[1];
  for (int& end : nodes_[idx(a.node[1])].ends) {
    if (end == 2 * from + 1) end = 2 * into + 1;
  }
  a.length = lengthOf(a.points, false);
  b = SkeletonEdge{};
  b.alive = false;
}

void SkeletonGraph::splice(int node) {
  SkeletonNode& n = nodes_[idx(node)];
  if (n.ends.size() != 2) return;
  const int a = n.ends[0] / 2, b = n.ends[1] / 2;
  if (a == b) {
    SkeletonEdge& edge = edges_[idx(a)];
    edge.ring = true;
    edge.node[0] = edge.node[1] = -1;
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
  SkeletonEdge& l = edges_[idx(edge)];
  for (const int side : {0, 1}) {
    if (l.node[side] >= 0) std::erase(nodes_[idx(l.node[side])].ends, 2 * edge + side);
  }
  l = SkeletonEdge{};
  l.alive = false;
}

// A sharp turn of one stroke: the two other edges lie close together and the branch points out between them.
bool SkeletonGraph::closesCorner(int edge, int node) const {
  const SkeletonNode& n = nodes_[idx(node)];
  if (n.ends.size() != 3) return false;
  const double reach = 2.0 * n.radius + 3.0;
  Vec2 spur = Vec2::Zero(), other[2];
  int k = 0;
  for (const int end : n.ends) {
    const Vec2 d = leaving(edges_[idx(end / 2)], end % 2, n.centre, reach);
    if (end / 2 == edge) {
      spur = d;
    } else if (k < 2) {
      other[k++] = d;
    }
  }
  if (k != 2) return false;
  constexpr double kAcute = 0.26;  // cos 75 deg
  return other[0].dot(other[1]) > kAcute && spur.dot(other[0] + other[1]) < 0.0;
}

bool SkeletonGraph::isSpur(int edge, double factor, int& tipSide) const {
  const SkeletonEdge& l = edges_[idx(edge)];
  if (!l.alive || l.ring || l.node[0] == l.node[1]) return false;
  const bool tips[2] = {nodes_[idx(l.node[0])].ends.size() == 1, nodes_[idx(l.node[1])].ends.size() == 1};
  if (tips[0] == tips[1]) return false;
  tipSide = tips[0] ? 0 : 1;
  const int junction = l.node[1 - tipSide];
  const double r = nodes_[idx(junction)].radius, rw = medianRadius_ + 0.5;
  const double width = 2.0 * std::min(r, 2.0 * rw);
  if (l.length <= factor * width + 1.0) return true;
  // An acute corner is fat inside and has a long branch to its tip.
  return r > 1.15 * rw && l.length <= factor * (5.0 / 3.0) * width + 1.0 && closesCorner(edge, junction);
}

void SkeletonGraph::markCorner(int edge, int side, const Vec2& centre, double reach) {
  std::vector<StrokePathPoint>& p = edges_[idx(edge)].points;
  for (std::size_t k = 0; k < p.size(); ++k) {
    StrokePathPoint& point = p[side == 0 ? k : p.size() - 1 - k];
    if ((point.at - centre).norm() > reach) break;
    point.part = StrokePart::Corner;
  }
}

void SkeletonGraph::pruneSpurs(double factor) {
  if (!(factor > 0.0)) return;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  int tip = 0;
  const auto offer = [&](int edge) {
    if (isSpur(edge, factor, tip)) queue.emplace(edges_[idx(edge)].length, edge);
  };
  for (int i = 0; i < static_cast<int>(edges_.size()); ++i) offer(i);
  while (!queue.empty()) {
    const auto [length, edge] = queue.top();
    queue.pop();
    if (!edges_[idx(edge)].alive || edges_[idx(edge)].length != length || !isSpur(edge, factor, tip)) continue;
    const int node = edges_[idx(edge)].node[1 - tip];
    const bool corner = closesCorner(edge, node);
    removeEdge(edge);
    SkeletonNode& n = nodes_[idx(node)];
    if (corner) {
      for (const int end : n.ends) markCorner(end / 2, end % 2, n.centre, n.radius + 2.0 * medianRadius_);
    }
    const std::vector<int> ends = n.ends;
    splice(node);
    for (const int end : ends) offer(end / 2);
  }
}

double SkeletonGraph::meanRadius(int edge) const {
  double sum = 0.0;
  for (const StrokePathPoint& p : edges_[idx(edge)].points) sum += static_cast<double>(p.radius);
  return sum / std::max<double>(1.0, static_cast<double>(edges_[idx(edge)].points.size()));
}

// [px] How long two strokes that cross or touch at the angle seen at both ends of a link can share one skeleton; 0: the
// link is no such place.
double SkeletonGraph::sharedLength(int link) const {
  const SkeletonEdge& l = edges_[idx(link)];
  const double width = 2.0 * medianRadius_;
  double angle = 0.0, others = 0.0;
  for (int side = 0; side < 2; ++side) {
    const SkeletonNode& n = nodes_[idx(l.node[side])];
    if (n.ends.size() != 3) return 0.0;
    for (const int end : n.ends) others += end / 2 == link ? 0.0 : 0.25 * meanRadius(end / 2);
    const double reach = 4.0 * width + n.radius;
    Vec2 inward = Vec2::Zero(), out[2];
    int k = 0;
    for (const int end : n.ends) {
      const Vec2 d = leaving(edges_[idx(end / 2)], end % 2, n.centre, reach);
      if (end == 2 * link + side) {
        inward = d;
      } else if (k < 2) {
        out[k++] = d;
      }
    }
    if (k != 2 || inward.dot(out[0]) > -0.7 || inward.dot(out[1]) > -0.7) return 0.0;
    angle += 0.5 * std::acos(std::clamp(out[0].dot(out[1]), -1.0, 1.0));
  }
  // Two strokes that part on either side are wider than one; a line between two things that hang on it is not.
  if (meanRadius(link) < kSharedWidth * others) return 0.0;
  constexpr double kLeast = 0.2, kMost = 1.05;  // 12 and 60 degrees
  return angle > kMost ? 0.0 : 2.0 * width / std::sin(0.5 * std::max(kLeast, angle));
}

void SkeletonGraph::mergeJunctions() {
  const int legCount = static_cast<int>(edges_.size());
  std::vector<double> radius;
  for (const SkeletonNode& n : nodes_) radius.push_back(n.radius);
  Groups groups(static_cast<int>(nodes_.size()));
  std::vector<int> inner;
  for (int i = 0; i < legCount; ++i) {
    const SkeletonEdge& l = edges_[idx(i)];
    if (!l.alive || l.ring) continue;
    const auto a = idx(l.node[0]), b = idx(l.node[1]);
    if (nodes_[a].ends.size() < 3 || nodes_[b].ends.size() < 3) continue;
    if (l.length > std::max(1.5 * (radius[a] + radius[b]) + 1.0, sharedLength(i))) continue;
    groups.join(l.node[0], l.node[1]);
    inner.push_back(i);
  }
  for (const int edge : inner) removeEdge(edge);
  // Centre of each cluster first, then the disc that holds the discs of all its members.
  std::vector<Vec2> sum(nodes_.size(), Vec2::Zero());
  std::vector<int> count(nodes_.size(), 0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto root = idx(groups.root(static_cast<int>(i)));
    sum[root] += nodes_[i].centre;
    ++count[root];
  }
  std::vector<double> disc(nodes_.size(), 0.0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto root = idx(groups.root(static_cast<int>(i)));
    disc[root] = std::max(disc[root], (nodes_[i].centre - sum[root] / count[root]).norm() + radius[i]);
    if (root == i) continue;
    for (const int end : nodes_[i].ends) {
      edges_[idx(end / 2)].node[end % 2] = static_cast<int>(root);
      nodes_[root].ends.push_back(end);
    }
    nodes_[i].ends.clear();
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (count[i] == 0) continue;
    nodes_[i].centre = sum[i] / count[i];
    nodes_[i].radius = disc[i];
    std::sort(nodes_[i].ends.begin(), nodes_[i].ends.end());
  }
  // What lies wholly within one disc is no stroke.
  for (int i = 0; i < legCount; ++i) {
    const SkeletonEdge& l = edges_[idx(i)];
    if (!l.alive || l.ring || l.node[0] != l.node[1]) continue;
    const SkeletonNode& n = nodes_[idx(l.node[0])];
    const bool within = std::all_of(l.points.begin(), l.points.end(), [&](const StrokePathPoint& p) {
      return (p.at - n.centre).norm() <= 1.1 * n.radius;
    });
    if (within) removeEdge(i);
  }
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) splice(i);
}

}  // namespace batten
