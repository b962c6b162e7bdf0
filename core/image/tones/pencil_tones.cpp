// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/pencil_tones.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/image/gaussian_mean.h"
#include "core/image/grown_mask.h"
#include "core/image/tones/pencil_lines.h"
#include "core/image/tones/tone_look.h"

namespace batten {
namespace {

// PencilPage::darknessAlike. A pen has one darkness, a pencil that shades has all: .53 to 1 of ink on drawings, .1 to
// .42 of pencil and charcoal.
constexpr double kMostAlike = 0.47;
constexpr double kFaintestTone = 8.0, kFaintestShare = 0.15;  // [of 255], of the darkness of lines: less is paper
constexpr double kLeastDark = 0.375;  // of the darkness of lines, in the mean: ink that is torn is thresholded there
constexpr double kSharpEnd = 0.4;     // of the darkest at its border: the step within a brush; shades fade farther
// Of the border of a filled area: it ends sharply; of its darkness: standard deviation without what is narrow.
constexpr double kFilledShare = 0.75, kMostUnevenFill = 0.4;
// Of a filled area: the share that is less than half as dark as lines. Where it is more, lines show and paper between.
constexpr double kMostBrightFill = 0.15;
// Mean grain inside a filled area, by that of bare paper, which is no less than the second [of 255] (paper that the
// scanner has turned white has none): strokes show, or paper does.
constexpr double kTornGrain = 3.0, kLeastPaperGrain = 0.5;
constexpr double kLeastBesideTone = 0.15;  // of the length of its border: lines on a tone and beside it
constexpr double kBesideTone = 2.0;        // [widths] from a tone: lines along its border
constexpr double kBesideLines = 1.0;       // [widths] from a line: beyond its blurred border
constexpr double kLeastShownWidths =
    4.0;  // [widths] side of a square as large as what shows of a tone beside its lines
// Of its darkness: the mean deviation. Of lines and paper between them, which are two darknesses, it is twice the share
// of the paper; where they leave less than that, nothing can be told from a tone.
constexpr double kMostUneven = 0.75;
constexpr double kLeastLineGain = 0.8, kMostLineGain = 4.0;  // of lines: more would deepen noise on faint ones
constexpr double kSolidRim = 1.5;                            // [widths] around a solid: its blurred edge stays
constexpr double kGainSigmaWidths = 0.3;                     // [widths] over which the gain changes from lines to tones
constexpr std::uint8_t kPaper = 252;                         // [of 255] what is as bright is left as it is

/// Whether there are places enough that are darker than the paper near by in the mean, whatever grain is in them: where
/// lines cross there are a few. It is asked of every page, and what comes after takes a quarter of a page's time.
bool hasDarkPlaces(const GreyImage& page, const RunContext& context) {
  constexpr int kMeanPx = 4, kWide = 3, kNear = 27;  // [px] side of a mean; [cells] dark all over; of paper near by
  constexpr double kDark = 0.9;
  constexpr int kLeastPlaces = 64;  // a square of 40 px
  const GreyImage cells = reducedPage(page, kMeanPx, context);
  const cv::Mat1w means(cells.height, cells.width, const_cast<std::uint16_t*>(cells.pixels.data()));
  const auto brightest = [&](int side) {
    cv::Mat1w out;
    cv::dilate(means, out, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
    return out;
  };
  return cv::countNonZero(brightest(kWide) < kDark * brightest(kNear)) >= kLeastPlaces;
}

cv::Mat disc(int radius) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1}); }

cv::Mat1b rimOfMask(const cv::Mat1b& mask) { return mask & (shrunkMask(mask, 1) == 0); }

