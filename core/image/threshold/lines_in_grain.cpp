// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/lines_in_grain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/gaussian_mean.h"
#include "core/image/grown_mask.h"
#include "core/image/line_means.h"
#include "core/image/plane.h"
#include "core/image/threshold/level_masks.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

// [px] Mean side of the copy that lines are sought on: a page as the eye sees it as a whole.
constexpr double kGrainCopyPx = 1000.0;
// Of that copy: lines of a pencil, and broader strokes.
constexpr std::array<double, 3> kGrainLinePx = {2.5, 5.0, 8.0};
// With a width on top, the standard deviation of the weights along a mean: long ones see a line in the grain, close
// ones whether it is there.
constexpr double kLongPx = 7.0, kClosePx = 1.5;
constexpr double kPaperWindow = 12.0;  // [widths] the same, of surroundings whose grain is alike
constexpr double kBesideInk = 2.0;     // [widths] from ink: farther off means along lines do not see it
constexpr double kLeastBare = 0.2;     // of the page: where less is free of ink, nothing tells the grain
// Of the page's grain: that of the calmest tenth of its surroundings, at least. Paper is alike all over, shading is
// not.
constexpr double kEvenGrain = 0.7, kCalmPart = 0.1;
// [standard deviations of grain] somewhere in a line, and everywhere in it. Of some ten independent directions grain is
// darkest along one.
constexpr double kSureOverGrain = 4.25, kWeakOverGrain = 2.5;
constexpr double kSurePart = 0.2;     // of a line is sure
constexpr double kPartOfReach = 0.4;  // of the contrast that faint lines need without grain
constexpr double kDarkHere = 0.8;     // of a long mean, of the close one: a speck is seen far along, and is not there
constexpr double kRidge = 0.6;        // of the clearest within a width: the line itself
constexpr double kLongLinePx = 40.0;  // [px of the copy]
constexpr double kNewPx = 10.0;       // [px of the copy] of a part of a line that is not ink yet
constexpr int kInkSidePx = 3;         // [px of the copy] from ink to where its blurred side ends

/// A smaller copy of a page.
struct GrainCopy {
  int pixelsPerPx = 1;
  cv::Mat1f level;     ///< [grey] Less the paper, plus 255; specks are no darker than ink.
  cv::Mat1f contrast;  ///< [grey] That ink needs, positive.
  cv::Mat1b ink;       ///< Not 0 where there is some.
};

GrainCopy grainCopyOf(const GreyImage& image, const RegionThresholds& thresholds, const BitImage& ink,
                      const RunContext& context) {
  GrainCopy copy;
  const double sidePx = std::sqrt(static_cast<double>(image.width) * image.height);
  const int step = copy.pixelsPerPx = std::max(1, static_cast<int>(std::lround(sidePx / kGrainCopyPx)));
  const Plane grey = shrinkGrey(image, step, context);
  copy.level.create(grey.height, grey.width);
  copy.contrast.create(grey.height, grey.width);
  copy.ink = cv::Mat1b::zeros(grey.height, grey.width);
  if (context.isCancelled()) return copy;
  const RegionSurface contrast(thresholds.contrast, grey.width, grey.height, true);
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      contrast.fillRow(y, copy.contrast[y]);
      for (int x = 0; x < grey.width; ++x) {
        const float limit = copy.contrast(y, x) = -copy.contrast(y, x);
        const auto paper = static_cast<float>(thresholds.paper.at((x + 0.5) * step, (y + 0.5) * step));
        copy.level(y, x) = 255.0f + std::clamp(grey.row(y)[x] - paper, -limit, limit);
      }
      for (int j = y * step; j < std::min((y + 1) * step, ink.height); ++j)
        for (int x = 0; x < ink.width; ++x)
          if (ink.at(x, j)) copy.ink(y, x / step) = 255;
    }
  });
  return copy;
}

