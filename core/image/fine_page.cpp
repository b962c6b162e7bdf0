// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/fine_page.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/ink_grain.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/narrow_paper.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

// Of strokes, twice the area of their ink by its border: the paper between them is as narrow.
constexpr double kThinPx = 3.0;
constexpr double kMayBeThinPx = 6.0;                  // of ink in which thin strokes may have run together
constexpr double kLargestPx = 16e6;                   // of a fine page: its memory is that of a page of A4 at 400 dpi
constexpr int kFineArea = kFineFactor * kFineFactor;  // pixels of a fine page in a pixel of the page
constexpr int kBesideFinePx = 4;  // [fine px] of a stroke: paper that the page's smoothing filled lies no farther off

// Catmull and Rom's cubic a quarter of a pixel from the second of four pixels.
constexpr std::array<float, 4> kQuarter = {-0.0703125f, 0.8671875f, 0.2265625f, -0.0234375f};

// Two values for each of `count`: a quarter of a step before it and a quarter behind it.
template <class At, class Put>
void interpolateQuarters(int count, const At& at, const Put& put) {
  const auto clamped = [&](int i) { return at(std::clamp(i, 0, count - 1)); };
  for (int i = 0; i < count; ++i) {
    const float before = clamped(i - 1), here = clamped(i), after = clamped(i + 1);
    put(2 * i, kQuarter[0] * after + kQuarter[1] * here + kQuarter[2] * before + kQuarter[3] * clamped(i - 2));
    put(2 * i + 1, kQuarter[0] * before + kQuarter[1] * here + kQuarter[2] * after + kQuarter[3] * clamped(i + 2));
  }
}

std::uint16_t toGrey(float value) { return static_cast<std::uint16_t>(std::clamp(value + 0.5f, 0.0f, 65535.0f)); }

bool isNarrower(const BitImage& ink, double limitPx, const RunContext& context) {
  const double width = measureGrain(ink, context).widthPx;
  return width > 0.0 && width < limitPx;
}

// [px] What noise makes is as large in pixels of either page; what is asked for beyond it are pixels of the page.
int beyondNoise(int area, int ofNoise) {
  const int noise = std::min(area, ofNoise);
  return noise + kFineArea * (area - noise);
}

ThresholdParams finer(ThresholdParams params) {
  params.speckArea *= kFineArea;
  params.holeArea = beyondNoise(params.holeArea, ThresholdParams{}.holeArea);
  return params;
}

FilterParams finer(FilterParams params) {
  params.maxChangePx = std::min(beyondNoise(params.maxChangePx, FilterParams{}.maxChangePx), kMostChangePx);
  return params;
}

// Lines of the page's ink that the fine page lacks: less smoothing, more noise. Where strokes stand in the fine ink,
// what the page has beside them is the paper between them.
BitImage withLostLines(BitImage fine, const BitImage& page, const RunContext& context) {
  const BitImage beside = grown(fine, kBesideFinePx, context);
  const BitImage lost = without(page, beside);
  if (context.isCancelled()) return fine;
  return either(std::move(fine), both(grown(lost, kBesideFinePx + 1, context), page));
}

Result<std::optional<FinePage>> makeFinePage(const GreyImage& grey, const BitImage& ink, const InkSettings& settings,
                                             const RunContext& context) {
  FinePage fine;
  fine.grey = std::make_shared<const GreyImage>(enlarged(grey, context));
  if (context.isCancelled()) return cancelled();
  PaperParams paper = settings.paper;
  paper.folds = false;  // they are taken out
  const ThresholdParams params = finer(settings.threshold);
  const Result<RegionThresholds> thresholds = findThresholds(*fine.grey, paper, params, context);
  if (!thresholds) return fail(thresholds.error());
  if (!thresholds->foundLine) return std::nullopt;
  const Result<BitImage> binary = binarize(*fine.grey, *thresholds, params, context, kFineFactor);
  if (!binary) return fail(binary.error());
  Result<FilteredImage> filtered = neighbourhoodFilter(*binary, finer(settings.filter), context);
  if (!filtered) return fail(filtered.error());
  if (!isNarrower(filtered->ink, kFineFactor * kThinPx, context)) return std::nullopt;
  const BitImage page = enlarged(ink, context);
  // What was left out of the ink of the page stays out.
  fine.ink = both(std::move(filtered->ink), grown(page, kFineFactor, context));
  fine.ink = withLostLines(std::move(fine.ink), page, context);
  if (context.isCancelled()) return cancelled();
  fine.ink = withoutNarrowPaper(std::move(fine.ink), *fine.grey, thresholds->paper, context);
  if (context.isCancelled()) return cancelled();
  if (!thresholds->holesArePaper) fillHoles(fine.ink, params.holeArea, context);
  if (context.isCancelled()) return cancelled();
  return std::optional(std::move(fine));
}

}  // namespace

GreyImage enlarged(const GreyImage& grey, const RunContext& context) {
  GreyImage fine(grey.width * kFineFactor, grey.height * kFineFactor);
  std::vector<std::uint16_t> wide(std::ptrdiff_t{fine.width} * grey.height);
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::uint16_t* from = grey.row(y);
      std::uint16_t* to = wide.data() + std::ptrdiff_t{y} * fine.width;
      interpolateQuarters(
          grey.width, [&](int x) { return static_cast<float>(from[x]); },
          [&](int x, float value) { to[x] = toGrey(value); });
    }
  });
  // Columns are worked on in strips, so that a row of a strip stays near.
  constexpr int kStrip = 64;
  parallelFor(context, (fine.width + kStrip - 1) / kStrip, 1, [&](int begin, int end) {
    for (int x = begin * kStrip; x < std::min(fine.width, end * kStrip); ++x) {
      interpolateQuarters(
          grey.height, [&](int y) { return static_cast<float>(wide[std::ptrdiff_t{y} * fine.width + x]); },
          [&](int y, float value) { fine.row(y)[x] = toGrey(value); });
    }
  });
  return fine;
}

BitImage enlarged(const BitImage& ink, const RunContext& context) {
  BitImage fine(ink.width * kFineFactor, ink.height * kFineFactor);
  parallelFor(context, ink.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int i = 0; i < ink.wordsPerRow; ++i) {
        for (std::uint64_t bits = ink.row(y)[i]; bits != 0; bits &= bits - 1) {
          const int x = kFineFactor * (i * 64 + std::countr_zero(bits));
          for (int dy = 0; dy < kFineFactor; ++dy)
            for (int dx = 0; dx < kFineFactor; ++dx) fine.set(x + dx, kFineFactor * y + dy, true);
        }
      }
    }
  });
  return fine;
}

FinePage onInk(const FinePage& fine, const BitImage& ink, const RunContext& context) {
  return {fine.grey, both(fine.ink, grown(enlarged(ink, context), kFineFactor, context))};
}

Result<std::optional<FinePage>> finePage(const GreyImage& grey, const BitImage& ink, const InkSettings& settings,
                                         const RunContext& context) {
  if (double{kFineArea} * grey.width * grey.height > kLargestPx || ink.count() == 0) return std::nullopt;
  try {
    if (!isNarrower(ink, kMayBeThinPx, context)) return std::nullopt;
    if (context.isCancelled()) return cancelled();
    return makeFinePage(grey, ink, settings, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for thin strokes; scan at a lower resolution or crop.");
  }
}

}  // namespace batten
