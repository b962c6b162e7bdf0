// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/narrow_paper.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/plane.h"

namespace batten {
namespace {

constexpr double kVariance = 0.6;  // [px^2] of the Gaussian before greys are compared
// Wider paper is brighter than a threshold: blur reaches no farther than a pixel and a half of the page.
constexpr int kReachPx = 6;
constexpr int kBesidePx = 3;  // across the direction, where the paper beside a thin bar begins
// Of the depth of the fainter side. Two lines are told apart from .26 on (Rayleigh); the grain of a pencil that blur
// has smoothed rises by as much.
constexpr float kLeastPaperRise = 0.4f;
constexpr float kLeastPenRise = 0.28f;  // likewise, of a pen, which has no grain
constexpr float kLeastRiseGrey = 4.0f;  // [grey] noise of the page rises less
constexpr float kThinBarShare = 0.5f;   // of the rise: what is so much darker than both its other sides is a bar
constexpr int kLeastPaperArea = 8;      // [px^2] two pixels of the page

// Of a page as it is: the ink on either side lies within a stroke's width.
constexpr double kReachWidths = 1.25;
constexpr int kMostNarrowPx = 16;
// [stroke widths, as thresholded] Strokes that leave less between them were often drawn over one another; those of
// letters are not.
constexpr double kLeastBetweenWidths = 1.25, kLeastInLetters = 0.5;
// [stroke widths] Half of what two strokes and the paper between them are broad at least, less an octagon's corners.
constexpr double kThickWidths = 0.75;
// Within the ink of a pencil.
constexpr float kClearRise = 0.7f;     // of the depth: blur leaves no more to a hole of one pixel, nor grain to tone
constexpr float kDarkInkShare = 0.5f;  // of the grey of the paper: what is paler may be tone
constexpr int kLeastClearArea = 4;     // [px^2]
constexpr int kTileRows = 64;

struct RayStep {
  int x, y;
  RayStep back() const { return {-x, -y}; }
  RayStep across() const { return {-y, x}; }
};
constexpr std::array<RayStep, 4> kRays{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};

// A part of a page, with as much around it as is looked at.
struct Tile {
  int x0, y0, x1, y1;
};

struct NarrowLimits {
  int reachPx;        // to the ink on either side
  double leastGapPx;  // from ink to ink, somewhere; 0: any
  float leastRise = kLeastPaperRise;
  float mostInkShare = std::numeric_limits<float>::infinity();  // of the grey of the paper, in ink on either side
  int leastArea = kLeastPaperArea;
};

class NarrowPaper {
 public:
  /// @param grey of a part of the page.
  NarrowPaper(const Plane& grey, const Tile& part, const PaperBackground& paper, const NarrowLimits& limits)
      : grey_(grey), part_(part), paper_(paper), limits_(limits) {}

  bool isAt(int pageX, int pageY) const {
    return std::any_of(kRays.begin(), kRays.end(), [&](RayStep ray) { return riseAlong(pageX, pageY, ray) > 0.0f; });
  }

  /// [px] From ink to ink, half way up to the grey here, along the ray on which it is narrowest. @pre isAt()
  double gapAt(int pageX, int pageY) const {
    const int x = pageX - part_.x0, y = pageY - part_.y0;
    double gap = std::numeric_limits<double>::infinity();
    for (const RayStep ray : kRays) {
      const float rise = riseAlong(pageX, pageY, ray);
      if (!(rise > 0.0f)) continue;
      const float half = grey_.row(y)[x] - 0.5f * rise;
      gap = std::min(gap, (darkAfter(x, y, ray, half) + darkAfter(x, y, ray.back(), half)) * std::hypot(ray.x, ray.y));
    }
    return gap;
  }

 private:
  /// [grey] By which it is brighter than the ink on either side along a ray; 0: no narrow paper along that.
  float riseAlong(int pageX, int pageY, RayStep ray) const {
    const int x = pageX - part_.x0, y = pageY - part_.y0;
    const float here = grey_.row(y)[x];
    const auto paper = static_cast<float>(paper_.at(pageX + 0.5, pageY + 0.5));
    const float ink = std::max(darkest(x, y, ray), darkest(x, y, ray.back()));
    const float rise = here - ink;
    if (ink > limits_.mostInkShare * paper) return 0.0f;
    if (rise < std::max(kLeastRiseGrey, limits_.leastRise * (paper - ink))) return 0.0f;
    const RayStep across = ray.across();
    const bool isBar = std::min(brightest(x, y, across), brightest(x, y, across.back())) - here >= kThinBarShare * rise;
    return isBar ? 0.0f : rise;
  }
  template <class Choose>
  float alongRay(int x, int y, RayStep ray, int reach, float value, const Choose& choose) const {
    for (int k = 1; k <= reach; ++k) {
      const int atX = x + k * ray.x, atY = y + k * ray.y;
      if (atX < 0 || atY < 0 || atX >= grey_.width || atY >= grey_.height) break;
      value = choose(value, grey_.row(atY)[atX]);
    }
    return value;
  }
  /// Beyond the page lies no ink.
  float darkest(int x, int y, RayStep ray) const {
    return alongRay(x, y, ray, limits_.reachPx, std::numeric_limits<float>::max(),
                    [](float a, float b) { return std::min(a, b); });
  }
  /// [steps] along a ray to where the grey falls below a level.
  double darkAfter(int x, int y, RayStep ray, float level) const {
    float before = grey_.row(y)[x];
    for (int k = 1; k <= limits_.reachPx; ++k) {
      const int atX = x + k * ray.x, atY = y + k * ray.y;
      if (atX < 0 || atY < 0 || atX >= grey_.width || atY >= grey_.height) break;
      const float value = grey_.row(atY)[atX];
      if (value <= level) return k - 1 + static_cast<double>((before - level) / std::max(before - value, 1e-6f));
      before = value;
    }
    return limits_.reachPx;
  }
  float brightest(int x, int y, RayStep ray) const {
    return alongRay(x, y, ray, kBesidePx, 0.0f, [](float a, float b) { return std::max(a, b); });
  }

