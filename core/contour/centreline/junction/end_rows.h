// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/contour/centreline/junction/end_pairing.h"

namespace batten {

/// Of the width of the thinner of two strokes: so much narrower than where all lie side by side is the ink at the least
/// where one lies on the other, half-way.
inline constexpr double kLyingShare = 0.5;
/// [px] What the grid of pixels changes of a width that is twice a radius.
inline constexpr double kGridOfWidthPx = 1.0;
/// Whether one of two strokes may lie on the other in ink that is `narrowestPx` wide at the least, while all strokes
/// side by side are `rowPx` wide.
inline bool mayLieOnAnother(double narrowestPx, double rowPx, double thinnerPx) {
  return narrowestPx <= rowPx - kLyingShare * thinnerPx + kGridOfWidthPx;
}

/// The ends of a junction in two rows that face each other, as where strokes that run side by side come together and
/// part again.
class EndRows {
 public:
  /// Whether ends lie so: two or more to a row, each about in the direction of its row.
  static bool areIn(std::span<const MeetingEnd> ends);
  /// @pre areIn(ends)
  explicit EndRows(std::span<const MeetingEnd> ends);

  using Pair = std::pair<int, int>;
  /// Whether two pairs, each with an end in either row, change sides.
  bool changeSides(const Pair&, const Pair&) const;
  /// Whether two pairs can change sides in ink whose half-width is `narrowestPx` at the least: where one stroke lies on
  /// another the ink is narrower by one than where all lie side by side.
  bool mayCross(const Pair&, const Pair&, double narrowestPx) const;
  /// [px] By which a stroke that goes on from one end to another may lie off the middle of the wider one: between the
  /// outermost ends of both rows on one side it is the outermost one there. 0 of others.
  double freePx(int a, int b) const;

 private:
  struct RowEnd {
    bool isAhead = false;   // in the row of the first end
    double acrossPx = 0.0;  // where it lies across the direction of the rows
    double halfPx = 0.0;    // half-width
  };

  bool isOutermost(int end, double side) const;

  std::vector<RowEnd> ends_;
  double rowPx_ = 0.0;  // sum of the half-widths of the broader row
};

}  // namespace batten
