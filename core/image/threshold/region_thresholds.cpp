// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/region_thresholds.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/bits/ink_grain.h"
#include "core/image/plane.h"
#include "core/image/threshold/find_folds.h"
#include "core/image/threshold/grey_parts.h"
#include "core/image/threshold/half_levels.h"
#include "core/image/threshold/ink_edges.h"
#include "core/image/threshold/otsu_thresholds.h"
#include "core/image/threshold/paper_cells.h"
#include "core/image/threshold/plane_ink.h"
#include "core/image/threshold/region_surface.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

constexpr std::int64_t kLargestStatisticsPx = 2'500'000;        // [px] larger pages are shrunk: bounds the time
constexpr int kLargestShrink = 4;                               // and no more than this
constexpr int kCellPx = 8;                                      // of the shrunk page
constexpr double kEdgeVariance = 1.5 * 1.5;                     // [px^2] of the Gaussian under the gradients
constexpr std::array<double, 3> kSmoothings = {1.0, 1.4, 2.0};  // [px]
constexpr double kContrastPerNoise = 5.5;                       // standard deviations of the paper: less is no line
constexpr double kLeastContrastPerNoise = 4.0;                  // the same: no region has less contrast
constexpr double kLinePerNoise = 2.5;   // of the mean over all crests, which is far less noisy than one pixel
constexpr double kLeastVariance = 0.1;  // [px^2 of the shrunk page] below, nothing is smoothed
constexpr double kLeastContrast = 1.5;  // [grey]
constexpr double kDustShare = 0.25;     // of the page's contrast: regions of dust alone do not get below
constexpr double kCertainShare = 1.25;  // of the contrast of a region: darker is certainly ink
constexpr double kTornShare = 0.75;     // of the half level: grains are darker than the stroke that they make up
constexpr double kMorePieces = 1.25;    // of those with more smoothing: it closed gaps
constexpr double kNever = -1000.0;      // [grey] darker than anything
constexpr const char* kBrighterLines = "The lines are brighter than the paper; set paper.lines to brighter.";  // a note
constexpr double kLeastPaper = 0.005;  // of the cells: the paper is measured on no fewer
constexpr int kNoiseSamples = 20000;   // cells that the noise is measured on: bounds the time
constexpr int kDepthsPerBlock = 1024;  // one part of the work of the threads

int shrinkFor(const GreyImage& image) {
  int shrink = 1;
  while (shrink<kLargestShrink&& static_cast<std::int64_t>(image.width) * image.height / (shrink * shrink)>
             kLargestStatisticsPx) {
    shrink *= 2;
  }
  return shrink;
}

/// Variance on the shrunk grid that makes a smoothing of `variancePx` together with the means over the blocks.
double remainingVariance(double variancePx, int shrink) {
  const double block = (shrink * shrink - 1.0) / 12.0;
  return std::max(kLeastVariance, (variancePx - block) / (shrink * shrink));
}

/// The plane smoothed at one place only.
float smoothedAt(const Plane& plane, int x, int y, const std::vector<float>& kernel) {
  const auto radius = static_cast<int>(kernel.size()) - 1;
  float sum = 0.0f;
  for (int j = -radius; j <= radius; ++j) {
    const float* row = plane.row(std::clamp(y + j, 0, plane.height - 1));
    float line = 0.0f;
    for (int i = -radius; i <= radius; ++i) {
      line += kernel[std::abs(i)] * row[std::clamp(x + i, 0, plane.width - 1)];
    }
    sum += kernel[std::abs(j)] * line;
  }
  return sum;
}

struct Depths {
  std::vector<float> atCrests;  ///< Smoothed grey less paper at every crest.
  double noise = 0.0;           ///< Of the smoothed paper.
  double mean = 0.0;            ///< Over the crests, weighted by their strength.
  bool onlyDarker = false;      ///< Crests brighter than the paper are those of highlights and do not count.
  bool counts(std::size_t crest) const { return !onlyDarker || atCrests[crest] <= 0.0f; }
};

