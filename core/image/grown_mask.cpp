// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/grown_mask.h"

#include <opencv2/imgproc.hpp>

namespace batten {
namespace {

cv::Mat square(int radius) { return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}); }

}  // namespace

cv::Mat1b grownMask(const cv::Mat1b& mask, int radius) {
  cv::Mat1b out;
  cv::dilate(mask, out, square(radius));
  return out;
}

cv::Mat1b shrunkMask(const cv::Mat1b& mask, int radius) {
  cv::Mat1b out;
  cv::erode(mask, out, square(radius));
  return out;
}

}  // namespace batten
