// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/sample_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/segment_foot.h"

namespace batten {
namespace {

constexpr std::size_t kLeafSize = 8;  // places that are looked at one by one
constexpr double kRounding = 1e-12;   // relative; some thousand times that of the distances

}  // namespace

SampleTree::SampleTree(std::vector<CurvePlace> places) : places_(std::move(places)) {
  order_.resize(places_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(4 * places_.size() / kLeafSize + 1);
  build(0, places_.size());
}

void SampleTree::build(std::size_t first, std::size_t last) {
  const std::size_t index = nodes_.size();
  const Vec2& any = places_[order_[first]].point;
  const auto number = [](std::size_t k) { return static_cast<std::uint32_t>(k); };
  Node node{{any, any}, {any, any}, 0.0, number(first), number(last), 0, last - first <= kLeafSize};
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t i = order_[k];
    node.places.add(places_[i].point);
    for (const Vec2& end : {before(i), places_[i].point, behind(i)}) node.chords.add(end);
    node.bulge = std::max(node.bulge, places_[i].bulge);
  }
  nodes_.push_back(node);
  if (!node.isLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    const Vec2 size = node.places.high - node.places.low;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      const double u = places_[a].point[axis], v = places_[b].point[axis];
      return u != v ? u < v : a < b;
    });
    build(first, middle);
    build(middle, last);
  }
  nodes_[index].behind = number(nodes_.size());
}

double SampleTree::distanceTo(const Box& box, const Vec2& p) {
  const Vec2 outside = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0);
  return outside.norm() * (1.0 - kRounding);
}

double SampleTree::distanceToChords(std::size_t i, const Vec2& p) const {
  const Vec2& point = places_[i].point;
  const double toBefore = footOnSegment(p, before(i), point).away.norm();
  const double toBehind = footOnSegment(p, point, behind(i)).away.norm();
  return std::min(toBefore, toBehind) * (1.0 - kRounding);
}

std::size_t SampleTree::nearest(const Vec2& p) const {
  // Down the nearer halves first: what that finds rules most of the others out.
  std::size_t found = 0;
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](const Node& leaf) {
    for (std::size_t k = leaf.first; k < leaf.last; ++k) {
      const std::size_t i = order_[k];
      const double distance = (places_[i].point - p).norm();
      if (distance < best || (distance == best && i < found)) best = distance, found = i;
    }
  };
  std::size_t node = 0;
  while (!nodes_[node].isLeaf) {
    const std::size_t one = node + 1, other = nodes_[one].behind;
    node = distanceTo(nodes_[other].places, p) < distanceTo(nodes_[one].places, p) ? other : one;
  }
  look(nodes_[node]);
  for (node = 0; node < nodes_.size();) {
    if (distanceTo(nodes_[node].places, p) > best) {
      node = nodes_[node].behind;
      continue;
    }
    if (nodes_[node].isLeaf) look(nodes_[node]);
    ++node;
  }
  return found;
}

}  // namespace batten