Depths measureDepths(const Plane& grey, const InkEdges& edges, const PaperEstimate& estimate, int shrink,
                     const std::vector<float>& kernel, const RunContext& context) {
  Depths depths;
  const PaperBackground& paper = estimate.paper;
  const auto measure = [&](int count, std::vector<float>& out, const auto& placeOf) {
    out.assign(count, 0.0f);
    parallelFor(context, count, kDepthsPerBlock, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto [x, y] = placeOf(i);
        out[i] = smoothedAt(grey, x, y, kernel) - static_cast<float>(paper.at((x + 0.5) * shrink, (y + 0.5) * shrink));
      }
    });
  };
  measure(static_cast<int>(edges.crests.size()), depths.atCrests,
          [&](int i) { return std::pair(edges.crests[i].x, edges.crests[i].y); });
  SignedDepths bySign;
  for (std::size_t i = 0; i < edges.crests.size(); ++i)
    bySign.add(static_cast<double>(edges.crests[i].strength), static_cast<double>(depths.atCrests[i]));
  depths.onlyDarker = bySign.areMixed();
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < edges.crests.size(); ++i) {
    if (!depths.counts(i)) continue;
    sum += static_cast<double>(edges.crests[i].strength * depths.atCrests[i]);
    weight += static_cast<double>(edges.crests[i].strength);
  }
  depths.mean = weight > 0.0 ? sum / weight : 0.0;
  const int cell = paper.cellPx / shrink;
  const auto cells = static_cast<int>(estimate.isPaper.size()), stride = cells / kNoiseSamples + 1;
  std::vector<std::pair<int, int>> places;
  for (int i = 0; i < cells; i += stride) {
    if (estimate.isPaper[i] == 0) continue;
    const int column = i % paper.columns, row = i / paper.columns;
    // A pixel of the cell that changes from cell to cell, so that no grid of the scanner is met in step.
    const int x = column * cell + i % cell * 5 % cell;
    const int y = row * cell + i % cell * 3 % cell;
    if (x < grey.width && y < grey.height) places.emplace_back(x, y);
  }
  std::vector<float> samples;
  measure(static_cast<int>(places.size()), samples, [&](int i) { return places[i]; });
  if (!samples.empty()) depths.noise = robustSigma(samples);
  return depths;
}

struct Contrasts {
  std::array<bool, kRegions> measured{};
  RegionValues contrast{};  ///< [grey]
};

/// Half level of every region from its own crests; regions without are filled from those that have some.
Contrasts contrastsOf(const Plane& grey, const InkEdges& edges, const Depths& depths, double strength) {
  Contrasts out;
  RegionHalfLevels regions;
  for (std::size_t i = 0; i < edges.crests.size(); ++i) {
    if (!depths.counts(i)) continue;
    const EdgePoint& p = edges.crests[i];
    regions.add(regionOf(p.x, p.y, grey.width, grey.height), static_cast<double>(p.strength * depths.atCrests[i]),
                static_cast<double>(p.strength));
  }
  const std::vector<float> filled = regions.filled();
  const double least = std::min(-kLeastContrastPerNoise * depths.noise, -kLeastContrast);
  for (int r = 0; r < kRegions; ++r) {
    out.measured[r] = regions.isMeasured(r);
    const double level = std::min(static_cast<double>(filled[r]), kDustShare * depths.mean) * strength;
    out.contrast[r] = std::min(level, least);
  }
  return out;
}

/// Whether the paper was measured: not where hardly a cell lies free of lines, and not where it came out clearly
/// brighter than any pixel, as from a few cells that the lines of close hatching meet by chance.
bool isPaperSeen(const Plane& grey, const PaperEstimate& estimate) {
  const auto cells = static_cast<double>(std::count(estimate.isPaper.begin(), estimate.isPaper.end(), std::uint8_t{1}));
  if (cells < kLeastPaper * static_cast<double>(estimate.isPaper.size())) return false;
  // On most pages one of the first pixels is as bright.
  const float usual = upperMedian(std::vector<float>(estimate.paper.grey));
  const auto isAsBright = [&](float pixel) { return static_cast<double>(usual - pixel) <= kLeastContrast; };
  for (int y = 0; y < grey.height; ++y)
    if (std::any_of(grey.row(y), grey.row(y) + grey.width, isAsBright)) return true;
  return false;
}

