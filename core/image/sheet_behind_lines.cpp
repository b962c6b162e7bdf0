// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet_behind_lines.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image/grown_mask.h"
#include "core/image/shaded_paper.h"

namespace batten {
namespace {

constexpr int kFewestBehindLine = 12;        // of an area, and of those that lie across a line from the sheet
constexpr double kAlikeAcross = 0.5;         // of these
constexpr int kMostLinesBetween = 8;         // that an area may be parted by from the largest one
constexpr int kLineCells = kSheetEdgeCells;  // a line with the blur at both its sides

/// The cell of the sheet that is nearest to each cell.
class NearestOfSheet {
 public:
  explicit NearestOfSheet(const cv::Mat1b& sheet) : cellOf_(1) {
    cv::Mat1b outside = sheet == 0;
    cv::distanceTransform(outside, distance_, nearest_, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    cellOf_.resize(sheet.total() + 1);
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

bool isAlike(const cv::Vec3f& a, const cv::Vec3f& b) {
  return std::fabs(a[0] - b[0]) <= kMostSheetStep && std::fabs(a[1] - b[1]) <= kMostSheetStep &&
         std::fabs(a[2] - b[2]) <= kMostSheetStep;
}

}  // namespace

cv::Mat1b sheetBehindLines(const cv::Mat1b& even, const cv::Mat1i& areas, const SheetCells& cells) {
  double last = 0.0;
  cv::minMaxLoc(areas, nullptr, &last);
  std::vector<int> size(static_cast<std::size_t>(last) + 1, 0);
  for (const int area : areas) ++size[area];
  cv::Mat1b sheet = even.clone();
  for (int round = 0; round < kMostLinesBetween; ++round) {
    const NearestOfSheet nearest(sheet);
    std::vector<int> across(size.size(), 0), alike(size.size(), 0);
    for (int j = 0; j < sheet.rows; ++j) {
      for (int i = 0; i < sheet.cols; ++i) {
        const cv::Point p(i, j);
        if (sheet(p) != 0 || size[areas(p)] < kFewestBehindLine || !nearest.isWithin(p, kLineCells)) continue;
        ++across[areas(p)];
        alike[areas(p)] += isAlike(cells.colour(p), cells.colour(nearest.at(p))) ? 1 : 0;
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
  // Beyond the picture nothing is sheet that is none within it.
  return shrunkMask(grownMask(sheet, (kLineCells + 1) / 2), (kLineCells + 1) / 2) | sheet;
}

}  // namespace batten
