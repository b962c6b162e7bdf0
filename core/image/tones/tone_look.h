// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

inline constexpr int kToneCellPx = 8;              // side of the cells of the first look: wider than a line
inline constexpr int kLeastLinePixels = 50;        // of middle lines, to tell how dark lines are
inline constexpr double kDarkestTone = 190.0;      // [of 255] darkness on which nothing darker could be drawn
inline constexpr double kMostOfLines = 0.85;       // of the darkness of the lines on it: what is as dark is a solid
inline constexpr std::uint8_t kClearGround = 217;  // [of 255] seen to be shaded
inline constexpr double kMostPaperWindow = 0.5;    // of the page: in so wide a window some paper is seen

/// A copy smaller by a factor, of means.
GreyImage reducedPage(const GreyImage& page, int factor, const RunContext&);

/// The brightness of a page, cell by cell.
struct ToneCells {
  cv::Mat1w brightest;  ///< Grey of the brightest pixel of each cell.
  cv::Mat1w mean;       ///< Of each cell: without the bias of noise.
};
/// @pre at least one cell a side
ToneCells toneCellsOf(const GreyImage&);
/// The paper that a window of so many cells a side sees: areas narrower than it are bridged.
cv::Mat1w paperOver(const cv::Mat1w& cells, int windowCells);
/// Whether cells lie side by side in which no pixel is as bright as the paper near by: lines leave some.
bool mayBeShaded(const ToneCells&);

/// A page as its search sees it.
struct ToneLook {
  cv::Mat1b flat, ink;        ///< Brightness of the paper's; ink not 0.
  cv::Mat1b ground, lines;    ///< Without what is narrower than the brush; what is clearly darker, not 0.
  cv::Mat1b nearLine;         ///< Not 0 on long lines and beside them.
  cv::Mat1b wide;             ///< Ink that holds the brush.
  cv::Mat1b range;            ///< Of the ground, within a brush.
  int brush = 0;              ///< [px] Its radius.
  double lineWidthPx = 0.0;   ///< Of the long lines.
  double lineDarkness = 0.0;  ///< [of 255]
};

/// The ink of a page by automatic thresholds, and its brightness. Absent: there is none, or cancelled.
/// @param thresholds absent, or becomes what they are.
std::optional<ToneLook> inkOfPage(const GreyImage&, const RunContext&, RegionThresholds* thresholds = nullptr);
/// The brightness of a page where the paper is of another: @param paperAt grey 0..255 of the paper at a place in px.
cv::Mat1b flattened(const GreyImage& page, const std::function<double(int x, int y)>& paperAt, const RunContext&);
/// [px] The radius of a brush that no line of this width holds.
int brushBeyondLines(double lineWidthPx);
/// Ink that holds such a brush.
cv::Mat1b wideInk(const cv::Mat1b& ink, int brush);
/// The ink's middle lines: where the distance to paper is largest. @param distance of each pixel of ink.
cv::Mat1b middleLines(const cv::Mat1f& distance);
/// [px] Twice the distance to paper along middle lines, in their middle. Absent: there are none.
std::optional<double> widthOfLines(const cv::Mat1f& distance, const cv::Mat1b& middle);
/// A picture without what is darker and narrower than a brush.
cv::Mat1b withoutNarrow(const cv::Mat1b& picture, int brush);
/// Adds what is known of lines and of the ground below them. False: no ink is wider than the lines, or cancelled.
bool lookAtLines(ToneLook&, const RunContext&);
/// The ground and its lines alone, where the brightness is another; what is near lines stays. False: cancelled.
bool lookAtGround(ToneLook&, const RunContext&);

/// Pieces of a mask whose box is at least `lengthPx` long or high.
cv::Mat1b longPieces(const cv::Mat1b& mask, double lengthPx);
/// A picture, where it is covered that of the nearest place that is not.
cv::Mat1b fromBeside(const cv::Mat1b& picture, const cv::Mat1b& covered);
/// Each pixel by the value of its label.
cv::Mat1b labelled(const cv::Mat1i& labels, const std::vector<std::uint8_t>& values);
/// Of 255 - flat where the mask is not 0; 0 where it is nowhere. @param share 0..1
double darknessQuantile(const cv::Mat1b& flat, const cv::Mat1b& where, double share);

}  // namespace batten
