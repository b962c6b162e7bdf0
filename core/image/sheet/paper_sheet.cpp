// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/paper_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/image/sheet/facing_pages.h"
#include "core/image/sheet/mask_outline.h"
#include "core/image/sheet/shaded_paper.h"
#include "core/image/sheet/sheet_behind_lines.h"
#include "core/image/sheet/sheet_cells.h"
#include "core/image/sheet/sheet_drawn_edge.h"
#include "core/image/sheet/sheet_on_table.h"
#include "core/image/sheet/sheet_step.h"
#include "core/image/sheet/straight_sheet_edges.h"
#include "core/image/sheet/straight_sided_sheet.h"

namespace batten {
namespace {

constexpr double kMostRoughness = 9.0;                   // [grey] between neighbours within a cell: carpet, wood, cloth
constexpr double kLeastSheet = 0.3, kMostSheet = 0.985;  // of the picture
constexpr double kMostBesideTable = 0.997;               // of it, where a corner of the table tells the sheet
constexpr double kLeastFreeSheet = 0.1, kLeastFreeEven = 0.05;  // of the picture; of its paper a drawing takes some
constexpr double kLeastSolid = 0.92;                            // of the convex hull: a torn edge is nearly convex
constexpr double kLeastAlongSide = 0.2;   // of a side of the picture that a patch beside the sheet takes
constexpr double kSheetContrast = 12.0;   // [grey] of the patch against the sheet beside it
constexpr double kMostKnown = 0.5;        // of a side of the picture
constexpr int kBesideEdgeCells = 61;      // 30 to either side
constexpr double kLineShare = 0.004;      // of the diagonal: half the width of lines that run off the sheet
constexpr double kSheetRimShare = 0.006;  // of the diagonal: the sheet's edge and its shadow
constexpr double kOutlineCells = 1.5;     // [cells] of the outline of the sheet: steps of its cells are none of it
// Of the hull's length: what its simplification to four corners may leave out, tried from the finest on.
constexpr double kFinestQuadrilateral = 0.005, kCoarsestQuadrilateral = 0.08, kQuadrilateralStep = 0.0025;
constexpr double kLeastQuadrilateral = 0.93;  // of the hull's area: else the sheet has other corners than these four

/// Cells joined as long as brightness and colour change slowly; rough ones stay alone. Labels from 0.
cv::Mat1i joinCells(const SheetCells& cells) {
  cv::Mat1i labels(cells.rows, cells.columns, -1);
  std::vector<cv::Point> open;
  int next = 0;
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) {
      if (labels(j, i) >= 0) continue;
      labels(j, i) = next;
      open.assign(1, {i, j});
      while (!open.empty()) {
        const cv::Point at = open.back();
        open.pop_back();
        if (cells.rough(at) > static_cast<float>(kMostRoughness)) continue;
        for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point to = at + step;
          if (to.x < 0 || to.y < 0 || to.x >= cells.columns || to.y >= cells.rows || labels(to) >= 0) continue;
          if (cells.rough(to) > static_cast<float>(kMostRoughness)) continue;
          if (!isOneSheet(cells.colour(at), cells.colour(to))) continue;
          labels(to) = next;
          open.push_back(to);
        }
      }
      ++next;
    }
  }
  return labels;
}

