// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/sample_tree.h"

#include <algorithm>
#include <utility>

namespace batten {
namespace {

constexpr std::size_t kLeafSize = 8;
constexpr double kRounding = 1e-12;  // relative; some thousand times that of the distances

double distanceToChord(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 chord = b - a;
  const double squared = chord.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((p - a).dot(chord) / squared, 0.0, 1.0) : 0.0;
  return (p - a - share * chord).norm();
}

}  // namespace

SampleTree::SampleTree(std::vector<CurvePlace> places) : places_(std::move(places)) {
  nodes_.reserve(4 * places_.size() / kLeafSize + 1);
  build(0, places_.size());
}

void SampleTree::build(std::size_t first, std::size_t last) {
  const std::size_t index = nodes_.size();
  Node node{places_[first].point, places_[first].point, 0.0, first, last, 0, last - first <= kLeafSize};
  for (std::size_t i = first - (first > 0 ? 1 : 0); i < std::min(last + 1, places_.size()); ++i) {
    node.low = node.low.cwiseMin(places_[i].point);
    node.high = node.high.cwiseMax(places_[i].point);
  }
  for (std::size_t i = first; i < last; ++i) node.bulge = std::max(node.bulge, places_[i].bulge);
  nodes_.push_back(node);
  if (!node.isLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    build(first, middle);
    build(middle, last);
  }
  nodes_[index].behind = nodes_.size();
}

double SampleTree::distanceTo(const Node& box, const Vec2& p) {
  const Vec2 outside = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0);
  return outside.norm() * (1.0 - kRounding);
}

double SampleTree::distanceToChords(std::size_t place, const Vec2& p) const {
  const Vec2& here = places_[place].point;
  double distance = (here - p).norm();
  if (place > 0) distance = std::min(distance, distanceToChord(p, places_[place - 1].point, here));
  if (place + 1 < places_.size()) distance = std::min(distance, distanceToChord(p, here, places_[place + 1].point));
  return distance * (1.0 - kRounding);
}

std::size_t SampleTree::nearest(const Vec2& p) const {
  // Down the nearer halves first: what that finds rules most of the others out.
  std::size_t found = 0;
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](const Node& leaf) {
    for (std::size_t i = leaf.first; i < leaf.last; ++i) {
      const double distance = (places_[i].point - p).norm();
      if (distance < best || (distance == best && i < found)) best = distance, found = i;
    }
  };
  std::size_t node = 0;
  while (!nodes_[node].isLeaf) {
    const std::size_t one = node + 1, other = nodes_[one].behind;
    node = distanceTo(nodes_[other], p) < distanceTo(nodes_[one], p) ? other : one;
  }
  look(nodes_[node]);
  for (node = 0; node < nodes_.size();) {
    if (distanceTo(nodes_[node], p) > best) {
      node = nodes_[node].behind;
      continue;
    }
    if (nodes_[node].isLeaf) look(nodes_[node]);
    ++node;
  }
  return found;
}

}  // namespace batten
