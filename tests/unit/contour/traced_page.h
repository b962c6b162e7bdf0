// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "core/contour/trace_contours.h"
#include "core/image/threshold/binarize.h"

namespace batten {

/// The lines of a page, all other parameters as they are by default.
inline ContourSet tracedPage(const GreyImage& grey, const ContourParams& lengths = {}) {
  const ThresholdParams params;
  const BitImage ink = *binarize(grey, *findThresholds(grey, {}, params, {}), params, {});
  const auto set = traceContours(ink, grey, {}, lengths, {});
  EXPECT_TRUE(set);
  return set ? *set : ContourSet{};
}

}  // namespace batten
