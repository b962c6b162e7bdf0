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

/// The lines that fill at least a third of a strip, in the direction that the page has most of, up to 1 in 5.
RulingStretches findRulingStretches(const Plane& grey, const RunContext& context);

}  // namespace batten
