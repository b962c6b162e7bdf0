// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace batten {

/// A picture of one bit a pixel, 64 pixels a word: bit x % 64 of word x / 64 of a row; 1 = ink. Rows are whole words;
/// the bits beyond the width are always 0 (every writer keeps that).
struct BitImage {
  int width = 0;
  int height = 0;
  int wordsPerRow = 0;
  std::vector<std::uint64_t> words;

  BitImage() = default;
  BitImage(int w, int h) : width(w), height(h), wordsPerRow((w + 63) / 64), words(std::ptrdiff_t{wordsPerRow} * h, 0) {}

  std::uint64_t* row(int y) { return words.data() + std::ptrdiff_t{y} * wordsPerRow; }
  const std::uint64_t* row(int y) const { return words.data() + std::ptrdiff_t{y} * wordsPerRow; }
  /// False outside the picture: outside the page is paper.
  bool at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return false;
    return (row(y)[x >> 6] >> (x & 63)) & 1u;
  }
  /// @pre inside the picture.
  void set(int x, int y, bool ink) {
    const std::uint64_t bit = std::uint64_t{1} << (x & 63);
    std::uint64_t& word = row(y)[x >> 6];
    word = ink ? word | bit : word & ~bit;
  }
  /// Mask of the valid bits of the last word of a row.
  std::uint64_t lastWordMask() const {
    const int used = width & 63;
    return used == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << used) - 1;
  }
  /// Number of ink pixels.
  std::int64_t count() const;
  bool operator==(const BitImage&) const = default;
};

}  // namespace batten
