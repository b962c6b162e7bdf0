// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"

namespace batten {

/// A thin dark line in a strip of a plane.
struct RulingStretch {
  double place = 0.0;  ///< [grid] y - slope x in the middle of the strip, sub-pixel.
  double inked = 0.0;  ///< Share of the columns of the strip in which it is seen, about 1 for a whole line.
};

/// How the lines of a strip lie: their slope is a linear function of the place across them, as in perspective.
struct RulingFan {
  double slope = 0.0;  ///< In the middle of the strip.
  double fan = 0.0;    ///< What is added at its lower border.
};

/// Where thin dark lines run through strips of a plane: some columns side by side.
struct RulingStretches {
  double slope = 0.0;  ///< The one direction that most of the lines share.
  /// [grid] Of the plane.
  double width = 0.0, height = 0.0;
  double fromX = 0.0, stripWidth = 0.0;            ///< [grid] Where the first strip begins.
  std::vector<std::vector<RulingStretch>> strips;  ///< Per strip, in order of place.

  std::vector<RulingFan> fans;  ///< Per strip.

  double middleOf(std::size_t strip) const { return fromX + (static_cast<double>(strip) + 0.5) * stripWidth; }
  /// Those of `count` strips alone.
  RulingStretches inStrips(int first, int count) const;
  /// dy / dx of the lines of a strip at a place.
  double slopeAt(int strip, double place) const;
  /// Without those that are seen in fewer of the columns.
  RulingStretches inkedAtLeast(double share) const;
};

/// A plane as it is, or mirrored in its diagonal: rows are columns.
struct PlaneView {
  const Plane& plane;
  bool isMirrored = false;

  int width() const { return isMirrored ? plane.height : plane.width; }
  int height() const { return isMirrored ? plane.width : plane.height; }
  float at(int x, int y) const { return isMirrored ? plane.row(x)[y] : plane.row(y)[x]; }
  /// Rows [first, past), one behind the other.
  void copyRows(int first, int past, float* out) const;
};

/// The lines that fill at least a third of a strip, in the direction that the page has most of, up to 1 in 5.
RulingStretches findRulingStretches(const PlaneView& grey, const RunContext& context);

}  // namespace batten
