// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/skeleton/skeleton.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

// Neighbours clockwise from north; even entries are 4-neighbours.
constexpr int kAroundX[8] = {0, 1, 1, 1, 0, -1, -1, -1};
constexpr int kAroundY[8] = {-1, -1, 0, 1, 1, 1, 0, -1};  // down

int neighbourhood(const BitImage& image, int x, int y) {
  int bits = 0;
  for (int k = 0; k < 8; ++k) bits |= static_cast<int>(image.at(x + kAroundX[k], y + kAroundY[k])) << k;
  return bits;
}

constexpr int kBlockRows = 4;  // words of 64 px that a processor works on at once

// Ink in blocks of 64 x 4 px, column by column, a block of paper all around: what lies above and below a block comes
// before and behind it, and all its rows are worked on at once.
struct BlocksOfInk {
  explicit BlocksOfInk(const BitImage& ink)
      : down((ink.height + kBlockRows - 1) / kBlockRows + 2),
        words(std::ptrdiff_t{ink.wordsPerRow + 2} * down * kBlockRows, 0),
        touched(words.size() / kBlockRows, 0) {}
  std::uint64_t& word(int y, int i) { return words[std::ptrdiff_t{i + 1} * down * kBlockRows + kBlockRows + y]; }
  int block(int y, int i) const { return (i + 1) * down + 1 + y / kBlockRows; }

  int down;                          // blocks from one column to the next
  std::vector<std::uint64_t> words;  // those of a block at kBlockRows times its number
  std::vector<int> touched;          // the sub-iteration in which a block last lost a pixel
};

struct Loss {
  int block;
  std::uint64_t pixels[kBlockRows];
};

struct InkToThin {
  const std::uint64_t* words;
  const int* touched;
  int down;
};

// What the blocks lose in a sub-iteration, by Guo and Hall's A1 for 64 pixels at once; a block whose surroundings
// rested for a full round is left alone. @return how many of them lose anything.
BATTEN_HOT_LOOP int collectLosses(InkToThin ink, const int* blocks, int count, int time, Loss* __restrict lost) {
  const std::uint64_t odd = (time & 1) != 0 ? ~std::uint64_t{0} : 0;
  const auto atLeastTwo = [](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
    return (a & b) | (c & d) | ((a | b) & (c | d));
  };
  int losses = 0;
  for (int k = 0; k < count; ++k) {
    const int block = blocks[k];
    const int* touched = ink.touched + block;
    int latest = 0;
    for (int d = -ink.down; d <= ink.down; d += ink.down) {
      for (int i = d - 1; i <= d + 1; ++i) latest = touched[i] > latest ? touched[i] : latest;
    }
    if (time > 2 && latest < time - 2) continue;
    const std::uint64_t* row = ink.words + std::ptrdiff_t{block} * kBlockRows;
    const std::uint64_t *west = row - std::ptrdiff_t{ink.down} * kBlockRows,
                        *east = row + std::ptrdiff_t{ink.down} * kBlockRows;
    std::uint64_t pixels[kBlockRows];
    for (int y = 0; y < kBlockRows; ++y) {
      const std::uint64_t n = row[y - 1], here = row[y], s = row[y + 1];
      const std::uint64_t nw = (n << 1) | (west[y - 1] >> 63), ne = (n >> 1) | (east[y - 1] << 63);
      const std::uint64_t w = (here << 1) | (west[y] >> 63), e = (here >> 1) | (east[y] << 63);
      const std::uint64_t sw = (s << 1) | (west[y + 1] >> 63), se = (s >> 1) | (east[y + 1] << 63);
      const std::uint64_t c0 = ~n & (ne | e), c1 = ~e & (se | s), c2 = ~s & (sw | w), c3 = ~w & (nw | n);
      const std::uint64_t oneBranch = (c0 ^ c1 ^ c2 ^ c3) & ~((c0 & c1) | (c2 & c3));
      const std::uint64_t a0 = nw | n, a1 = ne | e, a2 = se | s, a3 = sw | w;
      const std::uint64_t b0 = n | ne, b1 = e | se, b2 = s | sw, b3 = w | nw;
      const std::uint64_t pairs =
          atLeastTwo(a0, a1, a2, a3) & atLeastTwo(b0, b1, b2, b3) & ~(a0 & a1 & a2 & a3 & b0 & b1 & b2 & b3);
      const std::uint64_t side = (odd & ~((n | ne | ~se) & e)) | (~odd & ~((s | sw | ~nw) & w));
      pixels[y] = here & oneBranch & pairs & side;
    }
    if ((pixels[0] | pixels[1] | pixels[2] | pixels[3]) == 0) continue;
    lost[losses].block = block;
    for (int y = 0; y < kBlockRows; ++y) lost[losses].pixels[y] = pixels[y];
    ++losses;
  }
  return losses;
}

