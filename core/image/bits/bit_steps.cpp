// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/bit_steps.h"

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

constexpr int kTileWords = 4;       // [words of 64 px] width of a tile
constexpr int kMostTileSteps = 63;  // a tile knows one word at either side: what comes from beyond gets no further

/// A part of the page with a word at either side, and rows above and below as many as there are steps.
struct StepTile {
  int firstWord, pastWord, firstRow, pastRow;  // of the page
  int words() const { return pastWord - firstWord; }
  int rows() const { return pastRow - firstRow; }
};

bool holdsInk(const BitImage& image, const StepTile& tile) {
  for (int y = tile.firstRow; y < tile.pastRow; ++y) {
    const std::uint64_t* row = image.row(y);
    for (int i = tile.firstWord; i < tile.pastWord; ++i) {
      if (row[i] != 0) return true;
    }
  }
  return false;
}

/// All steps of a tile at once, while it is in the cache. What is left in `now` holds for its inner part.
class StepsOnTile {
 public:
  StepsOnTile(int steps, bool inverse) : steps_(steps), flip_(inverse ? ~std::uint64_t{0} : 0) {}

  /// Writes words [firstWord, pastWord) of rows [begin, end).
  void run(const BitImage& image, const StepTile& tile, const StepTile& inner, BitImage& out) {
    const int words = tile.words();
    const std::ptrdiff_t size = std::ptrdiff_t{words} * tile.rows();
    now_.resize(size);
    next_.resize(size);
    const std::uint64_t lastMask = tile.pastWord == image.wordsPerRow ? image.lastWordMask() : ~std::uint64_t{0};
    for (int y = tile.firstRow; y < tile.pastRow; ++y) {
      const std::uint64_t* from = image.row(y) + tile.firstWord;
      std::uint64_t* to = now_.data() + std::ptrdiff_t{y - tile.firstRow} * words;
      for (int i = 0; i < words; ++i) to[i] = from[i] ^ flip_;
      to[words - 1] &= lastMask;
    }
    for (int i = 0; i < steps_; ++i) {
      growStrip(now_.data(), next_.data(), words, tile.rows(), lastMask, i % 2 == 0);
      now_.swap(next_);
    }
    for (int y = inner.firstRow; y < inner.pastRow; ++y) {
      const std::uint64_t* from = now_.data() + std::ptrdiff_t{y - tile.firstRow} * words;
      for (int i = inner.firstWord; i < inner.pastWord; ++i) out.row(y)[i] = from[i - tile.firstWord] ^ flip_;
      if (inner.pastWord == image.wordsPerRow) out.row(y)[inner.pastWord - 1] &= image.lastWordMask();
    }
  }

 private:
  int steps_;
  std::uint64_t flip_;
  std::vector<std::uint64_t> now_, next_;
};

/// Tiles without ink stay paper. `inverse`: the paper grows instead of the ink.
BitImage octagon(const BitImage& image, int steps, bool inverse, const RunContext& context) {
  BitImage out(image.width, image.height);
  const int words = image.wordsPerRow;
  if (words == 0) return out;
  const int tileWords = steps <= kMostTileSteps ? kTileWords : words;
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    StepsOnTile work(steps, inverse);
    for (int word = 0; word < words; word += tileWords) {
      const StepTile inner{word, std::min(word + tileWords, words), begin, end};
      const StepTile tile{std::max(0, word - 1), std::min(inner.pastWord + 1, words), std::max(0, begin - steps),
                          std::min(image.height, end + steps)};
      if (holdsInk(image, inverse ? inner : tile)) work.run(image, tile, inner, out);
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

BitImage paperOf(const BitImage& ink) {
  BitImage paper(ink.width, ink.height);
  if (ink.wordsPerRow == 0) return paper;
  for (int y = 0; y < ink.height; ++y) {
    for (int i = 0; i < ink.wordsPerRow; ++i) paper.row(y)[i] = ~ink.row(y)[i];
    paper.row(y)[ink.wordsPerRow - 1] &= ink.lastWordMask();
  }
  return paper;
}

}  // namespace batten
