// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/tone_areas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image/grown_mask.h"
#include "core/image/tones/tone_look.h"

namespace batten {
namespace {

constexpr double kAroundTone = 1.2;             // of the longest tone: the window in which its paper is seen
constexpr double kLineDarknessQuantile = 0.75;  // quantile of the darkness of the lines on an area
constexpr double kSharp = 0.6;                  // of the tone's darkness, within a brush: more gradual is a fade
constexpr double kMostBare = 0.7;               // of the border sharp and without a line: more is a shape
constexpr double kUsualBare = 0.4;              // more needs lines that are half again as dark as the tone
constexpr double kMostOfBareLines = 2.0 / 3.0;
constexpr double kLeastBarePiece = 4.0;    // [brushes] of a bare border that becomes a line
constexpr double kGrainQuantile = 0.9;     // of the depth below the ground beside the lines
constexpr double kMostGrainDepth = 0.375;  // [darkness of lines] what the grain may become: below their half level
constexpr double kMostToneGrain = 0.35;    // of the area inside darker than its ground: more is hatching or grain
constexpr double kLeastLined = 0.3;        // of the border along lines: less is no area that somebody drew lines around
constexpr double kLeastRadius = 2.0;       // [brushes] of the largest circle inside
constexpr int kBlurPx = 1;                 // that a line is blurred over its border, on the copy
constexpr int kSolidEdgePx = 2;            // beyond a solid: its blurred edge
constexpr std::uint8_t kFaintestGround = 247;  // [of 255] up to which an area fades

/// How much of a tone lines may cover.
enum class LinesOnTone { Some, Many };

enum class AreaKind {
  Tone,
  Solid,    ///< Or a shape, hatching or grain: it stays ink.
  Unclear,  ///< Narrow: it goes with the tone that it is part of, if any.
};

/// What is known of an area of ink.
struct Area {
  AreaKind kind = AreaKind::Solid;
  cv::Mat1b bare;         ///< Of a tone: its border where that is sharp and without a line.
  bool isFull = false;    ///< Lines cover more than a third of it.
  double mostGain = 0.0;  ///< Of a tone: see ToneAreas::MostGain.
};

/// What an area of ink is that is nowhere darker than kDarkestTone. @param area not 0 inside; the pictures are cut to a
/// box around it.
Area areaOf(const cv::Mat1b& area, const ToneLook& look, LinesOnTone most) {
  const double darkness = darknessQuantile(look.ground, area, 0.5);
  const cv::Mat1b inner = shrunkMask(area, 2), border = area & (shrunkMask(area, 1) == 0);
  const int borderPx = cv::countNonZero(border);
  if (cv::countNonZero(border & look.nearLine) < kLeastLined * borderPx) return {};
  Area found;
  found.bare = border & (look.nearLine == 0) & (look.range >= kSharp * darkness);
  const int barePx = cv::countNonZero(found.bare);
  if (barePx > kMostBare * borderPx) return {};
  const cv::Mat1b linesOn = look.lines & look.nearLine & grownMask(area, look.brush);
  // The rim of a broad marker's stroke is darker than its inside, and is no line around a tone.
  const double mostOfLines = barePx > kUsualBare * borderPx ? kMostOfBareLines : kMostOfLines;
  if (darkness > mostOfLines * darknessQuantile(look.flat, linesOn, kLineDarknessQuantile)) return {};
  found.isFull = cv::countNonZero(inner & look.lines) > kMostToneGrain * cv::countNonZero(inner);
  if (found.isFull && most == LinesOnTone::Some) return found;
  double radius = 0.0;
  cv::Mat1f distance;
  cv::distanceTransform(area, distance, cv::DIST_L2, cv::DIST_MASK_5);
  cv::minMaxLoc(distance, nullptr, &radius);
  found.kind = radius < kLeastRadius * look.brush ? AreaKind::Unclear : AreaKind::Tone;
  const cv::Mat1b depth = look.ground - look.flat;
  const double grain = darknessQuantile(255 - depth, inner & (look.nearLine == 0), kGrainQuantile);
  found.mostGain = std::max(1.0, kMostGrainDepth * look.lineDarkness / std::max(1.0, grain));
  return found;
}

/// What areaOf() reads of it.
ToneLook cutTo(const ToneLook& look, const cv::Rect& box) {
  ToneLook part = look;
  for (cv::Mat1b* picture : {&part.flat, &part.ground, &part.lines, &part.nearLine, &part.range})
    *picture = (*picture)(box);
  return part;
}

/// Areas of wide ink, parted into tones and solids.
struct Parted {
  cv::Mat1b tones, solids;
  cv::Mat1b full;      ///< Of the tones those that lines cover more than a third of, without their rims.
  cv::Mat1b bare;      ///< Borders of tones that become lines.
  cv::Mat1b mostGain;  ///< Of the tones, see ToneAreas::MostGain.
  int longestPx = 0;   ///< Of the tones.
  bool leavesFull = false;
};
/// [px] From the middle of a line to beyond its blurred border.
int halfLine(const ToneLook& look) { return static_cast<int>(std::ceil(0.5 * look.lineWidthPx)) + kBlurPx; }

void addTone(Parted& parted, const cv::Rect& box, const cv::Mat1b& mask, const Area& area, const ToneLook& look) {
  parted.tones(box) |= mask;
  if (area.isFull) parted.full(box) |= shrunkMask(mask, halfLine(look));
  parted.longestPx = std::max({parted.longestPx, box.width, box.height});
  // A step from tone to tone is none of the drawing's lines.
  const cv::Mat1b byPaper = area.bare & grownMask(look.ground(box) >= kFaintestGround, look.brush);
  parted.bare(box) |= longPieces(byPaper, kLeastBarePiece * look.brush);
  parted.mostGain(box).setTo(std::min(255.0, std::floor(ToneAreas::kGainUnit * area.mostGain)), mask);
}

Parted partedAreas(const ToneLook& look, LinesOnTone most, const RunContext& context) {
  // Black that touches a tone is no part of it.
  const cv::Size size = look.wide.size();
  Parted parted{.tones = cv::Mat1b::zeros(size),
                .solids = look.wide & (look.ground < 255.0 - kDarkestTone),
                .full = cv::Mat1b::zeros(size),
                .bare = cv::Mat1b::zeros(size),
                .mostGain = cv::Mat1b(size, 255)};
  const double mostPx = kMostPaperWindow * std::max(size.height, size.width);  // behind wider ones is no paper
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count =
      cv::connectedComponentsWithStats(look.wide & (parted.solids == 0), labels, stats, centres, 8, CV_32S);
  for (int k = 1; k < count && !context.isCancelled(); ++k) {
    cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                 stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const int rim = look.brush + 2;
    box = cv::Rect(box.x - rim, box.y - rim, box.width + 2 * rim, box.height + 2 * rim) & cv::Rect({0, 0}, size);
    const cv::Mat1b mask = labels(box) == k;
    if (std::min(box.width, box.height) > mostPx) {
      parted.solids(box) |= mask;
      continue;
    }
    const Area area = areaOf(mask, cutTo(look, box), most);
    if (area.kind == AreaKind::Tone) addTone(parted, box, mask, area, look);
    if (area.kind == AreaKind::Solid) {
      parted.solids(box) |= mask;
      parted.leavesFull |= area.isFull;
    }
  }
  return parted;
}

/// Tones with their fades: what is connected with them and darker than paper, but for solids.
cv::Mat1b withFades(const Parted& parted, const ToneLook& look) {
  const cv::Mat1b faded =
      ((look.ground < kFaintestGround) & (grownMask(parted.solids, kSolidEdgePx) == 0)) | parted.tones;
  cv::Mat1i labels;
  const int count = cv::connectedComponents(faded, labels, 8, CV_32S);
  std::vector<std::uint8_t> isTone(count, 0);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (parted.tones(y, x) != 0) isTone[labels(y, x)] = 255;
  const cv::Mat1b out = labelled(labels, isTone);
  // What is not shaded around them is paper already, or belongs to something else.
  return (out | (grownMask(out, look.brush) & (look.ground >= kFaintestGround))) &
         (grownMask(parted.solids, kSolidEdgePx) == 0);
}

/// The ground, below lines that beside them: a line along the border of a tone has tone on one side and paper on the
/// other, and its middle must not move. @param between not 0 where lines lie so close that nothing is beside them.
cv::Mat1b groundBesideLines(const ToneLook& look, const cv::Mat1b& between) {
  // A pixel lower at the borders, where the page has an edge within a pixel of the copy: brighter than paper is
  // nothing.
  const cv::Mat1b ground = shrunkMask(look.ground, 1);
  return fromBeside(ground, grownMask(look.lines, halfLine(look)) & (between == 0));
}

// Pixels of a page along one of the copy: its longer side is no more than 1750 pixels.
int scaleOf(const GreyImage& page) {
  constexpr int kLongestSidePx = 1750;  // of the copy that is searched, which has half of that at least
  return (std::max(page.width, page.height) + kLongestSidePx - 1) / kLongestSidePx;
}

std::optional<ToneAreas> tonesWith(LinesOnTone most, const ToneCopy& copy, const RunContext& context) {
  ToneAreas areas;
  areas.pixelsPerPx = copy.pixelsPerPx;
  const GreyImage& searched = copy.searched();
  const ToneCells cells = toneCellsOf(searched);
  if (context.isCancelled() || !mayBeShaded(cells)) return std::nullopt;
  std::optional<ToneLook> look = inkOfPage(searched, context);
  if (!look || !lookAtLines(*look, context)) return std::nullopt;
  const Parted parted = partedAreas(*look, most, context);
  if (context.isCancelled() || parted.longestPx == 0) return std::nullopt;
  // The paper of the thresholds goes along with wide tones; behind them is that of their surroundings.
  const double windowPx =
      std::min(kAroundTone * parted.longestPx, kMostPaperWindow * std::max(searched.width, searched.height));
  cv::Mat1w paper;
  cv::resize(paperOver(cells.mean, static_cast<int>(windowPx / kToneCellPx) + 1), paper, look->flat.size(), 0, 0,
             cv::INTER_LINEAR);
  look->flat = flattened(
      searched, [&paper](int x, int y) { return paper(y, x) / GreyImage::kGreyUnit; }, context);
  if (context.isCancelled() || !lookAtGround(*look, context)) return std::nullopt;
  const cv::Mat1b shaded = withFades(parted, *look);
  if (context.isCancelled()) return std::nullopt;
  cv::Mat1b ground = groundBesideLines(*look, parted.full);
  ground.setTo(255, shaded == 0);
  if (context.isCancelled() || cv::countNonZero(ground < 255) == 0) return std::nullopt;
  areas.columns = ground.cols, areas.rows = ground.rows;
  areas.ground.assign(ground.begin(), ground.end());
  const cv::Mat1b mostGain = fromBeside(parted.mostGain, parted.tones == 0);
  areas.gain = ToneAreas::MostGain{{mostGain.begin(), mostGain.end()}};
  cv::Mat1b levels;
  paper.convertTo(levels, CV_8U, 1.0 / GreyImage::kGreyUnit);
  areas.paper.assign(levels.begin(), levels.end());
  if (cv::countNonZero(parted.bare) > 0) areas.bare.emplace(parted.bare.begin(), parted.bare.end());
  areas.lineWidthPx = look->lineWidthPx * areas.pixelsPerPx;
  areas.lineDarkness = look->lineDarkness;
  areas.leavesFull = parted.leavesFull;
  areas.share = static_cast<double>(cv::countNonZero(ground < kClearGround)) / static_cast<double>(ground.total());
  return areas;
}

}  // namespace

std::optional<ToneCopy> toneCopyOf(const GreyImage& page, const RunContext& context) {
  if (page.isUniform) return std::nullopt;
  ToneCopy copy{&page, scaleOf(page), std::nullopt};
  // A narrow strip has no shading, and its copy no pixels.
  if (std::min(page.width, page.height) < 2 * kToneCellPx * copy.pixelsPerPx) return std::nullopt;
  if (copy.pixelsPerPx > 1) copy.smaller = reducedPage(page, copy.pixelsPerPx, context);
  return copy;
}

std::optional<ToneAreas> findToneAreas(const ToneCopy& copy, const RunContext& context) {
  return tonesWith(LinesOnTone::Some, copy, context);
}

std::optional<ToneAreas> findToneAreasFullOfLines(const ToneCopy& copy, const RunContext& context) {
  return tonesWith(LinesOnTone::Many, copy, context);
}

}  // namespace batten
