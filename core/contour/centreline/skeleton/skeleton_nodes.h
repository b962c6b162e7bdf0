// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/contour/centreline/skeleton/skeleton.h"

namespace batten {

/// The pixels at the ends of the chains of a skeleton, as nodes: pixels side by side are one. Nodes and pixels are in
/// the order in which they appear.
class SkeletonNodes {
 public:
  explicit SkeletonNodes(const std::vector<SkeletonChain>& chains);

  /// Whether a chain only joins two pixels of one node.
  static bool isLink(const SkeletonChain& chain) {
    return !chain.closed && chain.pixels.size() == 2 && !chain.freeStart && !chain.freeEnd;
  }
  int count() const { return count_; }
  /// @param pixel the first or the last one of an open chain.
  int nodeOf(const SkeletonPixel& pixel) const { return node_[number_.at(keyOf(pixel))]; }
  const std::vector<SkeletonPixel>& pixels() const { return pixels_; }

 private:
  static std::int64_t keyOf(const SkeletonPixel& p) {
    return (static_cast<std::int64_t>(p.y) << 32) | static_cast<std::int64_t>(p.x);
  }
  void add(const SkeletonPixel& pixel);

  std::unordered_map<std::int64_t, int> number_;
  std::vector<SkeletonPixel> pixels_;
  std::vector<int> node_;
  int count_ = 0;
};

}  // namespace batten
