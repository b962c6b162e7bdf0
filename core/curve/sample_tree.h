// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Places in the order of a curve, in boxes of boxes of places that lie together, however often the curve comes by:
/// which ones are near a point is known without looking at all of them. The answers are those of a search through all,
/// to the last bit.
class SampleTree {
 public:
  static constexpr std::size_t kFew = 8;  // places, which are visited as they come

  /// @pre at least one place and fewer than 2^32, all finite.
  explicit SampleTree(std::vector<CurvePlace> places);

  const std::vector<CurvePlace>& places() const { return places_; }
  /// The first of the nearest places, whatever their bulge.
  std::size_t nearest(const Vec2& p) const;

  /// Calls `visit(index)` for the places near which the curve may be no farther than `bound()`: those whose chords are
  /// no farther than that and their bulge. The bound is asked again for every place and may shrink meanwhile. The order
  /// is ascending; of more than kFew places the one that may be nearest comes first, since it rules out most others.
  template <class Bound, class Visit>
  void within(const Vec2& p, const Bound& bound, const Visit& visit) const {
    std::vector<Near> near;
    for (std::size_t node = 0; node < nodes_.size();) {
      const Node& box = nodes_[node];
      if (distanceTo(box.chords, p) - box.bulge > bound()) {
        node = box.behind;
        continue;
      }
      if (box.isLeaf) {
        for (std::size_t k = box.first; k < box.last; ++k) {
          const std::size_t i = order_[k];
          const double most = bound();
          if (isBeyond(i, p, most + places_[i].bulge)) continue;
          const double distance = distanceToChords(i, p) - places_[i].bulge;
          if (distance <= most) near.push_back({distance, i});
        }
      }
      ++node;
    }
    std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.index < b.index; });
    if (near.size() > kFew) {
      const auto first = std::min_element(near.begin(), near.end(),
                                          [](const Near& a, const Near& b) { return a.distance < b.distance; });
      visit(first->index);
      near.erase(first);
    }
    for (const Near& one : near)
      if (one.distance <= bound()) visit(one.index);
  }

 private:
  struct Near {
    double distance;  ///< The least that the curve may have there.
    std::size_t index;
  };
  struct Box {
    Vec2 low, high;
    void add(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  };
  struct Node {
    Box places;                 ///< Around its places.
    Box chords;                 ///< Around these and the chords to their neighbours.
    double bulge = 0.0;         ///< The largest inside.
    std::uint32_t first, last;  ///< Places order_[first..last - 1].
    std::uint32_t behind;       ///< The node behind this one and all below it.
    bool isLeaf = false;
  };

  /// The places before and behind; at the ends of the line the place itself.
  const Vec2& before(std::size_t i) const { return places_[i > 0 ? i - 1 : i].point; }
  const Vec2& behind(std::size_t i) const { return places_[std::min(i + 1, places_.size() - 1)].point; }
  double distanceToChords(std::size_t i, const Vec2& p) const;
  /// Whether the box of a place's chords lies farther than that: told at once, and of most chords in a long one's box.
  bool isBeyond(std::size_t i, const Vec2& p, double distance) const {
    constexpr double kRoom = 1.0 + 1e-9;  // for rounding
    const Vec2 &a = before(i), &b = places_[i].point, &c = behind(i);
    const Vec2 low = a.cwiseMin(b).cwiseMin(c) - p, high = p - a.cwiseMax(b).cwiseMax(c);
    return low.cwiseMax(high).maxCoeff() > kRoom * distance;
  }
  void build(std::size_t first, std::size_t last);
  /// From the box, a little less than exact, so that rounding hides no place.
  static double distanceTo(const Box& box, const Vec2& p);

  std::vector<CurvePlace> places_;
  std::vector<std::uint32_t> order_;  ///< The places, box by box.
  std::vector<Node> nodes_;           ///< Each before those below it, the first half before the second.
};

}  // namespace batten
