// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "core/base/run_context.h"

namespace batten {

/// What means along lines in all directions tell about places of a page. Both pictures are 0 in tiles where nothing was
/// asked.
struct LineMeans {
  /// [of 255] By how much the mean along a line through the place is darker than the means along both its sides, where
  /// that is the least; of all directions the most. A step from tone to tone, dark on one side alone, has none.
  cv::Mat1f depth;
  /// [of 255] Root mean square over all directions of the mean along the line against both sides together: what grain
  /// makes of it.
  cv::Mat1f spread;
};

/// @param level brightness, of 255. @param widthPx of the lines, 1 or more. @param alongPx standard deviation of the
/// weights of a mean along its line. @param where not 0 where it is asked; whole tiles around are computed. The same
/// with any number of threads; unfinished when cancelled.
LineMeans meansAlongLines(const cv::Mat1f& level, double widthPx, double alongPx, const cv::Mat1b& where,
                          const RunContext&);

}  // namespace batten
