// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <span>

namespace batten {

/// Decodes a picture as it is stored: 1, 3 or 4 channels of 8 or 16 bit, blue first, not rotated; empty if it cannot
/// be. Plain PNG and JPEG files are decoded by their own libraries, all else by OpenCV, which is loaded for it; where
/// both can, they give the same bytes.
cv::Mat decodeFile(std::span<const std::byte> file);

/// Whether OpenCV's readers could be loaded. Without them only plain PNG and JPEG files are decoded.
bool hasRareDecoder();

/// The first half of it: empty for whatever is no plain PNG or JPEG. Plain: grey or colour of 8 bit without
/// transparency, palette and colour profile.
cv::Mat decodePlainFile(std::span<const std::byte> file);

}  // namespace batten
