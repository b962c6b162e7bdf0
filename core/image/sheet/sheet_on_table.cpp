// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_on_table.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/grown_mask.h"
#include "core/image/sheet/mask_outline.h"
#include "core/image/sheet/shaded_paper.h"
#include "core/image/sheet/sheet_step.h"

namespace batten {
namespace {

constexpr double kBrighterThanTable = 20.0;  // [grey] the paper, in the middle of its cells
constexpr double kLeastSheetPart = 0.01;     // of the picture: smaller even areas are gaps of a drawing
constexpr double kLeastOnTable = 0.3;        // of the picture
constexpr double kLeastPaperOfSheet = 0.3;   // of the sheet: what the drawing leaves
constexpr double kMostTableOnSheet = 0.03;   // of the sheet: its corners are rounded, its edges ragged
constexpr double kLeastTableBeside = 0.7;    // of what lies beside the sheet: things lie there, too
constexpr double kLeastOfRectangle = 0.9;    // a sheet seen at an angle is no perfect one

// Areas that are brighter than the table and large. Absent: there are none.
std::optional<cv::Mat1b> paperOn(const cv::Mat1i& areas, const std::vector<int>& size, int table,
                                 const SheetCells& cells) {
  const double leastCells = kLeastSheetPart * static_cast<double>(areas.total());
  std::vector<std::vector<float>> levels(size.size());  // of the large areas
  const auto isLarge = [&](int area) { return size[area] >= leastCells; };
  if (std::count_if(size.begin(), size.end(), [&](int cellsOf) { return cellsOf >= leastCells; }) < 2) return {};
  for (int j = 0; j < areas.rows; ++j)
    for (int i = 0; i < areas.cols; ++i)
      if (isLarge(areas(j, i))) levels[areas(j, i)].push_back(cells.colour(j, i)[0]);
  const double least = static_cast<double>(upperMedian(levels[table])) + kBrighterThanTable;
  std::vector<bool> isPaper;
  isPaper.reserve(levels.size());
  for (std::vector<float>& of : levels) isPaper.push_back(!of.empty() && static_cast<double>(upperMedian(of)) >= least);
  cv::Mat1b paper(areas.size(), 0);
  for (int j = 0; j < areas.rows; ++j)
    for (int i = 0; i < areas.cols; ++i) paper(j, i) = isPaper[areas(j, i)] ? 255 : 0;
  return paper;
}

}  // namespace

std::optional<cv::Mat1b> sheetOnTable(const cv::Mat1i& areas, const std::vector<int>& size, int largest,
                                      const SheetCells& cells) {
  const std::optional<cv::Mat1b> found = paperOn(areas, size, largest, cells);
  if (!found) return std::nullopt;
  const cv::Mat1b& paper = *found;
  const double paperCells = cv::countNonZero(paper), all = static_cast<double>(areas.total());
  if (paperCells < kLeastPaperOfSheet * kLeastOnTable * all) return std::nullopt;
  const std::vector<cv::Point> hull = hullOf(paper);
  cv::Mat1b sheet(areas.size(), 0);
  cv::fillConvexPoly(sheet, hull, 255);
  const double sheetCells = cv::countNonZero(sheet);
  const cv::Mat1b table = areas == largest, tableBeside = table & (sheet == 0);
  const double tableOnSheet = cv::countNonZero(table & sheet), besideCells = all - sheetCells;
  if (sheetCells < kLeastOnTable * all || paperCells < kLeastPaperOfSheet * sheetCells) return std::nullopt;
  if (tableOnSheet > kMostTableOnSheet * sheetCells) return std::nullopt;
  if (cv::countNonZero(tableBeside) < kLeastTableBeside * besideCells) return std::nullopt;
  if (sheetCells < kLeastOfRectangle * static_cast<double>(cv::minAreaRect(hull).size.area())) return std::nullopt;
  if (!isStepBetween(paper, tableBeside, cells)) return std::nullopt;
  // A bright panel on toned paper: both have the same grain, and the drawing goes on beside it.
  const float grain = std::max(paperLookOf(paper, cells).rough, static_cast<float>(kLeastGrain));
  const bool isOneGrain = paperLookOf(tableBeside, cells).rough <= static_cast<float>(kSameGrain) * grain;
  if (isOneGrain && ShadedPaper(sheet, cells).isDrawnOn(shrunkMask(tableBeside, kSheetEdgeCells))) return std::nullopt;
  return sheet;
}

}  // namespace batten