/// The sheet with all that it encloses: what cannot be reached from outside the picture.
cv::Mat1b filledSheet(const cv::Mat1b& sheet) {
  cv::Mat1b around;
  cv::copyMakeBorder(sheet, around, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::floodFill(around, {0, 0}, 128);
  return around(cv::Rect(1, 1, sheet.cols, sheet.rows)) != 128;
}

/// How a patch of cells lies against the border of the picture, and what it is like.
struct BorderPatch {
  int area = 0;
  std::array<int, 4> along{};  ///< Cells at the top, right, bottom and left side.
  int corners = 0;
};

bool isBeside(const BorderPatch& patch, const cv::Size& size) {
  if (patch.area < kLeastPatch * size.area() || patch.corners == 0) return false;
  const double across = std::max(patch.along[0], patch.along[2]) / static_cast<double>(size.width);
  const double down = std::max(patch.along[1], patch.along[3]) / static_cast<double>(size.height);
  return std::max(across, down) >= kLeastAlongSide;
}

/// A corner of the picture that a small patch fills: of the table, where the table shows elsewhere, too.
bool isInCorner(const BorderPatch& patch) {
  constexpr int kFewestAlong = 8;  // cells, of both sides that meet there
  const auto sides = std::ranges::count_if(patch.along, [](int along) { return along >= kFewestAlong; });
  return patch.corners > 0 && sides >= 2;
}

/// Cells beside the sheet: patches outside it that reach a corner of the picture and run along its border. The rest
/// outside it is ink that runs off the page, and stays.
cv::Mat1b besideTheSheet(const cv::Mat1b& sheet, const SheetCells& cells) {
  std::optional<ShadedPaper> shaded;  // asked for by few pictures
  cv::Mat1i labels;
  const cv::Mat1b outside = sheet == 0;
  const int count = cv::connectedComponents(outside, labels, 8, CV_32S);
  std::vector<BorderPatch> patches(count);
  const int right = sheet.cols - 1, bottom = sheet.rows - 1;
  for (int j = 0; j <= bottom; ++j) {
    for (int i = 0; i <= right; ++i) {
      BorderPatch& patch = patches[labels(j, i)];
      ++patch.area;
      patch.along[0] += j == 0;
      patch.along[1] += i == right;
      patch.along[2] += j == bottom;
      patch.along[3] += i == 0;
      patch.corners += (j == 0 || j == bottom) && (i == 0 || i == right);
    }
  }
  cv::Mat1b beside(sheet.size(), 0), inCorners(sheet.size(), 0);
  const cv::Scalar sheetMean = cv::mean(cells.colour, sheet);
  const double level = sheetMean[0];
  const double grain = std::max(kMostRoughness, kSameGrain * cv::mean(cells.rough, sheet)[0]);
  for (int k = 1; k < count; ++k) {
    const bool isLarge = isBeside(patches[k], sheet.size());
    if (!isLarge && !isInCorner(patches[k])) continue;
    const cv::Mat1b patch = labels == k;
    cv::Scalar mean, spread;
    cv::meanStdDev(cells.colour, mean, spread, patch);
    const double roughness = cv::mean(cells.rough, patch)[0];
    // Even paper that is brighter than what it encloses: that is a drawn solid, and no dark sheet on a table.
    const bool isPaper = mean[0] >= level + kSolidContrast && roughness <= grain;
    if (isPaper) continue;
    if (!shaded) shaded.emplace(sheet, cells);
    if (shaded->isOne(patch) || shaded->showsThrough(patch)) continue;
    const double apart =
        std::max({std::fabs(mean[0] - level), std::fabs(mean[1] - sheetMean[1]), std::fabs(mean[2] - sheetMean[2])});
    if (apart < kSheetContrast && roughness <= kMostRoughness) continue;
    if (isStepBetween(sheet, patch, cells)) (isLarge ? beside : inCorners).setTo(255, patch);
  }
  if (cv::countNonZero(beside) > 0) beside |= inCorners;
  return beside;
}

/// Share of what a mask holds at the border of the picture that another holds, too.
double shareAtBorder(const cv::Mat1b& mask, const cv::Mat1b& other) {
  const cv::Mat1b border = borderOf(mask.size());
  return cv::countNonZero(mask & other & border) / std::max(1.0, 1.0 * cv::countNonZero(mask & border));
}

/// Cells beyond straight edges of the sheet upon which nothing is drawn, unless they are its paper in shade.
void addBeyondEdges(cv::Mat1b& beside, const SheetCells& cells, const RunContext& context) {
  const cv::Mat rim = cv::getStructuringElement(cv::MORPH_RECT, {kSheetEdgeCells, kSheetEdgeCells});
  const cv::Mat besideEdge = cv::getStructuringElement(cv::MORPH_RECT, {kBesideEdgeCells, kBesideEdgeCells});
  const cv::Mat1b table = beside.clone();
  for (const cv::Mat1b& beyond : beyondSheetEdges(cells, context)) {
    // Where the table is known already the sheet ends at it.
    if (shareAtBorder(beyond, table) > kMostKnown) continue;
    cv::Mat1b withRim, around, clear;
    cv::dilate(beyond, withRim, rim);
    cv::dilate(beyond, around, besideEdge);
    cv::erode(beyond, clear, rim);
    // Shading changes the paper over the page: its look is compared beside the edge.
    if (ShadedPaper(around & (withRim == 0), cells).isOne(beyond)) continue;
    if (!ShadedPaper(withRim == 0, cells).isDrawnOn(clear)) beside.setTo(255, beyond);
  }
}

std::vector<Vec2> outlineOf(const cv::Mat1b& inside, double cellPx) {
  const std::vector<cv::Point> outline = largestOutline(inside);
  std::vector<Vec2> polygon;
  if (outline.empty()) return polygon;
  std::vector<cv::Point> rough;
  cv::approxPolyDP(outline, rough, kOutlineCells, true);
  for (const cv::Point& p : rough) polygon.emplace_back((p.x + 0.5) * cellPx, (p.y + 0.5) * cellPx);
  return polygon;
}

/// The four corners of the sheet's hull, from the top left clockwise; none if it is no quadrilateral.
std::vector<Vec2> cornersOf(const cv::Mat1b& sheet, double cellPx) {
  if (cv::countNonZero(sheet) < 4) return {};
  const std::vector<cv::Point> hull = hullOf(sheet);
  std::vector<cv::Point> four;
  const double length = cv::arcLength(hull, true);
  for (double share = kFinestQuadrilateral; share < kCoarsestQuadrilateral && four.size() != 4;
       share += kQuadrilateralStep)
    cv::approxPolyDP(hull, four, share * length, true);
  if (four.size() != 4 || cv::contourArea(four) < kLeastQuadrilateral * cv::contourArea(hull)) return {};
  const auto first = std::min_element(four.begin(), four.end(),
                                      [](const cv::Point& a, const cv::Point& b) { return a.x + a.y < b.x + b.y; });
  std::rotate(four.begin(), first, four.end());
  const cv::Point a = four[1] - four[0], b = four[3] - four[0];
  if (a.x * b.y - a.y * b.x < 0) std::reverse(four.begin() + 1, four.end());
  std::vector<Vec2> corners;
  corners.reserve(four.size());
  for (const cv::Point& p : four) corners.emplace_back((p.x + 0.5) * cellPx, (p.y + 0.5) * cellPx);
  return corners;
}

/// Beyond the picture the sheet goes on: only what lies beside it is cut.
cv::Mat1b sheetWithoutNecks(const cv::Mat1b& beside) {
  cv::Mat1b sheet = beside == 0;
  cv::morphologyEx(sheet, sheet, cv::MORPH_OPEN, discOf(sheet.size(), kNeckShare), {-1, -1}, 1, cv::BORDER_REPLICATE);
  return sheet;
}

/// Broader than a line that runs along the border of the picture.
bool isBroad(const cv::Mat1b& table) {
  constexpr int kBroadCells = 5;
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {kBroadCells, kBroadCells});
  cv::Mat1b within;
  cv::erode(table, within, square, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return cv::countNonZero(within) > 0;
}

struct BesideSheet {
  std::optional<cv::Mat1b> cells;  ///< Absent: nothing is beside a sheet, or it is doubtful that there is one.
  bool isDoubtful = false;         ///< Something lies beside, and what it leaves is no sheet.
  double mostSheet = kMostSheet;   ///< Of the picture, that a sheet may fill.
};

/// All cells beside a sheet. `even`: its even area, filled.
BesideSheet cellsBeside(const cv::Mat1b& even, const SheetCells& cells, const RunContext& context) {
  const cv::Mat1b table = besideTheSheet(even, cells);
  cv::Mat1b beside = table.clone();
  addBeyondEdges(beside, cells, context);
  if (cv::countNonZero(beside) == 0) return {};
  const cv::Mat1b sheet = sheetWithoutNecks(beside);
  const double share = cv::countNonZero(sheet) / static_cast<double>(sheet.total());
  const double most = isBroad(table) ? kMostBesideTable : kMostSheet;
  if (share < kLeastSheet || share > most) return {std::nullopt, true};
  if (cv::countNonZero(sheet) < kLeastSolid * cv::contourArea(hullOf(sheet))) return {std::nullopt, true};
  return {cv::Mat1b(withoutTonesAtEdge(table, even, cells) | (beside & (table == 0))), false, most};
}

/// A sheet with the lines that run off it, and what is drawn on them: what lies beside it was reached through them.
/// Nothing beyond its hull is added.
cv::Mat1b withLinesToEdge(const cv::Mat1b& sheet) {
  const cv::Mat disc = discOf(sheet.size(), kLineShare);
  const int rim = disc.rows;
  cv::Mat1b around;
  cv::copyMakeBorder(sheet, around, rim, rim, rim, rim, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(around, around, cv::MORPH_CLOSE, disc);
  return filledSheet(around(cv::Rect(cv::Point(rim, rim), sheet.size())));
}

/// An even area with what it becomes slowly, but for narrow parts: the blur along its edge.
cv::Mat1b withSlowChanges(const cv::Mat1b& even, const SheetCells& cells) {
  cv::Mat1b added = slowlyContinued(even, cells) & (even == 0);
  cv::morphologyEx(added, added, cv::MORPH_OPEN, discOf(added.size(), kNeckShare), {-1, -1}, 1, cv::BORDER_REPLICATE);
  return filledSheet(even | added);
}

/// The sheet that a straight-sided even area is, without what reaches in from outside: things that lie half on it.
cv::Mat1b straightSided(const cv::Mat1b& sides, const cv::Mat1b& even, const SheetCells& cells) {
  const cv::Mat1b paper = filledSheet(even & sides), outside = sides == 0;
  // Lines that run off the sheet are narrow, tones do not go on beside it.
  cv::Mat1b things = withoutTonesAtEdge(paper == 0, paper, cells);
  cv::morphologyEx(things, things, cv::MORPH_OPEN, discOf(things.size(), kNeckShare), {-1, -1}, 1,
                   cv::BORDER_REPLICATE);
  return sheetWithoutNecks(withoutPockets(outside | things));
}

/// A sheet that lies free: one of the largest even areas, with straight sides.
std::optional<cv::Mat1b> freeSheet(const cv::Mat1i& labels, const std::vector<int>& areas, const SheetCells& cells) {
  std::vector<int> large;
  for (int label = 0; label < std::ssize(areas); ++label)
    if (areas[label] >= kLeastFreeEven * static_cast<double>(labels.total())) large.push_back(label);
  std::ranges::stable_sort(large, [&](int a, int b) { return areas[a] > areas[b]; });
  constexpr std::size_t kMostAsked = 3;
  if (large.size() > kMostAsked) large.resize(kMostAsked);
  for (const int label : large) {
    const cv::Mat1b even = filledSheet(labels == label);
    const double share = cv::countNonZero(even) / static_cast<double>(even.total());
    if (share < kLeastFreeSheet || share > kMostSheet) continue;
    if (const auto sides = straightSidedSheet(even, cells)) return straightSided(*sides, even, cells);
  }
  return std::nullopt;
}

/// The sheet is the largest even area of the picture, with the facing page where it is a page of an open book, or lies
/// upon it, where that is a table.
std::optional<cv::Mat1b> sheetOf(const SheetCells& cells, const RunContext& context) {
  const cv::Mat1i labels = joinCells(cells);
  std::vector<int> areas;
  for (const int label : labels) {
    if (label >= std::ssize(areas)) areas.resize(label + 1, 0);
    ++areas[label];
  }
  const int largest = static_cast<int>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  if (auto onTable = sheetOnTable(labels, areas, largest, cells)) return onTable;
  cv::Mat1b even = filledSheet(labels == largest);
  const int area = cv::countNonZero(even);
  if (area < kLeastSheet * static_cast<double>(even.total())) return freeSheet(labels, areas, cells);
  if (area < kMostSheet * static_cast<double>(even.total())) even = withSlowChanges(even, cells);
  BesideSheet found = cellsBeside(even, cells, context);
  if (found.isDoubtful) {
    // Lines that run off the sheet part it: what lies between them and the table is no part of the table.
    even = filledSheet(sheetBehindLines(even, labels, areas, cells));
    found = cellsBeside(even, cells, context);
  }
  if (!found.cells) return freeSheet(labels, areas, cells);
  bool isBook = false;  // its gutter is as narrow as a line
  for (int label = 0; label < std::ssize(areas); ++label) {
    if (label == largest || areas[label] < kLeastFacingPage * areas[largest]) continue;
    const cv::Mat1b page = filledSheet(labels == label);
    // Within the sheet it is a shape that was drawn.
    if (cv::countNonZero(page & even) > 0 || !isFacingPage(page, even, cells, ShadedPaper(even, cells))) continue;
    BesideSheet both = cellsBeside(even | page, cells, context);
    isBook = both.cells.has_value();
    if (isBook) found = std::move(both);
    break;
  }
  cv::Mat1b sheet = sheetWithoutNecks(withoutPockets(*found.cells));
  if (!isBook) sheet = withLinesToEdge(withTonesThatBulge(sheet));
  if (cv::countNonZero(sheet) > found.mostSheet * static_cast<double>(sheet.total())) return std::nullopt;
  return sheet;
}

}  // namespace

std::optional<PaperSheet> findPaperSheet(const SheetCells& cells, const RunContext& context) {
  if (context.isCancelled() || std::min(cells.columns, cells.rows) < kFewestSheetCells) return std::nullopt;
  const std::optional<cv::Mat1b> sheet = sheetOf(cells, context);
  if (context.isCancelled() || !sheet || isDrawnFrame(*sheet, cells)) return std::nullopt;
  PaperSheet found;
  found.cellPx = cells.sizePx;
  found.cornersPx = cornersOf(*sheet, cells.sizePx);
  cv::Mat1b inside;
  cv::erode(*sheet, inside, discOf(sheet->size(), kSheetRimShare), {-1, -1}, 1, cv::BORDER_REPLICATE);
  found.outlinePx = outlineOf(inside, cells.sizePx);
  found.inside = BitImage(cells.columns, cells.rows);
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) {
      if (inside(j, i) != 0) found.inside.set(i, j, true);
    }
  }
  found.outsideShare = 1.0 - static_cast<double>(found.inside.count()) / static_cast<double>(sheet->total());
  return found;
}

