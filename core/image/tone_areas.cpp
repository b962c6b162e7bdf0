// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tone_areas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/binarize.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {
namespace {

constexpr int kLongestSidePx = 1750;         // of the copy that is searched: lines are still two or three px wide on it
constexpr int kLookPx = 8;                   // of the first look: wider than a line on the copy
constexpr double kPaperOf = 0.25;            // of the page: in so wide a window some paper is seen
constexpr double kDarkCell = 0.93;           // of the paper: a cell that is darker all over
constexpr double kWiderThanLines = 1.25;     // [line widths] half the width of a brush that no line holds
constexpr int kLeastLines = 50;              // [px] of middle lines, to tell how dark lines are
constexpr double kLinesDark = 0.6;           // quantile of the darkness of lines: the ends are faint
constexpr double kLineDepth = 0.25;          // of that: what is darker than its ground by so much is line
constexpr double kLongLine = 5.0;            // [line widths] shorter ones are grain
constexpr double kDarkestTone = 190.0;       // [of 255] darkness on which nothing darker could be drawn
constexpr double kMostOfLines = 0.85;        // of the darkness of the lines on it: what is as dark is a solid
constexpr double kDarkLines = 0.75;          // quantile of the darkness of the lines on an area
constexpr double kSharp = 0.6;               // of the tone's darkness, within a brush: more gradual is a fade
constexpr double kMostBare = 0.4;            // of the border sharp and without a line: more is a shape
constexpr double kMostGrain = 0.35;          // of the area inside darker than its ground: more is hatching or grain
constexpr double kLeastRadius = 2.0;         // [brushes] of the largest circle inside
constexpr std::uint8_t kFaintestTone = 247;  // [of 255] ground up to which an area fades

cv::Mat1b square(int radius) { return cv::Mat1b::ones(2 * radius + 1, 2 * radius + 1); }
cv::Mat1b grown(const cv::Mat1b& mask, int radius) {
  cv::Mat1b out;
  cv::dilate(mask, out, square(radius));
  return out;
}
cv::Mat1b shrunk(const cv::Mat1b& mask, int radius) {
  cv::Mat1b out;
  cv::erode(mask, out, square(radius));
  return out;
}

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

/// Whether cells lie side by side in which no pixel is as bright as the paper around: lines leave some.
bool mayBeShaded(const GreyImage& page) {
  const int columns = page.width / kLookPx, rows = page.height / kLookPx;
  if (columns < 2 || rows < 2) return false;
  cv::Mat1w brightest = cv::Mat1w::zeros(rows, columns);
  for (int y = 0; y < rows * kLookPx; ++y) {
    const std::uint16_t* row = page.row(y);
    std::uint16_t* cell = brightest[y / kLookPx];
    for (int i = 0; i < columns; ++i)
      cell[i] = std::max(cell[i], *std::max_element(row + i * kLookPx, row + (i + 1) * kLookPx));
  }
  cv::Mat1w paper;
  const int wide = std::max(1, static_cast<int>(kPaperOf * std::max(columns, rows)));
  cv::dilate(brightest, paper, cv::getStructuringElement(cv::MORPH_RECT, {wide, wide}));
  const cv::Mat dark = brightest < kDarkCell * paper;
  cv::Mat solid;
  cv::erode(dark, solid, cv::getStructuringElement(cv::MORPH_RECT, {2, 2}));
  return cv::countNonZero(solid) > 0;
}

GreyImage reduced(const GreyImage& page, int factor) {
  GreyImage out(std::max(1, page.width / factor), std::max(1, page.height / factor));
  const cv::Mat from(page.height, page.width, CV_16U, const_cast<std::uint16_t*>(page.pixels.data()));
  cv::Mat to(out.height, out.width, CV_16U, out.pixels.data());
  cv::resize(from(cv::Rect(0, 0, out.width * factor, out.height * factor)), to, to.size(), 0, 0, cv::INTER_AREA);
  return out;
}

/// A page as its search sees it.
struct Look {
  cv::Mat1b flat, ink;      ///< Brightness of the paper's; ink not 0.
  cv::Mat1b ground, lines;  ///< Without what is narrower than the brush; what is clearly darker, not 0.
  cv::Mat1b nearLine;       ///< Not 0 on long lines and beside them.
  cv::Mat1b wide;           ///< Ink that holds the brush.
  cv::Mat1b range;          ///< Of the ground, within a brush.
  int brush = 0;            ///< [px] Its radius.
  double lineWidthPx = 0.0;
};

std::optional<Look> inkOf(const GreyImage& page, const RunContext& context) {
  const auto thresholds = findThresholds(page, {}, {}, context);
  if (!thresholds || !thresholds->foundLine) return std::nullopt;
  const auto ink = binarize(page, *thresholds, {}, context);
  if (!ink) return std::nullopt;
  Look look;
  look.flat.create(page.height, page.width);
  look.ink.create(page.height, page.width);
  parallelFor(context, page.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < page.width; ++x) {
        const double paper = std::max(1.0, thresholds->paper.at(x + 0.5, y + 0.5));
        look.flat(y, x) = static_cast<std::uint8_t>(std::min(255.0, 255.0 * page.level(x, y) / paper + 0.5));
        look.ink(y, x) = ink->at(x, y) ? 255 : 0;
      }
    }
  });
  return context.isCancelled() ? std::nullopt : std::optional(std::move(look));
}

