// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/shaded_paper.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kEqualGrain = 0.05;                              // share: grain so much alike is of one paper
constexpr double kLeastDrawn = 0.003, kLeastDrawnOfSheet = 0.25;  // of a patch, and of what the sheet has drawn on it
constexpr double kLeastInkDepth = 2.0;                            // [grey]
constexpr double kInkSigmas = 4.0;                                // of the noise
constexpr int kBetweenLettersCells = 9;     // across: no letter or stroke of dense ones is broader
constexpr double kLeastShownThrough = 0.5;  // of a patch lies beside paper
constexpr int kLeastLineCells = 8;          // noise makes no line of so many cells

/// Thin lines that are darker than what is around them, by cells.
cv::Mat1b drawnCells(const SheetCells& cells) {
  cv::Mat1f around;
  cv::medianBlur(cells.dark, around, 5);
  const cv::Mat1f depth = around - cells.dark;
  std::vector<float> noise;
  for (const float d : depth) noise.push_back(std::fabs(d));
  const double least = std::max(kLeastInkDepth, kInkSigmas * kSigmaPerMad * static_cast<double>(upperMedian(noise)));
  const cv::Mat1b dark = depth > least;
  cv::Mat1i labels;
  cv::Mat stats, centres;
  cv::connectedComponentsWithStats(dark, labels, stats, centres, 8, CV_32S);
  cv::Mat1b drawn(dark.size(), 0);
  for (int j = 0; j < dark.rows; ++j) {
    for (int i = 0; i < dark.cols; ++i)
      drawn(j, i) = labels(j, i) > 0 && stats.at<int>(labels(j, i), cv::CC_STAT_AREA) >= kLeastLineCells ? 255 : 0;
  }
  return drawn;
}

double shareOf(const cv::Mat1b& drawn, const cv::Mat1b& within) {
  const int all = cv::countNonZero(within);
  return all > 0 ? static_cast<double>(cv::countNonZero(drawn & within)) / all : 0.0;
}

}  // namespace

PaperLook paperLookOf(const cv::Mat1b& sheet, const SheetCells& cells) {
  std::vector<float> roughs;
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.cols; ++i)
      if (sheet(j, i) != 0) roughs.push_back(cells.rough(j, i));
  }
  PaperLook look;
  if (roughs.empty()) return look;
  look.rough = upperMedian(roughs);
  for (int k = 0; k < 3; ++k) {
    std::vector<float> values;
    for (int j = 0; j < sheet.rows; ++j) {
      for (int i = 0; i < sheet.cols; ++i)
        if (sheet(j, i) != 0 && cells.rough(j, i) <= look.rough) values.push_back(cells.colour(j, i)[k]);
    }
    look.colour[k] = upperMedian(values);
  }
  return look;
}

ShadedPaper::ShadedPaper(const cv::Mat1b& sheet, const SheetCells& cells)
    : cells_(cells),
      drawn_(drawnCells(cells)),
      sheet_(sheet),
      mean_(cv::mean(cells.colour, sheet)),
      rough_(cv::mean(cells.rough, sheet)[0]),
      drawnOnSheet_(shareOf(drawn_, sheet)) {
  cv::dilate(sheet, near_, cv::getStructuringElement(cv::MORPH_RECT, {kSheetEdgeCells, kSheetEdgeCells}));
}

bool ShadedPaper::isOne(const cv::Mat1b& patch) const {
  const cv::Scalar mean = cv::mean(cells_.colour, patch);
  if (mean[0] > mean_[0] || mean[0] < kDarkestOnSheet * mean_[0]) return false;
  for (const int k : {1, 2})
    if (std::fabs(mean[k] - mean_[k]) > static_cast<double>(kMostSheetStep)) return false;
  const double grain = cv::mean(cells_.rough, patch)[0] / std::max(rough_, kLeastGrain);
  if (rough_ >= kLeastGrain && std::fabs(grain - 1.0) <= kEqualGrain) return true;
  if (grain > kSameGrain) return false;
  // The edge itself is of neither.
  return isDrawnOn(patch & (near_ == 0));
}

bool ShadedPaper::showsThrough(const cv::Mat1b& patch) const {
  const PaperLook paper = paperLookOf(sheet_, cells_);
  const float grain = static_cast<float>(kSameGrain) * std::max(paper.rough, static_cast<float>(kLeastGrain));
  cv::Mat1b shows(patch.size(), static_cast<unsigned char>(0)), around;
  for (int j = 0; j < patch.rows; ++j) {
    for (int i = 0; i < patch.cols; ++i) {
      if (patch(j, i) == 0 || cells_.rough(j, i) > grain) continue;
      const cv::Vec3f apart = cells_.colour(j, i) - paper.colour;
      if (std::max({std::fabs(apart[0]), std::fabs(apart[1]), std::fabs(apart[2])}) <= kMostSheetStep)
        shows(j, i) = 255;
    }
  }
  cv::dilate(shows, around, cv::getStructuringElement(cv::MORPH_RECT, {kBetweenLettersCells, kBetweenLettersCells}));
  return shareOf(around, patch) >= kLeastShownThrough;
}

bool ShadedPaper::isDrawnOn(const cv::Mat1b& patch) const {
  return shareOf(drawn_, patch) >= std::max(kLeastDrawn, kLeastDrawnOfSheet * drawnOnSheet_);
}

}  // namespace batten
