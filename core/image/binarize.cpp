// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/binarize.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/image/faint_lines.h"
#include "core/image/plane.h"
#include "core/image/region_surface.h"
#include "core/image/run_pieces.h"

namespace batten {
namespace {

constexpr double kAutomaticReach = 0.4;  // of the region's contrast; never into the noise of the paper
/// A speck of the default 20 px has a box of 8 px across; other areas in proportion.
constexpr double kDiagonalPerRootArea = 8.0 / 4.472135954999579;

BATTEN_HOT_LOOP void addLevels(const float* paper, const float* contrast, float* __restrict out, int count) {
  for (int i = 0; i < count; ++i) out[i] = paper[i] + contrast[i];
}

BATTEN_HOT_LOOP void flagBelow(const float* grey, const float* level, std::uint8_t* __restrict flags, int count) {
  for (int i = 0; i < count; ++i) flags[i] = grey[i] < level[i] ? 1 : 0;
}

BATTEN_HOT_LOOP void weaken(const float* contrast, float reach, float limit, float* __restrict out, int count) {
  for (int i = 0; i < count; ++i) {
    const float faint = contrast[i] < 0.0f ? reach * contrast[i] : contrast[i];
    const float capped = faint < limit ? faint : limit;
    out[i] = contrast[i] > capped ? contrast[i] : capped;
  }
}

/// Eight flags of 0 or 1 become eight bits by one multiplication. @pre flags holds whole words of 64.
void packRow(const std::uint8_t* flags, int words, std::uint64_t* out) {
  for (int w = 0; w < words; ++w) {
    std::uint64_t word = 0;
    for (int k = 0; k < 8; ++k) {
      std::uint64_t eight;
      std::memcpy(&eight, flags + w * 64 + k * 8, 8);
      word |= ((eight * 0x0102040810204080ull) >> 56) << (8 * k);
    }
    out[w] = word;
  }
}

/// Paper along row y, at the pixel centres, without its folds.
void fillPaperRow(const PaperBackground& paper, int y, int width, std::vector<float>& columns, float* out) {
  if (paper.isEmpty()) {
    std::fill_n(out, width, 255.0f);
    return;
  }
  const double v = std::clamp((y + 0.5) / paper.cellPx - 0.5, 0.0, paper.rows - 1.0);
  const int top = static_cast<int>(v);
  const auto stride = static_cast<std::size_t>(paper.columns);
  const float* above = paper.grey.data() + static_cast<std::size_t>(top) * stride;
  const float* below = paper.grey.data() + static_cast<std::size_t>(std::min(top + 1, paper.rows - 1)) * stride;
  const auto share = static_cast<float>(v - top);
  columns.resize(stride);
  for (std::size_t c = 0; c < stride; ++c) columns[c] = above[c] + share * (below[c] - above[c]);
  const int cell = paper.cellPx, half = cell / 2;
  std::fill_n(out, std::min(half, width), columns[0]);
  const float step = 1.0f / static_cast<float>(cell);
  for (int c = 0; c < paper.columns; ++c) {
    const float left = columns[c];
    const float right = columns[std::min(static_cast<std::size_t>(c) + 1, stride - 1)];
    const float slope = (right - left) * step;
    const int begin = c * cell + half, count = std::min(cell, width - begin);
    for (int k = 0; k < count; ++k) out[begin + k] = left + slope * (static_cast<float>(k) + 0.5f);
  }
}

struct Masks {
  BitImage ink, certain, faint;
};

/// Smooths and compares with the levels, in blocks of rows that stay in the cache.
Masks compareAll(const GreyImage& image, const RegionThresholds& t, const ThresholdParams& params,
                 const RunContext& context) {
  const bool wantFaint = params.reach < 1.0, wantCertain = wantFaint || params.speckArea > 0;
  const auto reach = static_cast<float>(params.reach > 0.0 ? params.reach : kAutomaticReach);
  const BitImage blank(image.width, image.height);
  Masks masks{blank, wantCertain ? blank : BitImage(), wantFaint ? blank : BitImage()};
  const RegionSurface contrast(t.contrast, image.width, image.height, params.interpolate);
  const RegionSurface certain(t.certain, image.width, image.height, params.interpolate);
  const double variance = params.smooth ? t.smoothingPx * t.smoothingPx : 0.0;
  const std::vector<float> kernel = gaussianKernel(variance > 0.0 ? std::max(variance, 0.51) : 0.0);
  const auto radius = static_cast<int>(kernel.size()) - 1;
  const auto width = static_cast<std::size_t>(image.width);
  const int words = masks.ink.wordsPerRow;
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    const int count = end - begin + 2 * radius;
    std::vector<float> padded(width + 2 * static_cast<std::size_t>(radius)),
        strip(width * static_cast<std::size_t>(count));
    std::vector<float> paper(width), step(width), level(width), grey(width), columns;
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(words) * 64, 0);
    std::vector<const float*> rows;
    for (int i = 0; i < count; ++i) {
      float* line = strip.data() + width * static_cast<std::size_t>(i);
      loadGreyRow(image.row(std::clamp(begin - radius + i, 0, image.height - 1)), padded.data(), image.width, radius);
      smoothAlong(padded.data() + radius, line, image.width, kernel);
      rows.push_back(line);
    }
    const auto compare = [&](const float* steps, std::uint64_t* out) {
      addLevels(paper.data(), steps, level.data(), image.width);
      flagBelow(grey.data(), level.data(), flags.data(), image.width);
      packRow(flags.data(), words, out);
    };
    for (int y = begin; y < end; ++y) {
      smoothAcross(rows.data() + (y - begin), grey.data(), image.width, kernel);
      fillPaperRow(t.paper, y, image.width, columns, paper.data());
      contrast.fillRow(y, step.data());
      compare(step.data(), masks.ink.row(y));
      if (wantFaint) {
        weaken(step.data(), reach, static_cast<float>(t.faintLimit), level.data(), image.width);
        std::swap(step, level);
        compare(step.data(), masks.faint.row(y));
      }
      if (wantCertain) {
        certain.fillRow(y, step.data());
        compare(step.data(), masks.certain.row(y));
      }
    }
  });
  return masks;
}

}  // namespace

Result<BitImage> binarize(const GreyImage& image, const RegionThresholds& thresholds, const ThresholdParams& params,
                          const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  try {
    if (image.width <= 0 || image.height <= 0) return BitImage();
    // Folds are taken out before the picture is smoothed: a sharp step and a smoothed one would differ.
    const std::vector<PaperFold>& folds = thresholds.paper.folds;
    const GreyImage flat = folds.empty() ? GreyImage() : withoutFolds(image, folds, context);
    if (context.isCancelled()) return cancelled();
    Masks masks = compareAll(folds.empty() ? image : flat, thresholds, params, context);
    if (context.isCancelled()) return cancelled();
    BitImage ink = std::move(masks.ink);
    if (params.speckArea > 0) {
      const double diagonal = kDiagonalPerRootArea * std::sqrt(static_cast<double>(params.speckArea));
      ink = keepPieces(ink, {.minArea = params.speckArea, .minDiagonal = diagonal, .seeds = &masks.certain}, context);
    }
    if (context.isCancelled()) return cancelled();
    if (params.reach < 1.0) ink = addFaintLines({ink, masks.certain, masks.faint}, context);
    if (context.isCancelled()) return cancelled();
    fillHoles(ink, params.holeArea, context);
    if (context.isCancelled()) return cancelled();
    return ink;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the mask; scan at a lower resolution or crop.");
  }
}

}  // namespace batten
