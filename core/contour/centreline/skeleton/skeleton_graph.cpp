// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/skeleton/skeleton_graph.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/centreline/skeleton/skeleton_nodes.h"

namespace batten {
namespace {

constexpr double kSamePointPx = 0.5;  // pixels of a skeleton lie a pixel apart or more

}  // namespace

Vec2 leavingDirection(const SkeletonEdge& edge, int side, const Vec2& from, double reach) {
  const int n = static_cast<int>(edge.points.size());
  Vec2 at = from;
  for (int k = 0; k < n; ++k) {
    at = edge.points[side == 0 ? k : n - 1 - k].at;
    if ((at - from).norm() >= reach) break;
  }
  const Vec2 d = at - from;
  return d.norm() > 0.0 ? Vec2(d / d.norm()) : Vec2::Zero();
}

SkeletonGraph::SkeletonGraph(const std::vector<SkeletonChain>& chains, const BitImage& ink) {
  const SkeletonNodes numbers(chains);
  nodes_.resize(numbers.count());
  std::vector<int> members(numbers.count(), 0);
  for (const SkeletonPixel& p : numbers.pixels()) {
    const int number = numbers.nodeOf(p);
    SkeletonNode& node = nodes_[number];
    node.centre += Vec2(p.x + 0.5, p.y + 0.5);
    node.radius = std::max(node.radius, inkRadius(ink, p.x, p.y));
    ++members[number];
  }
  for (int i = 0; i < nodeCount(); ++i) nodes_[i].centre /= members[i];

  std::vector<float> radii;
  for (const SkeletonChain& c : chains) {
    if (SkeletonNodes::isLink(c) || c.pixels.size() < 2) continue;
    SkeletonEdge edge;
    for (const SkeletonPixel& p : c.pixels) {
      // From the pixel's centre to the border of the ink: half a pixel before the nearest paper centre.
      const auto radius = static_cast<float>(std::max(0.5, inkRadius(ink, p.x, p.y) - 0.5));
      edge.points.push_back({Vec2(p.x + 0.5, p.y + 0.5), radius, StrokePart::Ink});
      radii.push_back(radius);
    }
    edge.ring = c.closed;
    edge.length = strokePathLength(edge.points, c.closed);
    const int number = edgeCount();
    if (!c.closed) {
      edge.node = {numbers.nodeOf(c.pixels.front()), numbers.nodeOf(c.pixels.back())};
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
  const bool twice =
      !a.points.empty() && !b.points.empty() && (a.points.back().at - b.points.front().at).norm() < kSamePointPx;
  a.points.insert(a.points.end(), b.points.begin() + (twice ? 1 : 0), b.points.end());
  a.node[1] = b.node[1];
  for (int& end : nodes_[*a.node[1]].ends) {
    if (end == 2 * from + 1) end = 2 * into + 1;
  }
  a.length = strokePathLength(a.points, false);
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
    if (edge.points.size() > 1 && (edge.points.front().at - edge.points.back().at).norm() < kSamePointPx)
      edge.points.pop_back();
    edge.length = strokePathLength(edge.points, true);
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

double SkeletonGraph::narrowRadius(int edge) const {
  std::vector<float> radii;
  for (const StrokePathPoint& p : edges_[edge].points) radii.push_back(p.radius);
  return radii.empty() ? 0.0 : static_cast<double>(elementOfRank(radii, std::ssize(radii) / 4));
}

double SkeletonGraph::meanRadius(int edge) const {
  double sum = 0.0;
  for (const StrokePathPoint& p : edges_[edge].points) sum += static_cast<double>(p.radius);
  return sum / std::max<double>(1.0, static_cast<double>(edges_[edge].points.size()));
}

}  // namespace batten
