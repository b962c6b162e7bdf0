// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tone_areas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/grown_mask.h"
#include "core/image/tone_look.h"

namespace batten {
namespace {

constexpr int kLongestSidePx = 1750;    // of the copy that is searched, which has half of that at least
constexpr double kAroundTone = 1.2;     // of the longest tone: the window in which its paper is seen
constexpr double kDarkestTone = 190.0;  // [of 255] darkness on which nothing darker could be drawn
constexpr double kMostOfLines = 0.85;   // of the darkness of the lines on it: what is as dark is a solid
constexpr double kDarkLines = 0.75;     // quantile of the darkness of the lines on an area
constexpr double kSharp = 0.6;          // of the tone's darkness, within a brush: more gradual is a fade
constexpr double kMostBare = 0.4;       // of the border sharp and without a line: more is a shape
constexpr double kMostGrain = 0.35;     // of the area inside darker than its ground: more is hatching or grain
constexpr double kLeastLined = 0.3;     // of the border along lines: less is no area that somebody drew lines around
constexpr double kLeastRadius = 2.0;    // [brushes] of the largest circle inside
constexpr int kBlurPx = 1;              // that a line is blurred over its border, on the copy
constexpr int kEdgePx = 2;              // beyond a solid: its blurred edge
constexpr std::uint8_t kFaintestGround = 247;  // [of 255] up to which an area fades
constexpr std::uint8_t kClearGround = 217;     // [of 255] seen to be shaded

GreyImage reduced(const GreyImage& page, int factor, const RunContext& context) {
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

enum class AreaKind {
  Tone,
  Solid,    ///< Or a shape, hatching or grain: it stays ink.
  Unclear,  ///< Narrow: it goes with the tone that it is part of, if any.
};

/// What an area of ink is that is nowhere darker than kDarkestTone. @param area not 0 inside; the pictures are cut to a
/// box around it.
AreaKind kindOf(const cv::Mat1b& area, const ToneLook& look) {
  const double darkness = darknessQuantile(look.ground, area, 0.5);
  const cv::Mat1b inner = shrunkMask(area, 2), border = area & (shrunkMask(area, 1) == 0);
  const int borderPx = cv::countNonZero(border);
  if (cv::countNonZero(border & look.nearLine) < kLeastLined * borderPx) return AreaKind::Solid;
  const cv::Mat1b bare = border & (look.nearLine == 0) & (look.range >= kSharp * darkness);
  if (cv::countNonZero(bare) > kMostBare * borderPx) return AreaKind::Solid;
  const cv::Mat1b linesOn = look.lines & look.nearLine & grownMask(area, look.brush);
  if (darkness > kMostOfLines * darknessQuantile(look.flat, linesOn, kDarkLines)) return AreaKind::Solid;
  if (cv::countNonZero(inner & look.lines) > kMostGrain * cv::countNonZero(inner)) return AreaKind::Solid;
  double radius = 0.0;
  cv::Mat1f distance;
  cv::distanceTransform(area, distance, cv::DIST_L2, cv::DIST_MASK_5);
  cv::minMaxLoc(distance, nullptr, &radius);
  return radius < kLeastRadius * look.brush ? AreaKind::Unclear : AreaKind::Tone;
}

/// What kindOf() reads of it.
ToneLook cutTo(const ToneLook& look, const cv::Rect& box) {
  ToneLook part = look;
  for (cv::Mat1b* picture : {&part.flat, &part.ground, &part.lines, &part.nearLine, &part.range})
    *picture = (*picture)(box);
  return part;
}

/// Areas of wide ink, parted into tones and solids.
struct Parted {
  cv::Mat1b tones, solids;
  int longestPx = 0;  ///< Of the tones.
};
Parted partedAreas(const ToneLook& look, const RunContext& context) {
  // Black that touches a tone is no part of it.
  Parted parted{cv::Mat1b::zeros(look.wide.size()), look.wide & (look.ground < 255.0 - kDarkestTone), 0};
  const double mostPx = kMostPaperWindow * std::max(look.wide.rows, look.wide.cols);  // behind wider ones is no paper
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count =
      cv::connectedComponentsWithStats(look.wide & (parted.solids == 0), labels, stats, centres, 8, CV_32S);
  for (int k = 1; k < count && !context.isCancelled(); ++k) {
    cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                 stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const int rim = look.brush + 2;
    box = cv::Rect(box.x - rim, box.y - rim, box.width + 2 * rim, box.height + 2 * rim) &
          cv::Rect({0, 0}, look.wide.size());
    const cv::Mat1b area = labels(box) == k;
    const AreaKind kind = std::min(box.width, box.height) > mostPx ? AreaKind::Solid : kindOf(area, cutTo(look, box));
    if (kind == AreaKind::Unclear) continue;
    cv::Mat1b to = kind == AreaKind::Tone ? parted.tones(box) : parted.solids(box);
    to |= area;
    if (kind == AreaKind::Tone) parted.longestPx = std::max({parted.longestPx, box.width, box.height});
  }
  return parted;
}

/// Tones with their fades: what is connected with them and darker than paper, but for solids.
cv::Mat1b withFades(const Parted& parted, const ToneLook& look) {
  const cv::Mat1b faded = ((look.ground < kFaintestGround) & (grownMask(parted.solids, kEdgePx) == 0)) | parted.tones;
  cv::Mat1i labels;
  const int count = cv::connectedComponents(faded, labels, 8, CV_32S);
  std::vector<std::uint8_t> isTone(count, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (parted.tones(y, x) != 0) isTone[labels(y, x)] = 255;
  const cv::Mat1b out = labelled(labels, isTone);
  // What is not shaded around them is paper already, or belongs to something else.
  return (out | (grownMask(out, look.brush) & (look.ground >= kFaintestGround))) &
         (grownMask(parted.solids, kEdgePx) == 0);
}

/// The ground, below lines that of the nearest place beside them: a line along the border of a tone has tone on one
/// side and paper on the other, and its middle must not move.
cv::Mat1b groundBesideLines(const ToneLook& look) {
  // A pixel lower at the borders, where the page has an edge within a pixel of the copy: brighter than paper is
  // nothing.
  const cv::Mat1b ground = shrunkMask(look.ground, 1);
  const cv::Mat1b covered = grownMask(look.lines, static_cast<int>(std::ceil(0.5 * look.lineWidthPx)) + kBlurPx);
  cv::Mat1f distance;
  cv::Mat1i labels;
  cv::distanceTransform(covered, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<std::uint8_t> groundOf(static_cast<std::ptrdiff_t>(labels.total()) + 1, 255);
  for (int y = 0; y < ground.rows; ++y)
    for (int x = 0; x < ground.cols; ++x)
      if (covered(y, x) == 0) groundOf[labels(y, x)] = ground(y, x);
  return labelled(labels, groundOf);
}

}  // namespace

std::optional<ToneAreas> findToneAreas(const GreyImage& page, const RunContext& context) {
  if (page.isUniform) return std::nullopt;
  ToneAreas areas;
  areas.pixelsPerPx = (std::max(page.width, page.height) + kLongestSidePx - 1) / kLongestSidePx;
  // A narrow strip has no shading, and its copy no pixels.
  if (std::min(page.width, page.height) < 2 * kToneCellPx * areas.pixelsPerPx) return std::nullopt;
  std::optional<GreyImage> small;
  if (areas.pixelsPerPx > 1) small = reduced(page, areas.pixelsPerPx, context);
  const GreyImage& searched = small ? *small : page;
  const ToneCells cells = toneCellsOf(searched);
  if (context.isCancelled() || !mayBeShaded(cells)) return std::nullopt;
  std::optional<ToneLook> look = inkOfPage(searched, context);
  if (!look || !lookAtLines(*look, context)) return std::nullopt;
  const Parted parted = partedAreas(*look, context);
  if (context.isCancelled() || parted.longestPx == 0) return std::nullopt;
  // The paper of the thresholds goes along with wide tones; behind them is that of their surroundings.
  const double windowPx =
      std::min(kAroundTone * parted.longestPx, kMostPaperWindow * std::max(searched.width, searched.height));
  cv::Mat1w paper;
  cv::resize(paperOver(cells.mean, static_cast<int>(windowPx / kToneCellPx) + 1), paper, look->flat.size(), 0, 0,
             cv::INTER_LINEAR);
  flattenTo(
      look->flat, searched, [&paper](int x, int y) { return paper(y, x) / GreyImage::kGreyUnit; }, context);
  if (context.isCancelled() || !lookAtGround(*look, context)) return std::nullopt;
  const cv::Mat1b shaded = withFades(parted, *look);
  if (context.isCancelled()) return std::nullopt;
  cv::Mat1b ground = groundBesideLines(*look);
  ground.setTo(255, shaded == 0);
  if (context.isCancelled() || cv::countNonZero(ground < 255) == 0) return std::nullopt;
  areas.columns = ground.cols, areas.rows = ground.rows;
  areas.ground.assign(ground.begin(), ground.end());
  areas.share = static_cast<double>(cv::countNonZero(ground < kClearGround)) / static_cast<double>(ground.total());
  return areas;
}

GreyImage withoutTones(GreyImage page, const ToneAreas& areas, const RunContext& context) {
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
        const double ground = std::max(1.0, upper + (v - j) * (lower - upper));
        page.row(y)[x] = static_cast<std::uint16_t>(std::min(65535.0, 255.0 * page.row(y)[x] / ground + 0.5));
      }
    }
  });
  return page;
}

}  // namespace batten
