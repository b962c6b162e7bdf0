// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

namespace batten {

/// The file that decodes every kind of picture: its libraries take longer to load than most pictures to decode.
inline constexpr const char* kRarePictures = "batten-pictures";
inline constexpr const char* kDecodeRarePicture = "battenDecodePicture";  // its function

/// Decodes a picture as it is stored: its channels, its depth, not rotated. Empty if it cannot be.
using DecodeRarePicture = void (*)(const std::byte* file, std::size_t size, cv::Mat& picture);

}  // namespace batten
