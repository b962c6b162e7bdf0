// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

namespace batten {

/// Gaussian mean around every pixel; beyond the border the picture goes on as it ends. From 8 px on it is taken of a
/// smaller picture, in a fraction of the time: at most a fortieth of the largest step from the exact one.
/// @param sigmaPx standard deviation of the weights.
cv::Mat1f gaussianMean(const cv::Mat1f& picture, double sigmaPx);
/// The same of what the mask (255 inside) lets in.
cv::Mat1f meanOfMasked(const cv::Mat1f& picture, const cv::Mat1b& mask, double sigmaPx);

}  // namespace batten
