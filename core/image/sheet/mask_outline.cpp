// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/mask_outline.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace batten {

std::vector<cv::Point> hullOf(const cv::Mat1b& mask) {
  std::vector<cv::Point> places, hull;
  cv::findNonZero(mask, places);
  if (!places.empty()) cv::convexHull(places, hull);
  return hull;
}

std::vector<cv::Point> largestOutline(const cv::Mat1b& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto largest = std::max_element(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  return largest == outlines.end() ? std::vector<cv::Point>() : *largest;
}

}  // namespace batten
