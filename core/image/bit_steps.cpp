// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bit_steps.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr int kRowsPerBlock = 128;

/// out = the row together with its neighbours at the left and right.
void spreadRow(const std::uint64_t* in, std::uint64_t* out, int words) {
  for (int i = 0; i < words; ++i) {
    const std::uint64_t left = i > 0 ? in[i - 1] >> 63 : 0, right = i + 1 < words ? in[i + 1] << 63 : 0;
    out[i] = in[i] | (in[i] << 1 | left) | (in[i] >> 1 | right);
  }
}

/// One step; `square` over 8 neighbours, else over 4.
BitImage grownOnce(const BitImage& image, bool square, const RunContext& context) {
  BitImage out(image.width, image.height);
  const int words = image.wordsPerRow;
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<std::uint64_t> column(static_cast<std::size_t>(words));
    for (int y = begin; y < end; ++y) {
      const std::uint64_t* middle = image.row(y);
      const std::uint64_t* above = image.row(std::max(y - 1, 0));
      const std::uint64_t* below = image.row(std::min(y + 1, image.height - 1));
      std::uint64_t* row = out.row(y);
      for (int i = 0; i < words; ++i) column[static_cast<std::size_t>(i)] = above[i] | middle[i] | below[i];
      if (square) {
        spreadRow(column.data(), row, words);
      } else {
        spreadRow(middle, row, words);
        for (int i = 0; i < words; ++i) row[i] |= column[static_cast<std::size_t>(i)];
      }
      row[words - 1] &= image.lastWordMask();
    }
  });
  return out;
}

BitImage inverted(BitImage image) {
  for (int y = 0; y < image.height; ++y) {
    for (int i = 0; i < image.wordsPerRow; ++i) image.row(y)[i] = ~image.row(y)[i];
    image.row(y)[image.wordsPerRow - 1] &= image.lastWordMask();
  }
  return image;
}

}  // namespace

BitImage grown(const BitImage& image, int steps, const RunContext& context) {
  BitImage out = image;
  if (image.wordsPerRow == 0) return out;
  for (int i = 0; i < steps && !context.isCancelled(); ++i) out = grownOnce(out, i % 2 == 0, context);
  return out;
}

BitImage shrunken(const BitImage& image, int steps, const RunContext& context) {
  if (image.wordsPerRow == 0) return image;
  return inverted(grown(inverted(image), steps, context));
}

BitImage both(BitImage a, const BitImage& b) {
  for (std::size_t i = 0; i < a.words.size(); ++i) a.words[i] &= b.words[i];
  return a;
}

BitImage without(BitImage a, const BitImage& b) {
  for (std::size_t i = 0; i < a.words.size(); ++i) a.words[i] &= ~b.words[i];
  return a;
}

BitImage either(BitImage a, const BitImage& b) {
  for (std::size_t i = 0; i < a.words.size(); ++i) a.words[i] |= b.words[i];
  return a;
}

}  // namespace batten