/// The ink's middle lines: where the distance to paper is largest.
cv::Mat1b middleLines(const cv::Mat1f& distance) {
  cv::Mat1f around;
  cv::dilate(distance, around, cv::Mat());
  return (distance >= around - 1e-3f) & (distance > 0.0f);
}

/// Pieces of `mask` that are at least `lengthPx` long.
cv::Mat1b longPieces(const cv::Mat1b& mask, double lengthPx) {
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8, CV_32S);
  std::vector<std::uint8_t> isLong(count, 0);
  for (int k = 1; k < count; ++k)
    if (std::max(stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT)) >= lengthPx)
      isLong[k] = 255;
  cv::Mat1b out(mask.size());
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) out(y, x) = isLong[labels(y, x)];
  return out;
}

double darknessQuantile(const cv::Mat1b& flat, const cv::Mat1b& where, double share) {
  std::vector<double> values;
  for (int y = 0; y < flat.rows; ++y)
    for (int x = 0; x < flat.cols; ++x)
      if (where(y, x) != 0) values.push_back(255.0 - flat(y, x));
  return values.empty() ? 0.0 : lowerQuantile(values, share);
}

/// Adds what is known of lines and of the ground below them. False: no ink is wider than the lines.
bool lookAtLines(Look& look, const RunContext& context) {
  cv::Mat1f distance;
  cv::distanceTransform(look.ink, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const cv::Mat1b middle = middleLines(distance);
  std::vector<double> halfWidths;
  for (int y = 0; y < middle.rows; ++y)
    for (int x = 0; x < middle.cols; ++x)
      if (middle(y, x) != 0) halfWidths.push_back(distance(y, x));
  if (halfWidths.empty()) return false;
  look.lineWidthPx = 2.0 * upperMedian(halfWidths);
  look.brush = static_cast<int>(std::ceil(kWiderThanLines * look.lineWidthPx + 1.0));
  const Brush brush(look.brush);
  look.wide = brush.raise(brush.lower(look.ink));
  if (cv::countNonZero(look.wide) == 0 || context.isCancelled()) return false;
  const cv::Mat1b thin = middle & (grown(look.wide, 2) == 0);
  const double dark = darknessQuantile(look.flat, cv::countNonZero(thin) >= kLeastLines ? thin : look.ink, kLinesDark);
  look.ground = brush.lower(brush.raise(look.flat));
  // What the brush cut off the corners of an area comes back, as far as the brush reaches.
  for (int i = 0; i < look.brush && !context.isCancelled(); ++i) {
    cv::Mat1b lower;
    cv::erode(look.ground, lower, cv::Mat());
    look.ground = cv::max(lower, look.flat);
  }
  const cv::Mat1b depth = look.ground - look.flat;
  look.lines = depth >= std::max(1.0, kLineDepth * dark);
  look.nearLine = grown(longPieces(look.lines, kLongLine * look.lineWidthPx),
                        static_cast<int>(std::ceil(0.5 * look.lineWidthPx + 2.0)));
  look.range = brush.raise(look.ground) - brush.lower(look.ground);
  return !context.isCancelled();
}

/// Whether an area of ink is shading. @param area not 0 inside; the pictures are cut to a box around it.
bool isTone(const cv::Mat1b& area, const Look& look) {
  const double tone = darknessQuantile(look.ground, area, 0.5);
  if (tone > kDarkestTone) return false;
  double radius = 0.0;
  cv::Mat1f distance;
  cv::distanceTransform(area, distance, cv::DIST_L2, cv::DIST_MASK_5);
  cv::minMaxLoc(distance, nullptr, &radius);
  if (radius < kLeastRadius * look.brush) return false;
  const cv::Mat1b inner = shrunk(area, 2), border = area & (shrunk(area, 1) == 0);
  const int innerPx = cv::countNonZero(inner), borderPx = cv::countNonZero(border);
  if (innerPx == 0 || borderPx == 0) return false;
  if (cv::countNonZero(inner & look.lines) > kMostGrain * innerPx) return false;
  const cv::Mat1b bare = border & (look.nearLine == 0) & (look.range >= kSharp * tone);
  if (cv::countNonZero(bare) > kMostBare * borderPx) return false;
  const cv::Mat1b linesOn = look.lines & look.nearLine & grown(area, look.brush);
  if (cv::countNonZero(linesOn) == 0) return true;  // it fades on all sides
  return tone <= kMostOfLines * darknessQuantile(look.flat, linesOn, kDarkLines);
}

Look cutTo(const Look& look, const cv::Rect& box) {
  Look part = look;
  for (cv::Mat1b* picture : {&part.flat, &part.ink, &part.ground, &part.lines, &part.nearLine, &part.wide, &part.range})
    *picture = (*picture)(box);
  return part;
}

/// Areas of wide ink, parted into tones and solids.
struct Parted {
  cv::Mat1b tones, solids;
};
Parted partedAreas(const Look& look, const RunContext& context) {
  Parted parted{cv::Mat1b::zeros(look.wide.size()), cv::Mat1b::zeros(look.wide.size())};
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(look.wide, labels, stats, centres, 8, CV_32S);
  for (int k = 1; k < count && !context.isCancelled(); ++k) {
    cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                 stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const int rim = look.brush + 2;
    box = cv::Rect(box.x - rim, box.y - rim, box.width + 2 * rim, box.height + 2 * rim) &
          cv::Rect({0, 0}, look.wide.size());
    const cv::Mat1b area = labels(box) == k;
    cv::Mat1b to = isTone(area, cutTo(look, box)) ? parted.tones(box) : parted.solids(box);
    to |= area;
  }
  return parted;
}

/// Tones with their fades: what is connected with them and darker than paper, but for solids.
cv::Mat1b withFades(const Parted& parted, const Look& look) {
  const cv::Mat1b faded = ((look.ground < kFaintestTone) & (grown(parted.solids, look.brush) == 0)) | parted.tones;
  cv::Mat1i labels;
  const int count = cv::connectedComponents(faded, labels, 8, CV_32S);
  std::vector<std::uint8_t> isTone(count, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (parted.tones(y, x) != 0) isTone[labels(y, x)] = 255;
  cv::Mat1b out(faded.size());
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) out(y, x) = labels(y, x) == 0 ? 0 : isTone[labels(y, x)];
  return grown(out, look.brush) & (grown(parted.solids, 2) == 0);
}

}  // namespace