std::vector<SkeletonPixel> inkPixels(const BitImage& image) {
  std::vector<SkeletonPixel> pixels;
  for (int y = 0; y < image.height; ++y) {
    for (int word = 0; word < image.wordsPerRow; ++word) {
      for (std::uint64_t bits = image.row(y)[word]; bits != 0; bits &= bits - 1) {
        pixels.push_back({word * 64 + std::countr_zero(bits), y});
      }
    }
  }
  return pixels;
}

// Smallest |dx| to a paper pixel in a row, at most `most` (paper lies beyond both ends of a row).
int paperReach(const BitImage& ink, int x, int y, int most) {
  if (y < 0 || y >= ink.height) return 0;
  const std::uint64_t* row = ink.row(y);
  const auto inkWord = [&](int i) { return i < 0 || i >= ink.wordsPerRow ? std::uint64_t{0} : row[i]; };
  const auto from = [&](int start) {  // 64 pixels from `start` on, low bit first
    const int i = start >> 6, shift = start & 63;
    return shift == 0 ? inkWord(i) : (inkWord(i) >> shift) | (inkWord(i + 1) << (64 - shift));
  };
  // Mostly it is near: one look at the pixels to both sides.
  constexpr int kAtOnce = 32;
  const std::uint64_t around = from(x - kAtOnce);
  const int near = std::min(std::countr_one(around >> kAtOnce), std::countl_one(around << (kAtOnce - 1)));
  if (near < kAtOnce) return std::min(most, near);
  for (int d = 0; d < most; d += 63) {
    const int right = std::countr_one(from(x + d));
    const int left = std::countl_one(from(x - d - 63));
    const int nearest = std::min(right, left);
    if (nearest < 64) return std::min(most, d + nearest);
  }
  return most;
}

// Directions in which a pixel is linked in the pixel graph, and how many, by its neighbours.
struct PixelLinks {
  std::uint8_t directions = 0, count = 0;
};
// By the bits of a neighbourhood.
constexpr auto kPixelLinks = [] {
  std::array<PixelLinks, 256> all{};
  for (int bits = 0; bits < 256; ++bits) {
    int directions = bits & 0x55;
    for (int k = 1; k < 8; k += 2) {
      const bool shared = ((bits >> (k - 1)) & 1) || ((bits >> ((k + 1) & 7)) & 1);
      if (((bits >> k) & 1) && !shared) directions |= 1 << k;
    }
    all[bits] = {static_cast<std::uint8_t>(directions),
                 static_cast<std::uint8_t>(std::popcount(static_cast<unsigned>(directions)))};
  }
  return all;
}();

const PixelLinks& linksOf(const BitImage& image, const SkeletonPixel& p) {
  return kPixelLinks[neighbourhood(image, p.x, p.y)];
}
int links(const BitImage& image, const SkeletonPixel& p) { return linksOf(image, p).directions; }

class GraphWalker {
 public:
  explicit GraphWalker(const BitImage& skeleton)
      : skeleton_(skeleton), walked_(skeleton.width, skeleton.height), pixels_(inkPixels(skeleton)) {}

  std::vector<SkeletonChain> chains() {
    for (const SkeletonPixel& p : pixels_) {
      const auto [bits, count] = linksOf(skeleton_, p);
      if (count == 2) continue;
      walked_.set(p.x, p.y, true);
      if (bits == 0) chains_.push_back({{p}, false, true, true});
      for (int k = 0; k < 8; ++k) {
        if ((bits >> k) & 1) walkFromNode(p, k);
      }
    }
    for (const SkeletonPixel& p : pixels_) {
      if (!walked_.at(p.x, p.y)) walkRing(p);
    }
    return std::move(chains_);
  }

 private:
  bool isNode(const SkeletonPixel& p) const { return linksOf(skeleton_, p).count != 2; }
  bool isEnd(const SkeletonPixel& p) const { return linksOf(skeleton_, p).count == 1; }

