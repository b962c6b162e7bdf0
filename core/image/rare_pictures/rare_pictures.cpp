// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rare_pictures/rare_pictures.h"

#include <opencv2/imgcodecs.hpp>

// NOLINTNEXTLINE(readability-identifier-naming): found by this name
extern "C" __attribute__((visibility("default"))) void battenDecodePicture(const std::byte* file, std::size_t size,
                                                                           cv::Mat& picture) {
  const cv::Mat raw(1, static_cast<int>(size), CV_8UC1, const_cast<std::byte*>(file));
  picture = cv::imdecode(raw, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
}