/// Thresholds against the paper.
struct AgainstPaper {
  RegionThresholds thresholds;
  bool isPaperSeen = true;  ///< False: hardly any paper lies free of lines, and its brightness or noise is a guess.
  bool isMean = false;      ///< What was taken for paper is a mean over lines and paper, see variesMoreThanLines.
};

AgainstPaper flattenedThresholds(const Plane& grey, const InkEdges& edges, int shrink, double strength,
                                 const RunContext& context) {
  AgainstPaper found;
  RegionThresholds& out = found.thresholds;
  Contrasts contrasts;
  const int cellPx = kCellPx * std::max(1, shrink / 2);
  PaperEstimate estimate = estimatePaper(grey, edges, shrink, cellPx, context);
  Depths depths;
  double roomPx = kSmoothings.back();
  bool isFirst = true, standsOut = false;
  for (const double q : kSmoothings) {
    if (q > roomPx || context.isCancelled()) break;
    const std::vector<float> kernel = gaussianKernel(remainingVariance(q * q, shrink));
    depths = measureDepths(grey, edges, estimate, shrink, kernel, context);
    out.smoothingPx = q;
    if (std::fabs(depths.mean) < kContrastPerNoise * depths.noise) continue;
    standsOut = true;
    contrasts = contrastsOf(grey, edges, depths, 1.0);
    const InkGrain grain =
        measureGrain(inkOfPlane({grey, estimate.paper, contrasts.contrast, shrink}, kernel, context), context);
    if (grain.perWidth <= kTornInk) break;
    if (std::exchange(isFirst, false)) {
      out.halfLevelShare = kTornShare;
      out.finer = FinerLevels{q, contrastsOf(grey, edges, depths, strength).contrast, {}};
    }
    roomPx = std::min(roomPx, kSmoothingPerWidth * grain.widthPx * shrink);
  }
  // On a page full of fine lines most are too weak for edges, and cells that hold them are taken for noisy paper.
  found.isPaperSeen = standsOut && isPaperSeen(grey, estimate);
  out.paperNoise = depths.noise;
  out.faintLimit = std::min(-kLeastContrastPerNoise * depths.noise, -kLeastContrast);
  out.paper = std::move(estimate.paper);
  const bool enough = edges.crests.size() >= kMinVotes;
  out.foundLine = enough && depths.mean <= -std::max(kLeastContrast, kLinePerNoise * depths.noise);
  if (out.foundLine) {
    found.isMean = variesMoreThanLines(grey, contrastsOf(grey, edges, depths, 1.0).contrast);
    contrasts = contrastsOf(grey, edges, depths, strength * out.halfLevelShare);
  } else {
    out.note = enough && depths.mean > kLeastContrast ? kBrighterLines : "No ink contrast was found.";
    contrasts.contrast.fill(kNever);
  }
  out.measured = contrasts.measured;
  out.contrast = contrasts.contrast;
  return found;
}

RegionThresholds ofCloseLines(RegionThresholds out) {
  out.holesArePaper = true;
  out.note =
      "The lines are too close together to measure the paper between them; each region was "
      "thresholded between its two grey levels.";
  return out;
}

/// Of lines as fine as noise, in most regions: their direction tells. @return absent: there are none, or brighter ones,
/// or the run was cancelled.
std::optional<RegionThresholds> thresholdsOfHatching(const GreyImage& image, double strength,
                                                     const RunContext& context) {
  OtsuThresholds hatching = hatchingThresholds(image, strength, context);
  const bool isSplit = 2 * hatching.split >= kRegions;
  if (context.isCancelled() || !isSplit || 2 * hatching.mostlyDark >= hatching.split) return std::nullopt;
  return ofCloseLines(std::move(hatching.thresholds));
}

