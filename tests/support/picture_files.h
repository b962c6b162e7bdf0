// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/image/colour_image.h"

namespace batten::test {

/// A picture as a file, written by OpenCV. @param ending ".png", ".jpg" …: the kind. @param isGrey of one channel, red.
std::vector<std::byte> pictureFile(const ColourImage&, const std::string& ending, bool isGrey);

/// What OpenCV reads in a file of 8 bit; grey as three equal channels.
ColourImage readByOpenCv(std::span<const std::byte> file);

}  // namespace batten::test