std::optional<PaperSheet> findPaperSheet(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  return findPaperSheet(sheetCellsOf(grey, colour, context), context);
}

PaperSheet sheetWithinRim(int widthPx, int heightPx, const PictureBox& part) {
  PaperSheet sheet;
  sheet.cellPx = std::max(2, (std::max(widthPx, heightPx) + kSheetCells - 1) / kSheetCells);
  sheet.inside = BitImage(std::max(1, widthPx / sheet.cellPx), std::max(1, heightPx / sheet.cellPx));
  const auto upwards = [&](int px) { return (px + sheet.cellPx - 1) / sheet.cellPx; };
  const int left = std::min(upwards(part.left), sheet.inside.width - 1);
  const int top = std::min(upwards(part.top), sheet.inside.height - 1);
  const int right = std::max(left + 1, std::min((part.left + part.width) / sheet.cellPx, sheet.inside.width));
  const int bottom = std::max(top + 1, std::min((part.top + part.height) / sheet.cellPx, sheet.inside.height));
  const double rimPx = kSheetRimShare * std::hypot(part.width, part.height);
  const int widest = (std::min(right - left, bottom - top) - 1) / 2;  // 0: too narrow a strip to have a rim
  const int rim = std::min(std::max(1, static_cast<int>(std::ceil(rimPx / sheet.cellPx))), widest);
  for (int j = top + rim; j < bottom - rim; ++j) {
    for (int i = left + rim; i < right - rim; ++i) sheet.inside.set(i, j, true);
  }
  const double x0 = (left + rim) * sheet.cellPx, y0 = (top + rim) * sheet.cellPx;
  const double x1 = (right - rim) * sheet.cellPx, y1 = (bottom - rim) * sheet.cellPx;
  sheet.outlinePx = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return sheet;
}

PaperSheet sheetWithinRim(int widthPx, int heightPx) {
  return sheetWithinRim(widthPx, heightPx, {0, 0, widthPx, heightPx});
}

}  // namespace batten