/// Where lines stand so close all over the page that hardly any paper shows between them, neither the paper nor its
/// noise can be measured: then the two greys of every region tell ink from paper, as without flattening, if most
/// regions have two clearly different ones. Noise has one, and a shadow or a margin parts few regions. Bright lines on
/// dark paper are told by the greys, too: most of such a page is dark, and the bright part is no net's meshes. Of two
/// smoothings the lesser counts if it parts the greys more clearly, so that it is not noise, and shows more pieces.
/// Where neither parts them, hatching may be finer still.
/// @return absent: the page is none of these, or the run was cancelled.
std::optional<RegionThresholds> thresholdsWithoutPaper(const GreyImage& image, const Plane& smoothed, double strength,
                                                       bool areLinesBrighter, const RunContext& context) {
  OtsuThresholds coarse = otsuThresholds(smoothed, kSmoothings.front(), strength, context);
  OtsuThresholds fine = fineOtsuThresholds(image, strength, context);
  const auto isSplit = [](const OtsuThresholds& regions) { return 2 * regions.split >= kRegions; };
  if (context.isCancelled()) return std::nullopt;
  if (!isSplit(coarse) && !isSplit(fine)) return thresholdsOfHatching(image, strength, context);
  const GreyParts coarseParts = greyPartsOf(image, coarse.thresholds, context),
                  fineParts = greyPartsOf(image, fine.thresholds, context);
  if (context.isCancelled()) return std::nullopt;
  const auto isHatched = [&](const OtsuThresholds& regions, const GreyParts& parts) {
    return isSplit(regions) && (!areLinesBrighter || 2 * regions.mostlyDark < regions.split || parts.hasMeshes);
  };
  const bool isCoarse = isHatched(coarse, coarseParts), isFine = isHatched(fine, fineParts);
  if (!isCoarse && !isFine) return std::nullopt;
  const bool isFiner = fine.separation > coarse.separation &&
                       static_cast<double>(fineParts.pieces) > kMorePieces * static_cast<double>(coarseParts.pieces);
  return ofCloseLines(std::move((isFine && (!isCoarse || isFiner) ? fine : coarse).thresholds));
}

Plane statisticsPlane(const Plane& grey, int shrink, const RunContext& context) {
  return smooth(grey, gaussianKernel(std::max(0.25, remainingVariance(kEdgeVariance, shrink))), context);
}

/// How the statistics are measured on a picture.
struct PlaneScale {
  int shrink = 1;
  double strength = 1.0;
};

/// The folds are taken out of the picture, and the thresholds found on what is left. Unfinished when cancelled.
AgainstPaper thresholdsBesideFolds(const GreyImage& image, std::vector<PaperFold> folds, int shrink, double strength,
                                   const RunContext& context) {
  const Plane grey = shrinkGrey(withoutFolds(image, folds, context), shrink, context);
  if (context.isCancelled()) return {};
  const InkEdges edges = findInkEdges(statisticsPlane(grey, shrink, context), context);
  if (context.isCancelled()) return {};
  AgainstPaper found = flattenedThresholds(grey, edges, shrink, strength, context);
  RegionThresholds& out = found.thresholds;
  if (out.note.empty())
    out.note = folds.size() == 1 ? "A fold or shadow edge across the page was removed."
                                 : "Folds or shadow edges across the page were removed.";
  out.paper.folds = std::move(folds);
  return found;
}

/// With what was taken for folds taken out, unless that was ink: a wall that is drawn right across the page steps like
/// a shadow. Paper on both sides of a fold is one paper once the fold is out, and lines stay darker than it; where they
/// turn out brighter, the dark side was drawn, and stays as it is.
AgainstPaper thresholdsByFolds(const GreyImage& image, const Plane& grey, const InkEdges& edges,
                               std::vector<PaperFold> folds, const PlaneScale& scale, const RunContext& context) {
  const bool anyFold = !folds.empty();
  AgainstPaper out;
  if (anyFold) {
    out = thresholdsBesideFolds(image, std::move(folds), scale.shrink, scale.strength, context);
    const RegionThresholds& beside = out.thresholds;
    if (context.isCancelled() || beside.foundLine || beside.note != kBrighterLines) return out;
  }
  AgainstPaper kept = flattenedThresholds(grey, edges, scale.shrink, scale.strength, context);
  return anyFold && !kept.thresholds.foundLine ? out : kept;
}

