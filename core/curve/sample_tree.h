// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// A point of a curve, and how far the curve may lie off the chords from it to the points before and behind.
struct CurvePlace {
  Vec2 point = Vec2::Zero();
  double bulge = 0.0;  ///< [unit of the curve] >= 0
};

/// Places in the order of a curve, in boxes of boxes of neighbours: which ones are near a point is known without
/// looking at all of them. The answers are those of a search through all, to the last bit.
class SampleTree {
 public:
  /// @pre at least one place, all finite.
  explicit SampleTree(std::vector<CurvePlace> places);

  const std::vector<CurvePlace>& places() const { return places_; }
  /// The first of the nearest places, whatever their bulge.
  std::size_t nearest(const Vec2& p) const;

  /// Calls `visit(index)` in ascending order for the places near which the curve may be no farther than `bound()`:
  /// those whose chords are no farther than that and their bulge. The bound is asked again for every place and may
  /// shrink meanwhile.
  template <class Bound, class Visit>
  void within(const Vec2& p, const Bound& bound, const Visit& visit) const {
    for (std::size_t node = 0; node < nodes_.size();) {
      const Node& box = nodes_[node];
      if (distanceTo(box, p) - box.bulge > bound()) {
        node = box.behind;
        continue;
      }
      if (box.isLeaf) {
        for (std::size_t i = box.first; i < box.last; ++i)
          if (distanceToChords(i, p) - places_[i].bulge <= bound()) visit(i);
      }
      ++node;
    }
  }

 private:
  struct Node {
    Vec2 low, high;           ///< Of its places and the chords to their neighbours.
    double bulge = 0.0;       ///< The largest inside.
    std::size_t first, last;  ///< Places first..last - 1.
    std::size_t behind;       ///< The node behind this one and all below it.
    bool isLeaf = false;
  };

  void build(std::size_t first, std::size_t last);
  /// From the box, a little less than exact, so that rounding hides no place.
  static double distanceTo(const Node& box, const Vec2& p);
  double distanceToChords(std::size_t place, const Vec2& p) const;

  std::vector<CurvePlace> places_;
  std::vector<Node> nodes_;  ///< Each before those below it, the first half before the second.
};

}  // namespace batten
