// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline_skeleton.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace batten {
namespace {

// Neighbours clockwise from north; even entries are 4-neighbours.
constexpr int kAroundX[8] = {0, 1, 1, 1, 0, -1, -1, -1};
constexpr int kAroundY[8] = {-1, -1, 0, 1, 1, 1, 0, -1};

int neighbourhood(const BitImage& image, int x, int y) {
  int bits = 0;
  for (int k = 0; k < 8; ++k) bits |= static_cast<int>(image.at(x + kAroundX[k], y + kAroundY[k])) << k;
  return bits;
}

// Guo and Hall, A1: removable in sub-iteration `odd`.
bool removable(int bits, bool odd) {
  const auto p = [bits](int k) { return (bits >> (k & 7)) & 1; };
  int connectivity = 0, pairsA = 0, pairsB = 0;
  for (int k = 0; k < 8; k += 2) {
    connectivity += !p(k) && (p(k + 1) || p(k + 2));
    pairsA += p(k - 1 + 8) || p(k);
    pairsB += p(k) || p(k + 1);
  }
  const int pairs = std::min(pairsA, pairsB);
  if (connectivity != 1 || pairs < 2 || pairs > 3) return false;
  return odd ? !((p(0) || p(1) || !p(3)) && p(2)) : !((p(4) || p(5) || !p(7)) && p(6));
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

// Directions in which a pixel is linked in the pixel graph.
int links(const BitImage& image, const SkeletonPixel& p) {
  const int bits = neighbourhood(image, p.x, p.y);
  int result = bits & 0x55;
  for (int k = 1; k < 8; k += 2) {
    const bool shared = ((bits >> (k - 1)) & 1) || ((bits >> ((k + 1) & 7)) & 1);
    if (((bits >> k) & 1) && !shared) result |= 1 << k;
  }
  return result;
}

class GraphWalker {
 public:
  explicit GraphWalker(const BitImage& skeleton)
      : skeleton_(skeleton), walked_(skeleton.width, skeleton.height), pixels_(inkPixels(skeleton)) {}

  std::vector<SkeletonChain> chains() {
    for (const SkeletonPixel& p : pixels_) {
      const int bits = links(skeleton_, p);
      if (std::popcount(static_cast<unsigned>(bits)) == 2) continue;
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
  bool isNode(const SkeletonPixel& p) const { return std::popcount(static_cast<unsigned>(links(skeleton_, p))) != 2; }
  bool isEnd(const SkeletonPixel& p) const { return std::popcount(static_cast<unsigned>(links(skeleton_, p))) == 1; }

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
    int from = -1;
    do {
      chain.pixels.push_back(at);
      walked_.set(at.x, at.y, true);
      int next = links(skeleton_, at);
      if (from >= 0) next &= ~(1 << from);
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

double SkeletonChain::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < pixels.size(); ++i) {
    sum += std::hypot(pixels[i].x - pixels[i - 1].x, pixels[i].y - pixels[i - 1].y);
  }
  return sum;
}

bool thinToSkeleton(BitImage& ink, const RunContext& context) {
  std::vector<SkeletonPixel> alive = inkPixels(ink);
  std::vector<SkeletonPixel> removed;
  for (bool changed = true; changed;) {
    changed = false;
    for (const bool odd : {true, false}) {
      if (context.isCancelled()) return false;
      removed.clear();
      for (const SkeletonPixel& p : alive) {
        if (removable(neighbourhood(ink, p.x, p.y), odd)) removed.push_back(p);
      }
      for (const SkeletonPixel& p : removed) ink.set(p.x, p.y, false);
      if (removed.empty()) continue;
      changed = true;
      std::erase_if(alive, [&](const SkeletonPixel& p) { return !ink.at(p.x, p.y); });
    }
  }
  return true;
}

std::vector<SkeletonChain> skeletonChains(const BitImage& skeleton) { return GraphWalker(skeleton).chains(); }

}  // namespace batten
