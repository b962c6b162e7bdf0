// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/tone_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/grown_mask.h"
#include "core/image/threshold/binarize.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {
namespace {

constexpr double kWiderThanLines = 1.25;  // [line widths] half the width of a brush that no line holds
constexpr double kDarkCell = 0.9;         // of the paper near by: a cell that is darker all over
constexpr int kNearCells = 4;             // within which tones end somewhere, and slow changes of the paper are small
constexpr int kWidestBrush = 30;          // [px] a drawing of broader strokes has no lines that tones lie between
constexpr double kLinesDark = 0.6;        // quantile of the darkness of lines: the ends are faint
constexpr double kLineDepth = 0.25;       // of that: what is darker than its ground by so much is line
constexpr double kLongLine = 5.0;         // [line widths] shorter ones are grain

/// A brush: an octagon of nearly `radius`, made of a square and a diamond, which are fast.
struct Brush {
  int square, diamond;
  explicit Brush(int radius)
      : square(static_cast<int>(std::lround(radius / (1.0 + 1.0 / std::sqrt(2.0))))), diamond(radius - square) {}
  cv::Mat1b raise(const cv::Mat1b& grey) const { return passed(grey, true); }
  cv::Mat1b lower(const cv::Mat1b& grey) const { return passed(grey, false); }

 private:
  cv::Mat1b passed(const cv::Mat1b& grey, bool isRaised) const {
    const cv::Mat box = cv::getStructuringElement(cv::MORPH_RECT, {2 * square + 1, 2 * square + 1});
    const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
    const auto pass = isRaised ? static_cast<void (*)(cv::InputArray, cv::OutputArray, cv::InputArray, cv::Point, int,
                                                      int, const cv::Scalar&)>(&cv::dilate)
                               : &cv::erode;
    cv::Mat1b out;
    pass(grey, out, box, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::morphologyDefaultBorderValue());
    pass(out, out, cross, {-1, -1}, diamond, cv::BORDER_CONSTANT, cv::morphologyDefaultBorderValue());
    return out;
  }
};

}  // namespace

GreyImage reducedPage(const GreyImage& page, int factor, const RunContext& context) {
  constexpr int kRows = 16;  // of the copy: one part of the work of the threads
  GreyImage out(page.width / factor, page.height / factor);
  const cv::Mat from(page.height, page.width, CV_16U, const_cast<std::uint16_t*>(page.pixels.data()));
  parallelFor(context, out.height, kRows, [&](int begin, int end) {
    cv::Mat to(end - begin, out.width, CV_16U, out.row(begin));
    cv::resize(from(cv::Rect(0, begin * factor, to.cols * factor, to.rows * factor)), to, to.size(), 0, 0,
               cv::INTER_AREA);
  });
  return out;
}

int brushBeyondLines(double lineWidthPx) { return static_cast<int>(std::ceil(kWiderThanLines * lineWidthPx + 1.0)); }

cv::Mat1b wideInk(const cv::Mat1b& ink, int brush) {
  const Brush round(brush);
  return round.raise(round.lower(ink));
}

cv::Mat1b middleLines(const cv::Mat1f& distance) {
  cv::Mat1f around;
  cv::dilate(distance, around, cv::Mat());
  return (distance >= around - 1e-3f) & (distance > 0.0f);
}

std::optional<double> widthOfLines(const cv::Mat1f& distance, const cv::Mat1b& middle) {
  std::vector<double> halfWidths;
  for (int y = 0; y < middle.rows; ++y)
    for (int x = 0; x < middle.cols; ++x)
      if (middle(y, x) != 0) halfWidths.push_back(distance(y, x));
  if (halfWidths.empty()) return std::nullopt;
  return 2.0 * upperMedian(halfWidths);
}

cv::Mat1b withoutNarrow(const cv::Mat1b& picture, int brush) {
  const Brush round(brush);
  return round.lower(round.raise(picture));
}

cv::Mat1b fromBeside(const cv::Mat1b& picture, const cv::Mat1b& covered) {
  cv::Mat1f distance;
  cv::Mat1i labels;
  cv::distanceTransform(covered, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<std::uint8_t> valueOf(static_cast<std::ptrdiff_t>(labels.total()) + 1, 255);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (covered(y, x) == 0) valueOf[labels(y, x)] = picture(y, x);
  return labelled(labels, valueOf);
}

cv::Mat1b longPieces(const cv::Mat1b& mask, double lengthPx) {
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8, CV_32S);
  std::vector<std::uint8_t> isLong(count, 0);
  for (int k = 1; k < count; ++k)
    if (std::max(stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT)) >= lengthPx)
      isLong[k] = 255;
  return labelled(labels, isLong);
}

cv::Mat1b labelled(const cv::Mat1i& labels, const std::vector<std::uint8_t>& values) {
  cv::Mat1b out(labels.size());
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) out(y, x) = values[labels(y, x)];
  return out;
}

