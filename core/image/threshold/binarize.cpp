// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/binarize.h"

#include <cmath>
#include <new>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/mark_rows.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/threshold/even_strokes.h"
#include "core/image/threshold/faint_lines.h"
#include "core/image/threshold/level_masks.h"
#include "core/image/threshold/lines_in_grain.h"
#include "core/image/threshold/region_values.h"
#include "core/image/threshold/whole_ink.h"

namespace batten {
namespace {

/// A speck of the default 20 px has a box of 8 px across; other areas in proportion.
constexpr const char* kNoMemoryForMask = "Not enough memory for the mask; scan at a lower resolution or crop.";
constexpr double kDiagonalPerRootArea = 8.0 / 4.472135954999579;
constexpr int kRowShare = 4;  // a mark that lies in a row may be so many times smaller than a speck

/// The ink with the dashes and dots of broken lines among the specks that were dropped. @param all what was ink before.
BitImage withRows(BitImage ink, const BitImage& all, const BitImage& certain, int area, const RunContext& context) {
  const PieceRule least{.minArea = (area + kRowShare - 1) / kRowShare, .seeds = &certain};
  const BitImage marks = keepPieces(without(all, ink), least, context);
  if (context.isCancelled() || marks.count() == 0) return ink;
  const BitImage rows = marksInRows(marks, either(ink, marks), context);
  return either(std::move(ink), rows);
}

LevelMasks masksOf(const GreyImage& image, const RegionThresholds& thresholds, const ThresholdParams& params,
                   const RunContext& context) {
  LevelMasks masks = compareWithLevels(image, thresholds, params, context);
  if (!thresholds.finer || !params.smooth || context.isCancelled()) return masks;
  RegionThresholds finer = thresholds;
  finer.smoothingPx = thresholds.finer->smoothingPx;
  finer.contrast = thresholds.finer->contrast;
  finer.certain = thresholds.finer->certain;
  return withWholePieces(std::move(masks), thresholds.smoothingPx, compareWithLevels(image, finer, params, context),
                         context);
}

/// [grey] Below the paper, twice the automatic half level, of the darker regions with edges of their own: others may
/// hold nothing but pale strokes. Absent: the paper was not measured, or no region has such edges.
std::optional<double> inkDepthOf(const GreyImage& image, const RegionThresholds& thresholds,
                                 const ThresholdParams& params) {
  constexpr double kOfDarker = 0.75;  // quantile
  std::vector<double> depths;
  for (int region = 0; region < kRegions && !thresholds.paper.isEmpty(); ++region) {
    if (!thresholds.measured[region]) continue;
    const Vec2 centre = regionCentre(image.width, image.height, region);
    const double contrast = thresholds.paper.at(centre.x(), centre.y()) - thresholds.automatic[region];
    depths.push_back(2.0 * contrast / (params.strength * thresholds.halfLevelShare));
  }
  return depths.empty() ? std::nullopt : std::optional(lowerQuantile(depths, kOfDarker));
}

BitImage withoutNoiseHoles(BitImage ink, int area, const RunContext& context) {
  BitImage filled = ink;
  fillHoles(filled, area, context);
  const auto inked = static_cast<double>(ink.count());
  return static_cast<double>(filled.count()) - inked <= kMeshShare * inked ? std::move(filled) : std::move(ink);
}

}  // namespace

Result<BitImage> binarize(const GreyImage& image, const RegionThresholds& thresholds, const ThresholdParams& params,
                          const RunContext& context, int pixelsPerPx) {
  if (const auto error = validate(params)) return fail(*error);
  try {
    if (image.width <= 0 || image.height <= 0) return BitImage();
    // Folds are taken out before the picture is smoothed: a sharp step and a smoothed one would differ.
    const std::vector<PaperFold>& folds = thresholds.paper.folds;
    const GreyImage flat = folds.empty() ? GreyImage() : withoutFolds(image, folds, context);
    if (context.isCancelled()) return cancelled();
    LevelMasks masks = masksOf(folds.empty() ? image : flat, thresholds, params, context);
    if (context.isCancelled()) return cancelled();
    BitImage ink = masks.ink;
    if (params.speckArea > 0) {
      const double diagonal = kDiagonalPerRootArea * std::sqrt(static_cast<double>(params.speckArea));
      ink = keepPieces(ink, {.minArea = params.speckArea, .minDiagonal = diagonal, .seeds = &*masks.certain}, context);
    }
    if (context.isCancelled()) return cancelled();
    if (params.reach < 1.0) {
      ink = addFaintLines({ink, *masks.certain, *masks.faint}, context, pixelsPerPx);
      if (const auto inkDepth = inkDepthOf(image, thresholds, params))
        ink = addEvenStrokes(std::move(ink), {image, thresholds.paper, *masks.faint, *inkDepth}, context, pixelsPerPx);
    }
    if (context.isCancelled()) return cancelled();
    if (params.speckArea > 0) ink = withRows(std::move(ink), masks.ink, *masks.certain, params.speckArea, context);
    if (context.isCancelled()) return cancelled();
    if (!thresholds.holesArePaper) ink = withoutNoiseHoles(std::move(ink), params.holeArea, context);
    if (context.isCancelled()) return cancelled();
    return ink;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, kNoMemoryForMask);
  }
}

Result<BitImage> binarizePage(const GreyImage& image, const RegionThresholds& thresholds, const ThresholdParams& params,
                              const RunContext& context) {
  Result<BitImage> ink = binarize(image, thresholds, params, context);
  if (!ink || image.width <= 0 || image.height <= 0) return ink;
  try {
    *ink = addLinesInGrain(std::move(*ink), image, thresholds, params, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, kNoMemoryForMask);
  } catch (const cv::Exception& exception) {
    if (exception.code == cv::Error::StsNoMem) return fail(ErrorCode::OutOfMemory, kNoMemoryForMask);
    throw;
  }
  if (context.isCancelled()) return cancelled();
  return ink;
}

}  // namespace batten
