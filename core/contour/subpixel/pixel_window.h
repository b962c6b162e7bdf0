// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// The raw pixels around a place of an edge, value by value and in fours: what is missing of the last four has weight
/// 0. Kept and read again and again, it takes no new memory.
class PixelWindow {
 public:
  static constexpr double kHalfPx = 1.0;                        ///< [px] along the edge; weights fall to 0 there.
  static constexpr double kVariance = kHalfPx * kHalfPx / 6.0;  ///< [px^2] of the weights along the edge.
  static constexpr int kLanes = 4;                              ///< Values that a processor works on at once.

  /// Those with lo <= distance <= hi. Pixels beyond the page are left out.
  void read(const GreyImage& grey, const Vec2& base, const Vec2& normal, double lo, double hi);
  int count() const { return count_; }
  /// The count with those that make the last four full.
  int fullCount() const { return (count_ + kLanes - 1) / kLanes * kLanes; }
  const double* distance() const { return distance_.data(); }  ///< [px] of the centres along the normal.
  const double* weight() const { return weight_.data(); }      ///< 1 - |along| / kHalfPx.
  const double* grey() const { return grey_.data(); }          ///< [grey]

 private:
  int count_ = 0;
  std::vector<double> distance_, weight_, grey_;
  std::vector<double> from_, to_;  ///< Of each row at work.
};

}  // namespace batten
