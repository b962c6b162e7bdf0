// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bit_steps.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"

namespace batten {
namespace {

/// out = the row together with its neighbours at the left and right.
void spreadRow(const std::uint64_t* in, std::uint64_t* out, int words) {
  for (int i = 0; i < words; ++i) {
    const std::uint64_t left = i > 0 ? in[i - 1] >> 63 : 0, right = i + 1 < words ? in[i + 1] << 63 : 0;
    out[i] = in[i] | (in[i] << 1 | left) | (in[i] >> 1 | right);
  }
}

/// One step inside a strip of rows; `square` over 8 neighbours, else over 4. The strip's ends are paper outside.
void growStrip(const std::uint64_t* in, std::uint64_t* out, int words, int rows, std::uint64_t lastMask, bool square) {
  std::vector<std::uint64_t> column(words);
  for (int y = 0; y < rows; ++y) {
    const std::uint64_t* middle = in + static_cast<std::ptrdiff_t>(y) * words;
    const std::uint64_t* above = y > 0 ? middle - words : middle;
    const std::uint64_t* below = y + 1 < rows ? middle + words : middle;
    std::uint64_t* row = out + static_cast<std::ptrdiff_t>(y) * words;
    for (int i = 0; i < words; ++i) column[i] = above[i] | middle[i] | below[i];
    if (square) {
      spreadRow(column.data(), row, words);
    } else {
      spreadRow(middle, row, words);
      for (int i = 0; i < words; ++i) row[i] |= column[i];
    }
    row[words - 1] &= lastMask;
  }
}

/// All steps of a strip of rows at once, while it is in the cache. `inverse`: the paper grows instead of the ink.
BitImage octagon(const BitImage& image, int steps, bool inverse, const RunContext& context) {
  BitImage out(image.width, image.height);
  const int words = image.wordsPerRow;
  if (words == 0) return out;
  const std::uint64_t flip = inverse ? ~std::uint64_t{0} : 0, lastMask = image.lastWordMask();
  parallelFor(context, image.height, 2 * kRowsPerBlock, [&](int begin, int end) {
    const int first = std::max(0, begin - steps), rows = std::min(image.height, end + steps) - first;
    const auto size = std::ptrdiff_t{words} * rows;
    std::vector<std::uint64_t> now(image.row(first), image.row(first) + size), next(size);
    for (std::uint64_t& word : now) word ^= flip;
    for (std::size_t i = 1; i <= static_cast<std::size_t>(rows); ++i) {
      now[i * static_cast<std::size_t>(words) - 1] &= lastMask;
    }
    for (int i = 0; i < steps; ++i) {
      growStrip(now.data(), next.data(), words, rows, lastMask, i % 2 == 0);
      now.swap(next);
    }
    for (int y = begin; y < end; ++y) {
      const std::uint64_t* row = now.data() + static_cast<std::ptrdiff_t>(y - first) * words;
      for (int i = 0; i < words; ++i) out.row(y)[i] = row[i] ^ flip;
      out.row(y)[words - 1] &= lastMask;
    }
  });
  return out;
}

}  // namespace

BitImage grown(const BitImage& image, int steps, const RunContext& context) {
  return octagon(image, steps, false, context);
}

BitImage shrunken(const BitImage& image, int steps, const RunContext& context) {
  return octagon(image, steps, true, context);
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
