// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace batten {

/// The convex hull of a mask, of the places that are not 0; empty if there are none.
std::vector<cv::Point> hullOf(const cv::Mat1b& mask);
/// The outer border of the part of a mask that encloses most, cell by cell; empty if all of it is 0.
std::vector<cv::Point> largestOutline(const cv::Mat1b& mask);

}  // namespace batten
