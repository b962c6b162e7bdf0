// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/skeleton/skeleton_nodes.h"

#include "core/base/disjoint_sets.h"

namespace batten {

SkeletonNodes::SkeletonNodes(const std::vector<SkeletonChain>& chains) {
  for (const SkeletonChain& c : chains) {
    if (c.closed) continue;
    add(c.pixels.front());
    add(c.pixels.back());
  }
  const int count = static_cast<int>(pixels_.size());
  DisjointSets sets(count);
  for (const SkeletonChain& c : chains) {
    if (isLink(c)) sets.join(number_.at(keyOf(c.pixels.front())), number_.at(keyOf(c.pixels.back())));
  }
  for (int i = 0; i < count; ++i) {
    const int root = sets.root(i);  // the first of its set, so that its node is known
    node_.push_back(root == i ? count_++ : node_[root]);
  }
}

void SkeletonNodes::add(const SkeletonPixel& pixel) {
  if (number_.try_emplace(keyOf(pixel), static_cast<int>(pixels_.size())).second) pixels_.push_back(pixel);
}

}  // namespace batten