/// The paper free of ink, and means over it.
class BarePaper {
 public:
  BarePaper(const cv::Mat1b& ink, double widthPx) : sigmaPx_(kPaperWindow * widthPx) {
    bare_ = grownMask(ink, static_cast<int>(std::ceil(kBesideInk * widthPx))) == 0;
  }
  bool isSeen() const { return cv::countNonZero(bare_) >= kLeastBare * static_cast<double>(bare_.total()); }
  double mean(const cv::Mat1f& of) const { return cv::mean(of, bare_)[0]; }
  /// In the surroundings of each place.
  cv::Mat1f around(const cv::Mat1f& of) const { return meanOfMasked(of, bare_, sigmaPx_); }
  /// What the grain around each place makes of means along lines.
  cv::Mat1f grainOf(const LineMeans& means) const {
    const cv::Mat1f squares = means.spread.mul(means.spread);
    const cv::Mat1f floored = cv::max(around(squares), kEvenGrain * kEvenGrain * mean(squares));
    cv::Mat1f grain;
    cv::sqrt(floored, grain);
    return grain;
  }
  /// Whether the grain is that of paper.
  bool isAlike(const LineMeans& means) const {
    const cv::Mat1f squares = means.spread.mul(means.spread), near = around(squares);
    std::vector<float> values;
    for (int y = 0; y < near.rows; ++y)
      for (int x = 0; x < near.cols; ++x)
        if (bare_(y, x) != 0) values.push_back(near(y, x));
    return static_cast<double>(lowerQuantile(values, kCalmPart)) >= kEvenGrain * kEvenGrain * mean(squares);
  }

 private:
  double sigmaPx_;
  cv::Mat1b bare_;
};

