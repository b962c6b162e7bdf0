// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

namespace batten {

/// A mask (not 0 inside) with all that is within `radius` pixels of it, along rows and columns alike.
cv::Mat1b grownMask(const cv::Mat1b& mask, int radius);

/// A mask without all that is within `radius` pixels of what is outside.
cv::Mat1b shrunkMask(const cv::Mat1b& mask, int radius);

}  // namespace batten
