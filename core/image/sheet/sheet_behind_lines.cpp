// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_behind_lines.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image/grown_mask.h"
#include "core/image/sheet/shaded_paper.h"

namespace batten {
namespace {

constexpr int kFewestBehindLine = 12;        // of an area, and of those that lie across a line from the sheet
constexpr double kAlikeAcross = 0.5;         // of these
constexpr int kMostLinesBetween = 8;         // that an area may be parted by from the largest one
constexpr int kLineCells = kSheetEdgeCells;  // a line with the blur at both its sides

/// The cell of the sheet that is nearest to each cell.
class NearestOfSheet {
 public:
  explicit NearestOfSheet(const cv::Mat1b& sheet) : cellOf_(sheet.total() + 1) {
    cv::distanceTransform(sheet == 0, distance_, nearest_, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    for (int j = 0; j < sheet.rows; ++j)
      for (int i = 0; i < sheet.cols; ++i)
        if (sheet(j, i) != 0) cellOf_[nearest_(j, i)] = {i, j};
  }
  bool isWithin(const cv::Point& p, int cells) const { return distance_(p) <= static_cast<float>(cells); }
  cv::Point at(const cv::Point& p) const { return cellOf_[nearest_(p)]; }

 private:
  cv::Mat1f distance_;
  cv::Mat1i nearest_;
  std::vector<cv::Point> cellOf_;
};

}  // namespace

cv::Mat1b sheetBehindLines(const cv::Mat1b& even, const cv::Mat1i& areas, const std::vector<int>& size,
                           const SheetCells& cells) {
  cv::Mat1b sheet = even.clone();
  for (int round = 0; round < kMostLinesBetween; ++round) {
    const NearestOfSheet nearest(sheet);
    std::vector<int> across(size.size(), 0), alike(size.size(), 0);
    for (int j = 0; j < sheet.rows; ++j) {
      for (int i = 0; i < sheet.cols; ++i) {
        const cv::Point p(i, j);
        if (sheet(p) != 0 || size[areas(p)] < kFewestBehindLine || !nearest.isWithin(p, kLineCells)) continue;
        ++across[areas(p)];
        alike[areas(p)] += isOneSheet(cells.colour(p), cells.colour(nearest.at(p))) ? 1 : 0;
      }
    }
    bool isGrown = false;
    for (int j = 0; j < sheet.rows; ++j) {
      for (int i = 0; i < sheet.cols; ++i) {
        const int area = areas(j, i);
        if (sheet(j, i) != 0 || across[area] < kFewestBehindLine || alike[area] < kAlikeAcross * across[area]) continue;
        sheet(j, i) = 255;
        isGrown = true;
      }
    }
    if (!isGrown) break;
  }
  constexpr int kHalfLine = (kLineCells + 1) / 2;
  return shrunkMask(grownMask(sheet, kHalfLine), kHalfLine);
}

}  // namespace batten
