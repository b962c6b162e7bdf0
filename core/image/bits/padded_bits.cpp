// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/padded_bits.h"

#include <algorithm>

namespace batten {

PaddedBits::PaddedBits(int width, int height)
    : width_(width),
      height_(height),
      wordsPerRow_((width + 63) / 64),
      stride_(wordsPerRow_ + 2),
      lastMask_((width & 63) == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (width & 63)) - 1),
      words_(stride_ * (height + 2), 0) {}

PaddedBits::PaddedBits(const BitImage& image, bool replicate) : PaddedBits(image.width, image.height) {
  for (int y = 0; y < height_; ++y) {
    std::copy_n(image.row(y), wordsPerRow_, row(y));
    finishRow(y, replicate);
  }
  finishBorderRows(replicate);
}

void PaddedBits::finishRow(int y, bool replicate) {
  if (wordsPerRow_ == 0) return;
  std::uint64_t* words = row(y);
  words[wordsPerRow_ - 1] &= lastMask_;
  if (!replicate) return;
  words[-1] = (words[0] & 1u) != 0 ? ~std::uint64_t{0} : 0;
  const int last = width_ - 1;
  const bool lastInk = ((words[last >> 6] >> (last & 63)) & 1u) != 0;
  words[wordsPerRow_] = lastInk ? ~std::uint64_t{0} : 0;
  if (lastInk) words[wordsPerRow_ - 1] |= ~lastMask_;
}

void PaddedBits::finishBorderRows(bool replicate) {
  if (!replicate || height_ == 0) return;
  std::copy_n(row(0) - 1, stride_, row(-1) - 1);
  std::copy_n(row(height_ - 1) - 1, stride_, row(height_) - 1);
}

BitImage PaddedBits::toImage() const {
  BitImage image(width_, height_);
  for (int y = 0; y < height_; ++y) {
    std::copy_n(row(y), wordsPerRow_, image.row(y));
    if (wordsPerRow_ > 0) image.row(y)[wordsPerRow_ - 1] &= lastMask_;
  }
  return image;
}

}  // namespace batten