  const Plane& grey_;
  Tile part_;
  const PaperBackground& paper_;
  NarrowLimits limits_;
};

int reachOf(double penPx) {
  return std::clamp(static_cast<int>(std::lround(kReachWidths * penPx)), kReachPx, kMostNarrowPx);
}

GreyImage cutOut(const GreyImage& image, const Tile& tile) {
  GreyImage part(tile.x1 - tile.x0, tile.y1 - tile.y0);
  for (int y = tile.y0; y < tile.y1; ++y) std::copy_n(image.row(y) + tile.x0, part.width, part.row(y - tile.y0));
  return part;
}

/// Narrow paper, and that of it which is wide enough to keep a piece of it.
struct OpenedPaper {
  BitImage narrow, wide;
};

/// Sets what is narrow paper among the bits of one word of each of these rows.
class TileOpener {
 public:
  TileOpener(const GreyImage& image, const PaperBackground& paper, const NarrowLimits& limits)
      : image_(image), paper_(paper), limits_(limits), kernel_(gaussianKernel(kVariance)) {}

  void open(const BitImage& candidates, int word, int y0, int y1, OpenedPaper& paper, const RunContext& alone) const {
    std::uint64_t columns = 0;
    for (int y = y0; y < y1; ++y) columns |= candidates.row(y)[word];
    if (columns == 0) return;
    while (candidates.row(y0)[word] == 0) ++y0;
    while (candidates.row(y1 - 1)[word] == 0) --y1;
    const int x0 = 64 * word + std::countr_zero(columns), x1 = 64 * (word + 1) - std::countl_zero(columns);
    const int around = limits_.reachPx + static_cast<int>(kernel_.size());
    const Tile tile{std::max(0, x0 - around), std::max(0, y0 - around), std::min(image_.width, x1 + around),
                    std::min(image_.height, y1 + around)};
    const Plane grey = smooth(shrinkGrey(cutOut(image_, tile), 1, alone), kernel_, alone);
    if (alone.isCancelled()) return;
    const NarrowPaper narrow(grey, tile, paper_, limits_);
    for (int y = y0; y < y1; ++y) {
      for (std::uint64_t bits = candidates.row(y)[word]; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        if (!narrow.isAt(64 * word + bit, y)) continue;
        paper.narrow.row(y)[word] |= std::uint64_t{1} << bit;
        const bool isWide = !(limits_.leastGapPx > 0.0) || narrow.gapAt(64 * word + bit, y) >= limits_.leastGapPx;
        if (isWide) paper.wide.row(y)[word] |= std::uint64_t{1} << bit;
      }
    }
  }

 private:
  const GreyImage& image_;
  const PaperBackground& paper_;
  NarrowLimits limits_;
  std::vector<float> kernel_;
};

BitImage opened(BitImage ink, const BitImage& candidates, const GreyImage& image, const PaperBackground& paper,
                const NarrowLimits& limits, const RunContext& context) {
  const TileOpener opener(image, paper, limits);
  OpenedPaper found{BitImage(ink.width, ink.height), BitImage(ink.width, ink.height)};
  RunContext alone = context;
  alone.threads = 1;
  parallelFor(context, (ink.height + kTileRows - 1) / kTileRows, 1, [&](int begin, int end) {
    for (int y = begin * kTileRows; y < std::min(ink.height, end * kTileRows); y += kTileRows) {
      for (int word = 0; word < ink.wordsPerRow; ++word)
        opener.open(candidates, word, y, std::min(ink.height, y + kTileRows), found, alone);
    }
  });
  if (context.isCancelled()) return ink;
  return without(std::move(ink),
                 keepPieces(found.narrow, {.minArea = limits.leastArea, .seeds = &found.wide}, context));
}

}  // namespace

BitImage withoutNarrowPaper(BitImage ink, const GreyImage& image, const PaperBackground& paper,
                            const RunContext& context) {
  const BitImage candidates = ink;
  return opened(std::move(ink), candidates, image, paper, {kReachPx, 0.0}, context);
}

BitImage withoutClosedPaper(BitImage ink, const GreyImage& image, const PaperBackground& paper, double penPx,
                            const RunContext& context, PaperBetween between) {
  const int reachPx = reachOf(penPx);
  const double leastPx = penPx * (between == PaperBetween::Letters ? kLeastInLetters : kLeastBetweenWidths);
  if (leastPx > 2.0 * reachPx) return ink;  // wider than is looked for
  const int steps = std::max(1, static_cast<int>(kThickWidths * penPx));
  const BitImage thick = shrunken(ink, steps, context);
  if (context.isCancelled() || thick.count() == 0) return ink;
  const BitImage candidates = both(grown(thick, steps, context), ink);
  if (context.isCancelled()) return ink;
  return opened(std::move(ink), candidates, image, paper, {reachPx, leastPx, kLeastPenRise}, context);
}

BitImage clearPaper(const BitImage& ink, const GreyImage& image, const PaperBackground& paper, double penPx,
                    const RunContext& context) {
  const NarrowLimits limits{.reachPx = reachOf(penPx),
                            .leastGapPx = 0.0,
                            .leastRise = kClearRise,
                            .mostInkShare = kDarkInkShare,
                            .leastArea = kLeastClearArea};
  return without(BitImage(ink), opened(ink, ink, image, paper, limits, context));
}

}  // namespace batten
