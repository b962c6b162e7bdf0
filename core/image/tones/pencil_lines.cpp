// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/pencil_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/image/gaussian_mean.h"
#include "core/image/grown_mask.h"
#include "core/image/line_means.h"
#include "core/image/tones/tone_look.h"

namespace batten {
namespace {

// [px] Of lines on the copy that is searched: most of the ink of a shaded drawing may be tones, which tell nothing of
// the width of its lines. On A4, of which the copy has 875 to 1750 px, 4 are .7 to 1.4 mm; broader lines are not found.
constexpr double kLeastLinePx = 2.4, kMostLinePx = 4.0;
constexpr double kInkBlurPx = 0.7;                   // by which ink is broader than its line
constexpr double kThinWidths = 1.25;                 // half the width of ink that is no line
constexpr double kLineQuantile = 0.6;                // of the darkness of thin ink: that of lines
constexpr double kFaintPart = 0.1, kDarkPart = 0.8;  // quantiles of the darkness of all middle lines
constexpr double kMiddleBlur = 0.3;                  // [widths] that keeps the middle of a line
constexpr double kGrainBlur = 0.5;                   // [widths] that grain is lost in
// [widths] standard deviation of the weights along a mean: as long as that lines are straight; at their ends
constexpr double kLongMean = 2.0, kShortMean = 0.8;
constexpr double kGrainWindow = 6.0;   // [widths] standard deviation: in which grain is alike
constexpr double kNoLine = 0.2;        // of the darkness of lines: what is fainter is grain
constexpr double kLongToneLine = 5.0;  // [widths]
constexpr double kOnwards = 3.0;       // [widths] from a line: as far as its long means fade before a corner
// [standard deviations of grain], of the darkness of lines: what is a line; what goes on with one; what ends one. A
// place of grain is darkest along one of some ten independent directions.
struct LineLimit {
  double overGrain, depth;
};
constexpr LineLimit kSureLine{3.5, 0.25}, kWeakLine{2.1, 0.12}, kLineEnd{2.5, 0.3};

int ceiled(double px) { return static_cast<int>(std::ceil(px)); }

/// Pieces of `weak` at least so long that hold a place of `strong`.
cv::Mat1b piecesWith(const cv::Mat1b& weak, const cv::Mat1b& strong, double lengthPx) {
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(weak, labels, stats, centres, 8, CV_32S);
  std::vector<std::uint8_t> kept(count, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (strong(y, x) != 0) kept[labels(y, x)] = 255;
  kept[0] = 0;
  for (int k = 1; k < count; ++k)
    if (std::max(stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT)) < lengthPx) kept[k] = 0;
  return labelled(labels, kept);
}

/// What means of one length see of lines.
struct SeenLines {
  cv::Mat1f depth, overGrain;  // [of 255]; [standard deviations of the grain around]

  cv::Mat1b beyond(const LineLimit& limit, double darkness) const {
    return (overGrain > limit.overGrain) & (depth > limit.depth * darkness);
  }
};

SeenLines seenLines(const PencilPage& page, double alongWidths, const cv::Mat1b& where, const RunContext& context) {
  const LineMeans means = meansAlongLines(page.level, page.widthPx, alongWidths * page.widthPx, where, context);
  const cv::Mat1b isGrain = (means.spread > 0.0f) & (means.depth < kNoLine * page.darkness);
  cv::Mat1f grain;
  cv::sqrt(meanOfMasked(means.spread.mul(means.spread), isGrain, kGrainWindow * page.widthPx), grain);
  constexpr double kLeastToneGrain = 0.1;  // [of 255]
  return {means.depth, means.depth / cv::max(grain, kLeastToneGrain)};
}

}  // namespace

cv::Mat1b roundedTone(const cv::Mat1f& picture) {
  cv::Mat1b out;
  picture.convertTo(out, CV_8U);
  return out;
}

std::optional<PencilPage> lookAtPencil(const GreyImage& searched, const RunContext& context) {
  RegionThresholds thresholds;
  const std::optional<ToneLook> look = inkOfPage(searched, context, &thresholds);
  if (!look) return std::nullopt;
  cv::Mat1f distance;
  cv::distanceTransform(look->ink, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const cv::Mat1b middle = middleLines(distance);
  const std::optional<double> inkPx = widthOfLines(distance, middle);
  if (!inkPx) return std::nullopt;
  PencilPage page;
  page.paper = std::move(thresholds.paper);
  look->flat.convertTo(page.level, CV_32F);
  page.widthPx = std::clamp(*inkPx - kInkBlurPx, kLeastLinePx, kMostLinePx);
  page.brush = brushBeyondLines(page.widthPx);
  const cv::Mat1b calm = roundedTone(gaussianMean(page.level, kMiddleBlur * page.widthPx));
  const cv::Mat1b thin = middle & (distance < kThinWidths * page.widthPx);
  if (cv::countNonZero(thin) < kLeastLinePixels) return std::nullopt;
  page.darkness = darknessQuantile(calm, thin, kLineQuantile);
  page.darknessAlike =
      darknessQuantile(calm, middle, kFaintPart) / std::max(1.0, darknessQuantile(calm, middle, kDarkPart));
  page.smooth = roundedTone(gaussianMean(page.level, kGrainBlur * page.widthPx));
  cv::GaussianBlur(withoutNarrow(page.smooth, page.brush), page.ground, {}, kGrainBlur * page.widthPx, 0.0,
                   cv::BORDER_REPLICATE);
  return page;
}

cv::Mat1b linesOnTones(const PencilPage& page, const cv::Mat1b& shaded, const RunContext& context) {
  const SeenLines seen = seenLines(page, kLongMean, shaded, context);
  if (context.isCancelled()) return cv::Mat1b::zeros(shaded.size());
  const cv::Mat1b weak = seen.beyond(kWeakLine, page.darkness);
  cv::Mat1b lines = piecesWith(weak, seen.beyond(kSureLine, page.darkness), kLongToneLine * page.widthPx);
  // Long means fade towards corners and ends, where shorter ones still see a line.
  const cv::Mat1b near = grownMask(lines, ceiled(kOnwards * page.widthPx));
  const SeenLines close = seenLines(page, kShortMean, near, context);
  if (context.isCancelled()) return lines;
  return piecesWith(lines | (near & close.beyond(kLineEnd, page.darkness)), lines, 0.0);
}

cv::Mat1b levelOfLines(const PencilPage& page, const cv::Mat1b& lines) {
  cv::Mat1f middle = gaussianMean(page.level, kMiddleBlur * page.widthPx);
  middle.setTo(255.0f, lines == 0);
  constexpr double kToMiddle = 0.6, kAlongMiddle = 1.5;  // [widths]
  const int radius = std::max(1, static_cast<int>(std::lround(kToMiddle * page.widthPx)));
  cv::erode(middle, middle, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1}));
  return fromBeside(roundedTone(meanOfMasked(middle, lines, kAlongMiddle * page.widthPx)), lines == 0);
}

}  // namespace batten