cv::Mat1w paperOver(const cv::Mat1w& cells, int windowCells) {
  const int window = std::max(1, windowCells) | 1;
  cv::Mat1w paper;
  cv::morphologyEx(cells, paper, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {window, window}));
  return paper;
}
ToneCells toneCellsOf(const GreyImage& page) {
  const int columns = page.width / kToneCellPx, rows = page.height / kToneCellPx;
  ToneCells cells;
  cells.brightest = cv::Mat1w::zeros(rows, columns);
  for (int y = 0; y < rows * kToneCellPx; ++y) {
    const std::uint16_t* row = page.row(y);
    std::uint16_t* cell = cells.brightest[y / kToneCellPx];
    for (int i = 0; i < columns; ++i)
      cell[i] = std::max(cell[i], *std::max_element(row + i * kToneCellPx, row + (i + 1) * kToneCellPx));
  }
  const cv::Mat whole(page.height, page.width, CV_16U, const_cast<std::uint16_t*>(page.pixels.data()));
  cv::resize(whole(cv::Rect(0, 0, columns * kToneCellPx, rows * kToneCellPx)), cells.mean, {columns, rows}, 0, 0,
             cv::INTER_AREA);
  return cells;
}

bool mayBeShaded(const ToneCells& cells) {
  const int window = 2 * kNearCells + 1;
  cv::Mat1w around;
  cv::dilate(cells.brightest, around, cv::getStructuringElement(cv::MORPH_RECT, {window, window}));
  const cv::Mat dark = cells.brightest < kDarkCell * around;
  cv::Mat solid;
  cv::erode(dark, solid, cv::getStructuringElement(cv::MORPH_RECT, {2, 2}));
  return cv::countNonZero(solid) > 0;
}

cv::Mat1b flattened(const GreyImage& page, const std::function<double(int x, int y)>& paperAt,
                    const RunContext& context) {
  cv::Mat1b flat(page.height, page.width);
  parallelFor(context, page.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < page.width; ++x)
        flat(y, x) =
            static_cast<std::uint8_t>(std::min(255.0, 255.0 * page.level(x, y) / std::max(1.0, paperAt(x, y)) + 0.5));
  });
  return flat;
}

std::optional<ToneLook> inkOfPage(const GreyImage& page, const RunContext& context, RegionThresholds* found) {
  auto thresholds = findThresholds(page, {}, {}, context);
  if (!thresholds || !thresholds->foundLine) return std::nullopt;
  const auto ink = binarize(page, *thresholds, {}, context);
  if (!ink) return std::nullopt;
  ToneLook look;
  look.ink.create(page.height, page.width);
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) look.ink(y, x) = ink->at(x, y) ? 255 : 0;
  const PaperBackground& paper = thresholds->paper;
  look.flat = flattened(
      page, [&paper](int x, int y) { return paper.at(x + 0.5, y + 0.5); }, context);
  if (found != nullptr) *found = std::move(*thresholds);
  return context.isCancelled() ? std::nullopt : std::optional(std::move(look));
}

double darknessQuantile(const cv::Mat1b& flat, const cv::Mat1b& where, double share) {
  std::array<std::int64_t, 256> counts{};
  std::int64_t all = 0;
  for (int y = 0; y < flat.rows; ++y)
    for (int x = 0; x < flat.cols; ++x)
      if (where(y, x) != 0) ++counts[255 - flat(y, x)], ++all;
  std::int64_t below = 0;
  for (int darkness = 0; darkness < 256; ++darkness)
    if (static_cast<double>(below += counts[darkness]) > share * static_cast<double>(all)) return darkness;
  return 0.0;
}

bool lookAtLines(ToneLook& look, const RunContext& context) {
  cv::Mat1f distance;
  cv::distanceTransform(look.ink, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const cv::Mat1b middle = middleLines(distance);
  const std::optional<double> widthPx = widthOfLines(distance, middle);
  if (!widthPx) return false;
  look.lineWidthPx = *widthPx;
  look.brush = brushBeyondLines(look.lineWidthPx);
  if (look.brush > kWidestBrush) return false;
  const Brush brush(look.brush);
  look.wide = wideInk(look.ink, look.brush);
  if (cv::countNonZero(look.wide) == 0 || context.isCancelled()) return false;
  const cv::Mat1b thin = middle & (grownMask(look.wide, 2) == 0);
  look.lineDarkness =
      darknessQuantile(look.flat, cv::countNonZero(thin) >= kLeastLinePixels ? thin : look.ink, kLinesDark);
  if (context.isCancelled() || !lookAtGround(look, context)) return false;
  look.nearLine = grownMask(longPieces(look.lines, kLongLine * look.lineWidthPx),
                            static_cast<int>(std::ceil(0.5 * look.lineWidthPx + 2.0)));
  look.range = brush.raise(look.ground) - brush.lower(look.ground);
  return !context.isCancelled();
}

bool lookAtGround(ToneLook& look, const RunContext& context) {
  look.ground = withoutNarrow(look.flat, look.brush);
  // What the brush cut off the corners of an area comes back, as far as the brush reaches.
  for (int i = 0; i < look.brush && !context.isCancelled(); ++i) {
    cv::Mat1b lower;
    cv::erode(look.ground, lower, cv::Mat());
    look.ground = cv::max(lower, look.flat);
  }
  const cv::Mat1b depth = look.ground - look.flat;
  look.lines = depth >= std::max(1.0, kLineDepth * look.lineDarkness);
  return !context.isCancelled();
}

}  // namespace batten
