// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"

namespace batten {

/// Where thin dark lines run through strips of a plane: some columns side by side. A place is y - slope x.
struct RulingStretches {
  double slope = 0.0;  ///< The one direction that most of the lines share.
  double width = 0.0, height = 0.0;
  double stripWidth = 0.0;                  ///< [grid]
  std::vector<std::vector<double>> strips;  ///< Per strip: places in order, sub-pixel.
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