std::optional<ToneAreas> findToneAreas(const GreyImage& page, const RunContext& context) {
  if (page.isUniform) return std::nullopt;
  ToneAreas areas;
  areas.pixelsPerPx = (std::max(page.width, page.height) + kLongestSidePx - 1) / kLongestSidePx;
  std::optional<GreyImage> small;
  if (areas.pixelsPerPx > 1) small = reduced(page, areas.pixelsPerPx);
  const GreyImage& searched = small ? *small : page;
  if (context.isCancelled() || !mayBeShaded(searched)) return std::nullopt;
  std::optional<Look> look = inkOf(searched, context);
  if (!look || !lookAtLines(*look, context)) return std::nullopt;
  const Parted parted = partedAreas(*look, context);
  if (context.isCancelled() || cv::countNonZero(parted.tones) == 0) return std::nullopt;
  const cv::Mat1b shaded = withFades(parted, *look);
  // A pixel lower at the borders, where the page has an edge within a pixel of the copy: brighter than paper is
  // nothing.
  cv::Mat1b ground;
  cv::erode(look->ground, ground, cv::Mat());
  ground.setTo(255, shaded == 0);
  areas.columns = ground.cols, areas.rows = ground.rows;
  areas.ground.assign(ground.begin(), ground.end());
  areas.share = static_cast<double>(cv::countNonZero(shaded)) / static_cast<double>(shaded.total());
  return areas;
}

GreyImage withoutTones(const GreyImage& page, const ToneAreas& areas, const RunContext& context) {
  GreyImage out = page;
  const double perPx = areas.pixelsPerPx;
  parallelFor(context, page.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const double v = std::clamp((y + 0.5) / perPx - 0.5, 0.0, areas.rows - 1.0);
      const int j = static_cast<int>(v), below = std::min(j + 1, areas.rows - 1);
      for (int x = 0; x < page.width; ++x) {
        const double u = std::clamp((x + 0.5) / perPx - 0.5, 0.0, areas.columns - 1.0);
        const int i = static_cast<int>(u), right = std::min(i + 1, areas.columns - 1);
        const int a = areas.groundAt(i, j), b = areas.groundAt(right, j);
        const int c = areas.groundAt(i, below), d = areas.groundAt(right, below);
        if ((a & b & c & d) == 255) continue;
        const double upper = a + (u - i) * (b - a), lower = c + (u - i) * (d - c);
        const double tone = std::max(1.0, upper + (v - j) * (lower - upper));
        // No brighter than white: the page's paper may be darker, but not by much more than its tones.
        out.row(y)[x] = static_cast<std::uint16_t>(std::min(65535.0, 255.0 * page.row(y)[x] / tone + 0.5));
      }
    }
  });
  return out;
}

}  // namespace batten
