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
  sorted_.reserve(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vec2 &before = places_[i > 0 ? i - 1 : i].point, &behind = places_[std::min(i + 1, places_.size() - 1)].point;
    sorted_.push_back({before, places_[i].point, behind, places_[i].bulge, i});
  }
  nodes_.reserve(4 * places_.size() / kLeafSize + 1);
  build(0, places_.size());
}

void SampleTree::build(std::size_t first, std::size_t last) {
  const std::size_t index = nodes_.size();
  const Vec2& any = sorted_[first].point;
  Node node{{any, any}, {any, any}, 0.0, first, last, 0, last - first <= kLeafSize};
  for (std::size_t k = first; k < last; ++k) {
    const Sorted& one = sorted_[k];
    node.places.add(one.point);
    for (const Vec2& end : {one.before, one.point, one.behind}) node.chords.add(end);
    node.bulge = std::max(node.bulge, one.bulge);
  }
  nodes_.push_back(node);
  if (!node.isLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    const Vec2 size = node.places.high - node.places.low;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const auto at = [&](std::size_t k) { return sorted_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Sorted& a, const Sorted& b) {
      return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.index < b.index;
    });
    build(first, middle);
    build(middle, last);
  }
  nodes_[index].behind = nodes_.size();
}

double SampleTree::distanceTo(const Box& box, const Vec2& p) {
  const Vec2 outside = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0);
  return outside.norm() * (1.0 - kRounding);
}

double SampleTree::Sorted::distanceToChords(const Vec2& p) const {
  return std::min(distanceToChord(p, before, point), distanceToChord(p, point, behind)) * (1.0 - kRounding);
}

std::size_t SampleTree::nearest(const Vec2& p) const {
  // Down the nearer halves first: what that finds rules most of the others out.
  std::size_t found = 0;
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](const Node& leaf) {
    for (std::size_t k = leaf.first; k < leaf.last; ++k) {
      const double distance = (sorted_[k].point - p).norm();
      const std::size_t i = sorted_[k].index;
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
