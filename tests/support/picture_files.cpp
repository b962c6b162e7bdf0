// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/picture_files.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

namespace batten::test {

std::vector<std::byte> pictureFile(const ColourImage& picture, const std::string& ending, bool isGrey) {
  cv::Mat pixels(picture.height, picture.width, isGrey ? CV_8UC1 : CV_8UC3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Rgb8& c = picture.row(y)[x];
      if (isGrey) pixels.at<unsigned char>(y, x) = c.red;
      if (!isGrey) pixels.at<cv::Vec3b>(y, x) = {c.blue, c.green, c.red};
    }
  }
  std::vector<unsigned char> bytes;
  cv::imencode(ending, pixels, bytes);
  std::vector<std::byte> file(bytes.size());
  std::transform(bytes.begin(), bytes.end(), file.begin(), [](unsigned char b) { return std::byte{b}; });
  return file;
}

ColourImage readByOpenCv(std::span<const std::byte> file) {
  std::vector<unsigned char> bytes;
  for (const std::byte b : file) bytes.push_back(std::to_integer<unsigned char>(b));
  const cv::Mat pixels = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  ColourImage picture(pixels.cols, pixels.rows);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const unsigned char* p = pixels.ptr(y) + x * pixels.channels();
      picture.row(y)[x] = pixels.channels() == 1 ? Rgb8{*p, *p, *p} : Rgb8{p[2], p[1], p[0]};
    }
  }
  return picture;
}

}  // namespace batten::test