  void walkFromNode(const SkeletonPixel& node, int direction) {
    SkeletonChain chain;
    chain.pixels.push_back(node);
    SkeletonPixel at{node.x + kAroundX[direction], node.y + kAroundY[direction]};
    int from = (direction + 4) & 7;
    if (isNode(at)) {
      // Two nodes side by side: one chain, kept by the upper-left one.
      if (at.y < node.y || (at.y == node.y && at.x < node.x)) return;
      chain.pixels.push_back(at);
    } else {
      if (walked_.at(at.x, at.y)) return;  // met from its other end
      for (;;) {
        chain.pixels.push_back(at);
        if (isNode(at)) break;
        walked_.set(at.x, at.y, true);
        const int next = links(skeleton_, at) & ~(1 << from);
        const int step = std::countr_zero(static_cast<unsigned>(next));
        at = {at.x + kAroundX[step], at.y + kAroundY[step]};
        from = (step + 4) & 7;
      }
    }
    chain.freeStart = isEnd(node);
    chain.freeEnd = isEnd(chain.pixels.back());
    chains_.push_back(std::move(chain));
  }

  void walkRing(const SkeletonPixel& start) {
    SkeletonChain chain;
    chain.closed = true;
    SkeletonPixel at = start;
    std::optional<int> from;
    do {
      chain.pixels.push_back(at);
      walked_.set(at.x, at.y, true);
      int next = links(skeleton_, at);
      if (from) next &= ~(1 << *from);
      const int step = std::countr_zero(static_cast<unsigned>(next));
      at = {at.x + kAroundX[step], at.y + kAroundY[step]};
      from = (step + 4) & 7;
    } while (at.x != start.x || at.y != start.y);
    chains_.push_back(std::move(chain));
  }

  const BitImage& skeleton_;
  BitImage walked_;
  std::vector<SkeletonPixel> pixels_;
  std::vector<SkeletonChain> chains_;
};

}  // namespace

bool thinToSkeleton(BitImage& ink, const RunContext& context) {
  if (ink.width <= 0 || ink.height <= 0) return true;
  BlocksOfInk bits(ink);
  const auto forInk = [&](const auto& work) {
    for (int y = 0; y < ink.height; ++y) {
      for (int i = 0; i < ink.wordsPerRow; ++i) {
        if (ink.row(y)[i] != 0) work(y, i);
      }
    }
  };
  std::vector<int> alive;
  forInk([&](int y, int i) {
    bits.word(y, i) = ink.row(y)[i];
    if (std::exchange(bits.touched[bits.block(y, i)], 1) == 0) alive.push_back(bits.block(y, i));
  });
  std::fill(bits.touched.begin(), bits.touched.end(), 0);
  std::sort(alive.begin(), alive.end());  // as they lie in memory
  std::vector<Loss> lost(alive.size());
  for (int time = 1, quiet = 0; quiet < 2; ++time) {
    if (context.isCancelled()) return false;
    const int losses = collectLosses({bits.words.data(), bits.touched.data(), bits.down}, alive.data(),
                                     static_cast<int>(alive.size()), time, lost.data());
    for (int k = 0; k < losses; ++k) {
      std::uint64_t* words = bits.words.data() + std::ptrdiff_t{lost[k].block} * kBlockRows;
      for (int y = 0; y < kBlockRows; ++y) words[y] &= ~lost[k].pixels[y];
      bits.touched[lost[k].block] = time;
    }
    quiet = losses == 0 ? quiet + 1 : 0;
    if ((time & 7) != 0) continue;
    std::erase_if(alive, [&](int block) {
      const std::uint64_t* words = bits.words.data() + std::ptrdiff_t{block} * kBlockRows;
      return std::all_of(words, words + kBlockRows, [](std::uint64_t word) { return word == 0; });
    });
  }
  forInk([&](int y, int i) { ink.row(y)[i] = bits.word(y, i); });
  return true;
}

std::vector<SkeletonChain> skeletonChains(const BitImage& skeleton) { return GraphWalker(skeleton).chains(); }

double inkRadius(const BitImage& ink, int x, int y) {
  if (!ink.at(x, y)) return 0.0;
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  int reach = std::max(ink.width, ink.height);
  const auto look = [&](int row, int dy) {
    const std::int64_t dx = paperReach(ink, x, row, reach + 1), square = dx * dx + static_cast<std::int64_t>(dy) * dy;
    const bool nearer = square < best;
    if (nearer) best = square;
    return nearer;
  };
  for (int dy = 0; dy <= reach; ++dy) {
    const bool above = look(y - dy, dy), below = dy > 0 && look(y + dy, dy);
    if (above || below) reach = static_cast<int>(std::sqrt(static_cast<double>(best)));
  }
  return std::sqrt(static_cast<double>(best));
}

}  // namespace batten
