// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/gaussian_mean.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace batten {

cv::Mat1f gaussianMean(const cv::Mat1f& picture, double sigmaPx) {
  constexpr double kLeastSigmaPx = 4.0;  // of the smaller picture: what lies between its pixels is a straight line
  const double factor = std::floor(sigmaPx / kLeastSigmaPx);
  cv::Mat1f out;
  if (factor < 2.0) {
    cv::GaussianBlur(picture, out, {}, sigmaPx, 0.0, cv::BORDER_REPLICATE);
    return out;
  }
  const auto smaller = [&](int px) { return static_cast<int>(std::ceil(px / factor)); };
  cv::resize(picture, out, {smaller(picture.cols), smaller(picture.rows)}, 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(out, out, {}, sigmaPx / factor, 0.0, cv::BORDER_REPLICATE);
  cv::resize(out, out, picture.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return out;
}

cv::Mat1f meanOfMasked(const cv::Mat1f& picture, const cv::Mat1b& mask, double sigmaPx) {
  cv::Mat1f weight;
  mask.convertTo(weight, CV_32F, 1.0 / 255.0);
  const cv::Mat1f sum = gaussianMean(picture.mul(weight), sigmaPx);
  constexpr double kHardlyAny = 1e-3;
  return sum / cv::max(gaussianMean(weight, sigmaPx), kHardlyAny);
}

}  // namespace batten
