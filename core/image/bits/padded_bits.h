// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/bits/bit_image.h"

namespace batten {

/// A bit image with one guard word at either side of a row and one guard row above and below, so that neighbour loops
/// need no test for the border.
class PaddedBits {
 public:
  PaddedBits(int width, int height);
  /// @param replicate the guards repeat the border pixels; else they are paper.
  PaddedBits(const BitImage& image, bool replicate);

  /// First word of row y, -1 <= y <= height; index -1 and wordsPerRow are the guards.
  std::uint64_t* row(int y) { return words_.data() + (y + 1) * stride_ + 1; }
  const std::uint64_t* row(int y) const { return words_.data() + (y + 1) * stride_ + 1; }
  int width() const { return width_; }
  int height() const { return height_; }
  int wordsPerRow() const { return wordsPerRow_; }

  /// Clears the bits beyond the width in row y and sets the guards beside it.
  void finishRow(int y, bool replicate);
  /// Sets the rows above and below the picture.
  void finishBorderRows(bool replicate);
  BitImage toImage() const;

 private:
  int width_, height_, wordsPerRow_;
  std::ptrdiff_t stride_;
  std::uint64_t lastMask_;
  std::vector<std::uint64_t> words_;
};

}  // namespace batten