/// With the user's own values where set, and the acting contrast everywhere.
RegionThresholds withOwnLevels(const GreyImage& image, const ThresholdParams& params, RegionThresholds out) {
  for (int region = 0; region < kRegions; ++region) {
    const Vec2 centre = regionCentre(image.width, image.height, region);
    const double paper = out.paper.at(centre.x(), centre.y());
    if (!out.paper.isEmpty()) out.automatic[region] = std::clamp(paper + out.contrast[region], 0.0, 255.0);
    out.level[region] = out.automatic[region];
    std::optional<double> own = params.grid[region];
    if (!own && params.mode == ThresholdMode::Manual) own = params.manualLevel;
    if (own) {
      out.level[region] = *own;
      out.contrast[region] = *own - paper;
      out.certain[region] = out.contrast[region];
      if (out.finer) out.finer->contrast[region] = out.finer->certain[region] = out.contrast[region];
    } else if (out.paper.isEmpty()) {
      out.contrast[region] = out.foundLine ? out.automatic[region] - paper : kNever;
      out.certain[region] = out.contrast[region];
    } else {
      out.certain[region] = kCertainShare * out.contrast[region];
      if (out.finer) out.finer->certain[region] = kCertainShare * out.finer->contrast[region];
    }
  }
  return out;
}

std::optional<Error> outOfRange(const char* message) { return Error{ErrorCode::BadParameter, message, {}}; }
bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::optional<Error> validate(const ThresholdParams& params) {
  if (!within(params.manualLevel, 0.0, 255.0)) return outOfRange("The threshold must lie between 0 and 255.");
  if (!within(params.strength, 0.2, 3.0)) return outOfRange("The threshold strength must lie between 0.2 and 3.");
  if (!within(params.reach, 0.0, 1.0)) return outOfRange("The threshold reach must lie between 0 and 1.");
  if (params.speckArea < 0) return outOfRange("The speck area must not be negative.");
  if (params.holeArea < 0) return outOfRange("The hole area must not be negative.");
  for (const auto& level : params.grid) {
    if (level && !within(*level, 0.0, 255.0)) return outOfRange("A region's threshold must lie between 0 and 255.");
  }
  return std::nullopt;
}

Result<RegionThresholds> findThresholds(const GreyImage& image, const PaperParams& paper, const ThresholdParams& params,
                                        const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  if (image.width <= 0 || image.height <= 0) return fail(ErrorCode::BadParameter, "The picture is empty.");
  try {
    RegionThresholds out;
    const int shrink = shrinkFor(image);
    const Plane grey = shrinkGrey(image, shrink, context);
    if (context.isCancelled()) return cancelled();
    const Plane smoothed = statisticsPlane(grey, shrink, context);
    if (context.isCancelled()) return cancelled();
    if (paper.flatten) {
      const InkEdges edges = findInkEdges(smoothed, context);
      if (context.isCancelled()) return cancelled();
      std::vector<PaperFold> folds;
      if (paper.folds) folds = findFolds(image, smoothed, edges, shrink, context);
      if (context.isCancelled()) return cancelled();
      AgainstPaper found = thresholdsByFolds(image, grey, edges, std::move(folds), {shrink, params.strength}, context);
      out = std::move(found.thresholds);
      if (!out.foundLine || !found.isPaperSeen) {
        auto hatched = thresholdsWithoutPaper(image, smoothed, params.strength, out.note == kBrighterLines, context);
        if (hatched) out = std::move(*hatched);
      } else if (found.isMean) {
        auto hatched = thresholdsOfHatching(image, params.strength, context);
        if (hatched) out = std::move(*hatched);
      }
    } else {
      out = otsuThresholds(smoothed, kSmoothings.front(), params.strength, context).thresholds;
      if (!out.foundLine) out.note = "No region holds two clearly different greys.";
    }
    if (context.isCancelled()) return cancelled();
    return withOwnLevels(image, params, std::move(out));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the thresholds; scan at a lower resolution or crop.");
  } catch (const cv::Exception& exception) {
    if (exception.code == cv::Error::StsNoMem)
      return fail(ErrorCode::OutOfMemory, "Not enough memory for the thresholds; scan at a lower resolution or crop.");
    return fail(ErrorCode::Numerical, "The paper could not be measured; turn off Flatten paper.", exception.what());
  }
}

}  // namespace batten