/// For each label the sum of the values where the mask is not 0.
std::vector<double> sumsOf(const cv::Mat1i& labels, int count, const cv::Mat1b& mask, const cv::Mat1f& values) {
  std::vector<double> sums(count, 0.0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (mask(y, x) != 0) sums[labels(y, x)] += static_cast<double>(values(y, x));
  return sums;
}

/// What is black or as dark as the lines beside it, and ends sharply.
cv::Mat1b solidsOf(const PencilPage& page, const cv::Mat1b& shaded, const cv::Mat1b& lineLevel) {
  cv::Mat1f ground, level;
  page.ground.convertTo(ground, CV_32F);
  lineLevel.convertTo(level, CV_32F);
  cv::Mat1b dark = shaded & ((255.0 - ground > kMostOfLines * (255.0 - level)) | (ground < 255.0 - kDarkestTone));
  cv::morphologyEx(dark, dark, cv::MORPH_OPEN, disc(static_cast<int>(std::lround(page.widthPx))));
  const cv::Mat1f calm = gaussianMean(page.level, page.widthPx);
  cv::Mat1f darkest, brightest;
  cv::erode(calm, darkest, disc(page.brush));
  cv::dilate(calm, brightest, disc(page.brush));
  cv::Mat1i labels;
  const int count = cv::connectedComponents(dark, labels, 8, CV_32S);
  const cv::Mat1b border = rimOfMask(dark);
  const std::vector<double> steps = sumsOf(labels, count, border, brightest - darkest);
  const std::vector<double> depths = sumsOf(labels, count, border, 255.0 - darkest);
  std::vector<std::uint8_t> isSolid(count, 0);
  for (int k = 1; k < count; ++k) isSolid[k] = steps[k] >= kSharpEnd * depths[k] ? 255 : 0;
  return labelled(labels, isSolid);
}

/// Areas that somebody filled: beside lines as dark as these in the mean and even without what is narrow, and they end
/// sharply nearly all around. 255 up to where they are half as dark.
struct FilledAreas {
  cv::Mat1b all;
  cv::Mat1b torn;  ///< Of these the ones of hatching or smudging: less even inside than paper is.
};
/// @param unlined not 0 beyond the blurred borders of lines. @param grain [of 255] of the page's level.
FilledAreas filledAreas(const PencilPage& page, const cv::Mat1b& shaded, const cv::Mat1b& unlined,
                        const cv::Mat1f& grain) {
  cv::Mat1f depth, deepest;
  page.ground.convertTo(depth, CV_32F, -1.0, 255.0);
  cv::dilate(depth, deepest, disc(page.brush));
  cv::Mat1i labels;
  const int count = cv::connectedComponents(shaded, labels, 8, CV_32S);
  const auto sums = [&](const cv::Mat1b& where, const cv::Mat1f& values) {
    return sumsOf(labels, count, where, values);
  };
  const cv::Mat1f one = cv::Mat1f::ones(shaded.size());
  const cv::Mat1b border = rimOfMask(shaded), inner = shrunkMask(shaded, page.brush);
  const cv::Mat1b bare = shaded & unlined, dark = depth >= 0.5 * kMostOfLines * page.darkness;
  // Inside, and without the step at the border, which is no grain.
  const cv::Mat1b heart = shrunkMask(shaded & dark, page.brush);
  const cv::Mat1f inside = cv::abs(page.level - meanOfMasked(page.level, heart, page.widthPx));
  const std::vector<double> borders = sums(border, one), sizes = sums(bare, one), inners = sums(inner, one);
  const std::vector<double> ends = sums(border & (deepest >= kLeastDark * page.darkness), one);
  const std::vector<double> darkness = sums(bare, 255.0 - page.level);
  const std::vector<double> depths = sums(inner, depth), squares = sums(inner, depth.mul(depth));
  const std::vector<double> brights = sums(inner & (255.0 - page.level < 0.5 * page.darkness), one);
  const std::vector<double> hearts = sums(heart, one), grains = sums(heart, inside);
  const double grainOfPaper =
      std::max(kLeastPaperGrain, cv::mean(grain, (grownMask(shaded, page.brush) == 0) & unlined)[0]);
  std::vector<std::uint8_t> isFilled(count, 0), isTorn(count, 0);
  for (int k = 1; k < count; ++k) {
    const bool isWide = sizes[k] >= std::pow(kLeastShownWidths * page.widthPx, 2);
    const bool isDark = darkness[k] >= kMostOfLines * page.darkness * sizes[k];
    // The mean square is that of the mean and the variance.
    const bool isEven = squares[k] * inners[k] <= (1.0 + kMostUnevenFill * kMostUnevenFill) * depths[k] * depths[k];
    const bool isFull = brights[k] <= kMostBrightFill * inners[k];
    if (!isWide || !isDark || !isEven || !isFull || ends[k] < kFilledShare * borders[k]) continue;
    isFilled[k] = 255;
    if (grains[k] > kTornGrain * grainOfPaper * hearts[k]) isTorn[k] = 255;
  }
  return {labelled(labels, isFilled) & dark, labelled(labels, isTorn) & dark};
}

/// For each tone the length of the lines on it and beside it. [px]
std::vector<double> linesBeside(const PencilPage& page, const cv::Mat1i& tones, int count, const cv::Mat1b& lines) {
  constexpr double kWidthsOfMask = 1.3;  // the width of a line as it is found
  cv::Mat1f outside;
  cv::Mat1i nearest;
  cv::distanceTransform(tones == 0, outside, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<int> toneOf(static_cast<std::ptrdiff_t>(tones.total()) + 1, 0);
  for (int y = 0; y < tones.rows; ++y)
    for (int x = 0; x < tones.cols; ++x)
      if (tones(y, x) != 0) toneOf[nearest(y, x)] = tones(y, x);
  std::vector<double> lengths(count, 0.0);
  for (int y = 0; y < tones.rows; ++y)
    for (int x = 0; x < tones.cols; ++x)
      if (lines(y, x) != 0 && static_cast<double>(outside(y, x)) < kBesideTone * page.widthPx)
        lengths[toneOf[nearest(y, x)]] += 1.0 / (kWidthsOfMask * page.widthPx);
  return lengths;
}

/// Shaded areas that are wider than lines and have some, and more than these and paper between them.
cv::Mat1b tonesOf(const PencilPage& page, const cv::Mat1b& shaded, const cv::Mat1b& lines, const cv::Mat1b& unlined,
                  const cv::Mat1f& grain) {
  cv::Mat1i labels;
  const int count = cv::connectedComponents(shaded, labels, 8, CV_32S);
  const cv::Mat1f one = cv::Mat1f::ones(shaded.size());
  const cv::Mat1b within = shaded & unlined;
  const std::vector<double> borders = sumsOf(labels, count, rimOfMask(shaded), one);
  const std::vector<double> lined = linesBeside(page, labels, count, lines);
  const std::vector<double> bare = sumsOf(labels, count, within, one);
  const std::vector<double> darkness = sumsOf(labels, count, within, 255.0 - page.level);
  const std::vector<double> grains = sumsOf(labels, count, within, grain);
  std::vector<std::uint8_t> isTone(count, 0);
  for (int k = 1; k < count; ++k) {
    const bool isWide = bare[k] >= std::pow(kLeastShownWidths * page.widthPx, 2);
    const bool isDark = darkness[k] >= kLeastDark * page.darkness * bare[k];
    if (isWide && isDark && lined[k] >= kLeastBesideTone * borders[k] && grains[k] < kMostUneven * darkness[k])
      isTone[k] = 255;
  }
  return labelled(labels, isTone);
}

/// What is left of the depth at each place: little of grain, and lines are as deep as on paper.
cv::Mat1f gainOf(const PencilPage& page, const cv::Mat1b& ground, const cv::Mat1b& lineLevel, const cv::Mat1b& lines,
                 const cv::Mat1b& solids) {
  cv::Mat1f gain(ground.size(), static_cast<float>(ToneAreas::kGrainGain)), depth;
  cv::subtract(ground, lineLevel, depth, cv::noArray(), CV_32F);
  cv::Mat1f ofLines = page.darkness / cv::max(depth, 1.0);
  ofLines = cv::min(cv::max(ofLines, kLeastLineGain), kMostLineGain);
  gain.setTo(1.0f, grownMask(solids, static_cast<int>(std::ceil(kSolidRim * page.widthPx))));
  ofLines.copyTo(gain, lines);
  return gaussianMean(gain, kGainSigmaWidths * page.widthPx);
}

std::vector<std::uint8_t> bytesOf(const cv::Mat1b& picture) { return {picture.begin(), picture.end()}; }

ToneAreas areasOf(const PencilPage& page, const cv::Mat1b& tones, const cv::Mat1b& solids, const cv::Mat1b& lines,
                  const cv::Mat1b& lineLevel) {
  const cv::Mat1b broad = grownMask(lines, static_cast<int>(std::ceil(0.5 * page.widthPx)));
  const cv::Mat1b beside = (broad == 0) & (grownMask(solids, 1) == 0);
  // A line along the border of a tone has tone on one side and paper on the other.
  cv::Mat1b ground = fromBeside(roundedTone(meanOfMasked(page.level, beside, page.widthPx)), beside == 0);
  const cv::Mat1b gain = roundedTone(ToneAreas::kGainUnit * gainOf(page, ground, lineLevel, broad, solids));
  ground.setTo(255, (grownMask(tones, page.brush) & (solids == 0) & (page.smooth < kPaper)) == 0);
  ToneAreas areas;
  areas.columns = ground.cols, areas.rows = ground.rows;
  areas.ground = bytesOf(ground);
  areas.gain = ToneAreas::KnownGain{bytesOf(gain)};
  for (int y = 0; y < ground.rows; ++y)
    for (int x = 0; x < ground.cols; ++x)
      areas.paper.push_back(cv::saturate_cast<std::uint8_t>(page.paper.at(x + 0.5, y + 0.5)));
  areas.share = static_cast<double>(cv::countNonZero(ground < kClearGround)) / static_cast<double>(ground.total());
  return areas;
}

}  // namespace

std::optional<ToneAreas> findPencilTones(const ToneCopy& copy, const RunContext& context) {
  const GreyImage& searched = copy.searched();
  if (context.isCancelled() || !hasDarkPlaces(searched, context)) return std::nullopt;
  const std::optional<PencilPage> look = lookAtPencil(searched, context);
  if (!look || context.isCancelled() || look->darknessAlike > kMostAlike) return std::nullopt;
  const cv::Mat1b shaded = look->ground < 255.0 - std::max(kFaintestTone, kFaintestShare * look->darkness);
  if (cv::countNonZero(shaded) == 0) return std::nullopt;
  const cv::Mat1b lines = linesOnTones(*look, shaded, context);
  if (context.isCancelled() || cv::countNonZero(lines) == 0) return std::nullopt;
  const cv::Mat1b lineLevel = levelOfLines(*look, lines);
  const cv::Mat1b unlined = grownMask(lines, static_cast<int>(std::ceil(kBesideLines * look->widthPx))) == 0;
  const cv::Mat1f grain = cv::abs(look->level - gaussianMean(look->level, look->widthPx));
  const FilledAreas filled = filledAreas(*look, shaded, unlined, grain);
  const cv::Mat1b solids = solidsOf(*look, shaded, lineLevel) | filled.all;
  const cv::Mat1b tones = tonesOf(*look, shaded & (solids == 0), lines, unlined, grain);
  if (context.isCancelled() || cv::countNonZero(tones | filled.torn) == 0) return std::nullopt;
  ToneAreas areas = areasOf(*look, tones, solids, lines, lineLevel);
  areas.pixelsPerPx = copy.pixelsPerPx;
  areas.lineWidthPx = look->widthPx * copy.pixelsPerPx;
  areas.lineDarkness = look->darkness;
  if (cv::countNonZero(filled.torn) > 0) areas.filled = bytesOf(filled.torn);
  return areas;
}

}  // namespace batten
