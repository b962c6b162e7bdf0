// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/gaussian_mean.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace batten {
namespace {

// Paper with noise, a black bar and a tone: of a size that no factor divides.
cv::Mat1f tonedPicture() {
  cv::Mat1f picture(307, 411);
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, 6.0f);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const bool isBar = x > 200 && x<230, isTone = y> 180 && x < 150;
      picture(y, x) = (isBar ? 20.0f : isTone ? 140.0f : 235.0f) + noise(random);
    }
  }
  return picture;
}

TEST(GaussianMean, WideOnesComeNearThoseOfTheWholePicture) {
  const cv::Mat1f picture = tonedPicture();
  for (const double sigmaPx : {8.0, 11.0, 14.4, 24.0, 60.0}) {
    cv::Mat1f exact;
    cv::GaussianBlur(picture, exact, {}, sigmaPx, 0.0, cv::BORDER_REPLICATE);
    const cv::Mat1f off = cv::abs(gaussianMean(picture, sigmaPx) - exact);
    double worst = 0.0;
    cv::minMaxLoc(off, nullptr, &worst);
    EXPECT_LT(worst, 0.025 * 215.0) << sigmaPx;
    EXPECT_LT(cv::mean(off)[0], 0.004 * 215.0) << sigmaPx;
  }
}

TEST(GaussianMean, OfAnEvenPictureIsThePicture) {
  const cv::Mat1f even(33, 47, 120.0f);
  for (const double sigmaPx : {2.0, 9.0, 40.0})
    EXPECT_LT(cv::norm(gaussianMean(even, sigmaPx), even, cv::NORM_INF), 1e-3) << sigmaPx;
}

TEST(GaussianMean, NarrowOnesAreExact) {
  const cv::Mat1f picture = tonedPicture();
  cv::Mat1f exact;
  cv::GaussianBlur(picture, exact, {}, 3.0, 0.0, cv::BORDER_REPLICATE);
  EXPECT_EQ(cv::norm(gaussianMean(picture, 3.0), exact, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace batten