// A copy half as large.
GrainCopy halved(const GrainCopy& copy) {
  GrainCopy half{2 * copy.pixelsPerPx, {}, {}, {}};
  cv::resize(copy.level, half.level, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::resize(copy.contrast, half.contrast, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::resize(copy.ink, half.ink, {}, 0.5, 0.5, cv::INTER_AREA);
  half.ink = half.ink != 0;
  return half;
}

/// Means along lines of one width, in px of the copy.
struct MeanSizes {
  double widthPx, longPx, closePx;
};

/// How clearly lines stand out, in standard deviations of the grain; 0 where none is. Empty where too little paper is
/// bare, or cancelled.
/// @param mustBeAlike empty, too, where the grain is not that of paper.
cv::Mat1f clearnessOf(const GrainCopy& copy, const MeanSizes& sizes, double reach, bool mustBeAlike,
                      const RunContext& context) {
  const BarePaper paper(copy.ink, sizes.widthPx);
  if (!paper.isSeen()) return {};
  const cv::Mat1b everywhere(copy.level.size(), std::uint8_t{255});
  const LineMeans close = meansAlongLines(copy.level, sizes.widthPx, sizes.closePx, everywhere, context);
  if (context.isCancelled() || (mustBeAlike && !paper.isAlike(close))) return {};
  const LineMeans means = meansAlongLines(copy.level, sizes.widthPx, sizes.longPx, everywhere, context);
  if (context.isCancelled()) return {};
  const cv::Mat1f grain = paper.grainOf(means);
  cv::Mat1f clear = cv::Mat1f::zeros(copy.level.size());
  const cv::Mat1b isThere =
      (means.depth > kPartOfReach * reach * copy.contrast) & (close.depth > kDarkHere * means.depth) & (grain > 0.0f);
  cv::Mat1f(means.depth / grain).copyTo(clear, isThere);
  return clear;
}

/// The same for each of kGrainLinePx, on the whole copy; empty where the grain is not that of paper, or cancelled.
/// Finest lines tell best where the grain is. Broad ones are as well seen on half the copy, at a tenth of the cost.
std::vector<cv::Mat1f> clearnessByWidth(const GrainCopy& copy, double reach, const RunContext& context) {
  std::vector<cv::Mat1f> all;
  const GrainCopy half = halved(copy);
  for (const double widthPx : kGrainLinePx) {
    const bool isFinest = all.empty();
    const double scale = isFinest ? 1.0 : 0.5;
    const MeanSizes sizes{scale * widthPx, scale * (kLongPx + widthPx), scale * (kClosePx + widthPx)};
    cv::Mat1f clear = clearnessOf(isFinest ? copy : half, sizes, reach, isFinest, context);
    if (context.isCancelled() || (clear.empty() && isFinest)) return {};
    if (clear.empty()) clear = cv::Mat1f::zeros(half.level.size());
    if (!isFinest) cv::resize(cv::Mat1f(clear), clear, copy.level.size(), 0.0, 0.0, cv::INTER_LINEAR);
    all.push_back(clear);
  }
  return all;
}

/// Pieces of `weak` long enough, of which enough is sure.
cv::Mat1b longSurePieces(const cv::Mat1b& weak, const cv::Mat1b& sure) {
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(weak, labels, stats, centres, 8, CV_32S);
  std::vector<int> sures(count, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (sure(y, x) != 0) ++sures[labels(y, x)];
  std::vector<bool> isLine(count, false);
  for (int k = 1; k < count; ++k) {
    const double diagonal = std::hypot(stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    isLine[k] = diagonal >= kLongLinePx && sures[k] >= kSurePart * stats.at<int>(k, cv::CC_STAT_AREA);
  }
  cv::Mat1b lines = cv::Mat1b::zeros(weak.size());
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (isLine[labels(y, x)]) lines(y, x) = 255;
  return lines;
}

/// The middle of lines, not 0; empty where there are none, or cancelled.
cv::Mat1b linesInGrain(const GrainCopy& copy, double reach, const RunContext& context) {
  const std::vector<cv::Mat1f> clear = clearnessByWidth(copy, reach, context);
  if (clear.empty()) return {};
  cv::Mat1f clearest = cv::Mat1f::zeros(copy.level.size());
  for (const cv::Mat1f& ofWidth : clear) clearest = cv::max(clearest, ofWidth);
  cv::Mat1b weak = cv::Mat1b::zeros(copy.level.size());
  for (std::size_t i = 0; i < clear.size(); ++i) {
    const int radius = static_cast<int>(std::ceil(kGrainLinePx[i]));
    cv::Mat1f around;
    cv::dilate(clearest, around, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1}));
    weak |= (clear[i] > kWeakOverGrain) & (clear[i] > kRidge * around);
  }
  return longSurePieces(weak, weak & (clearest > kSureOverGrain));
}

BitImage onPage(const cv::Mat1b& lines, int pixelsPerPx, int width, int height) {
  cv::Mat1b wide;
  cv::resize(lines, wide, {}, pixelsPerPx, pixelsPerPx, cv::INTER_LINEAR);
  BitImage bits(width, height);
  for (int y = 0; y < std::min(height, wide.rows); ++y)
    for (int x = 0; x < std::min(width, wide.cols); ++x)
      if (wide(y, x) > 127) bits.set(x, y, true);
  return bits;
}

/// Whether the noise of the paper asks faint lines for more than the reach does, in most regions that hold ink.
bool isHiddenByGrain(const RegionThresholds& thresholds, double reach) {
  std::vector<float> contrasts;
  for (int region = 0; region < kRegions; ++region)
    if (thresholds.measured[region]) contrasts.push_back(static_cast<float>(thresholds.contrast[region]));
  return !contrasts.empty() && thresholds.faintLimit < reach * static_cast<double>(upperMedian(contrasts));
}

}  // namespace

BitImage addLinesInGrain(BitImage ink, const GreyImage& image, const RegionThresholds& thresholds,
                         const ThresholdParams& params, const RunContext& context) {
  const bool isAutomatic = params.mode == ThresholdMode::Automatic && params.reach < 1.0;
  if (!isAutomatic || thresholds.paper.isEmpty() || !thresholds.foundLine) return ink;
  const double reach = params.reach > 0.0 ? params.reach : kAutomaticReach;
  if (!isHiddenByGrain(thresholds, reach)) return ink;
  const GrainCopy copy = grainCopyOf(image, thresholds, ink, context);
  if (context.isCancelled()) return ink;
  const cv::Mat1b lines = linesInGrain(copy, reach, context);
  if (lines.empty() || context.isCancelled()) return ink;
  const BitImage found = onPage(lines, copy.pixelsPerPx, ink.width, ink.height);
  const int sidePx = kInkSidePx * copy.pixelsPerPx;
  const BitImage open = without(found, grown(ink, sidePx, context));
  const BitImage added = keepPieces(open, {.minDiagonal = kNewPx * copy.pixelsPerPx}, context);
  if (context.isCancelled() || added.count() == 0) return ink;
  // The side of ink was left out: where a line runs into ink, it is let through.
  return either(std::move(ink), either(added, both(grown(added, sidePx, context), found)));
}

}  // namespace batten
