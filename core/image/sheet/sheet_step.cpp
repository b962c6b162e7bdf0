// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_step.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/image/grown_mask.h"
#include "core/image/sheet/shaded_paper.h"

namespace batten {
namespace {

constexpr int kNearEdgeCells = 3;     // to either side of the border: the edge itself, its shadow and its ragged course
constexpr int kFarCells = 10;         // beyond which shading has time to change
constexpr int kAlongCells = 25;       // of the border that are taken together
constexpr float kStepOfGrain = 1.5f;  // times as rough as on the other side
constexpr double kLeastOfBorder = 0.5;  // of the places of a border
constexpr int kGrowCells = 3;           // at a time
constexpr int kLookCells = 5;           // of which a cell's look is the mean: one by itself is noisy
constexpr double kLeastGrown = 2e-4;    // of the picture, in one round

/// Means of what lies in a strip, within half of `across` cells of every place.
struct StripMeans {
  cv::Mat1f count, rough;
  cv::Mat3f colour;

  StripMeans(const cv::Mat1b& strip, int across, const SheetCells& cells) {
    const auto sumOf = [&](const cv::Mat& values, cv::Mat& out) {
      cv::Mat within = cv::Mat::zeros(values.size(), values.type());
      values.copyTo(within, strip);
      cv::boxFilter(within, out, -1, {across, across}, {-1, -1}, false, cv::BORDER_CONSTANT);
    };
    sumOf(cv::Mat1f(strip.size(), 1.0f), count);
    sumOf(cells.rough, rough);
    sumOf(cells.colour, colour);
  }
  bool isKnown(const cv::Point& p) const { return count(p) > 0.5f; }
  float roughAt(const cv::Point& p) const { return rough(p) / count(p); }
  cv::Vec3f colourAt(const cv::Point& p) const { return colour(p) * (1.0f / count(p)); }
};

/// On one side of a border, near it but not at it.
StripMeans besideBorder(const cv::Mat1b& side, const cv::Mat1b& other, const SheetCells& cells) {
  return {side & grownMask(other, kFarCells) & (grownMask(other, kNearEdgeCells) == 0), kAlongCells, cells};
}

bool isStep(const StripMeans& a, const StripMeans& b, const cv::Point& p) {
  if (!isOneSheet(a.colourAt(p), b.colourAt(p))) return true;
  const auto grain = static_cast<float>(kLeastGrain);
  const auto [smooth, rough] = std::minmax({std::max(a.roughAt(p), grain), std::max(b.roughAt(p), grain)});
  return rough >= kStepOfGrain * smooth;
}

}  // namespace

bool isStepBetween(const cv::Mat1b& sheet, const cv::Mat1b& patch, const SheetCells& cells) {
  const StripMeans ofSheet = besideBorder(sheet, patch, cells), ofPatch = besideBorder(patch, sheet, cells);
  const cv::Mat1b border = patch & grownMask(sheet, 1);
  int seen = 0, steps = 0, all = 0;
  for (int j = 0; j < border.rows; ++j) {
    for (int i = 0; i < border.cols; ++i) {
      const cv::Point p(i, j);
      if (border(p) == 0) continue;
      ++all;
      if (!ofSheet.isKnown(p) || !ofPatch.isKnown(p)) continue;
      ++seen;
      steps += isStep(ofSheet, ofPatch, p) ? 1 : 0;
    }
  }
  // A narrow strip, as the dark rim of a scan, shows nothing beyond its edge: what it is like as a whole decides.
  if (seen < kLeastOfBorder * all) return true;
  return steps > 0 && steps >= kLeastOfBorder * seen;
}

cv::Mat1b slowlyContinued(const cv::Mat1b& sheet, const SheetCells& cells) {
  const StripMeans look(cv::Mat1b(sheet.size(), 255), kLookCells, cells);
  const auto least = static_cast<int>(kLeastGrown * static_cast<double>(sheet.total()));
  cv::Mat1b grown = sheet.clone();
  const int mostRounds = std::max(sheet.rows, sheet.cols) / kGrowCells;
  for (int added = least + 1, round = 0; added > least && round < mostRounds; ++round) {
    const StripMeans beside(grown, kAlongCells, cells);
    const cv::Mat1b next = grownMask(grown, kGrowCells) & (grown == 0);
    added = 0;
    for (int j = 0; j < next.rows; ++j) {
      for (int i = 0; i < next.cols; ++i) {
        const cv::Point p(i, j);
        if (next(p) == 0 || !beside.isKnown(p) || isStep(look, beside, p)) continue;
        grown(p) = 255;
        ++added;
      }
    }
  }
  return grown;
}

}  // namespace batten
