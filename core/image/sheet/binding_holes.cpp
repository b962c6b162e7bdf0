// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/binding_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/sheet/sheet_cells.h"

namespace batten {
namespace {

constexpr double kDeepest = 0.1;                     // of the page: holes lie no farther from its side
constexpr double kLongestHole = 0.05;                // of the side
constexpr float kDarkestPaper = 0.75f;               // of the paper of the page: what is darker is a hole, or ink
constexpr int kFewestHoles = 8;                      // of a binding, along one side
constexpr double kLeastSpacing = 6.0;                // [cells] marks that are closer have no spacing that could be told
constexpr double kLeastFilled = 0.6;                 // of its box: letters and outlines are not
constexpr double kLeastRowShare = 0.5;               // of the side, from the first hole to the last
constexpr double kLeastSize = 0.6, kMostSize = 1.6;  // of the median hole, along the side
constexpr double kLeastOfSpacing = 0.15, kMostOfSpacing = 0.8;  // a hole takes of the distance from one to the next
constexpr double kSpacingError = 0.15;                          // of the spacing
constexpr double kCellError = 1.0;                              // [cells]
constexpr double kLeastEven = 0.8;                              // of the distances are one spacing, or two or three
constexpr int kMostMissingHoles = 2;                            // holes between two that were found
constexpr double kMarginDepths = 2.0;                           // of a hole: the margin is no narrower
constexpr double kMostBeside = 0.5;                             // of the dark of the holes: what a drawing leaves there
constexpr int kRimCells = 1;                                    // of a hole: its blurred edge

struct Hole {
  double along = 0.0, deep = 0.0;  ///< [cells] Its middle.
  double length = 0.0, depth = 0.0;
  cv::Rect box;
  cv::Rect withRim() const {
    return {box.tl() - cv::Point(kRimCells, kRimCells), box.size() + cv::Size(2 * kRimCells, 2 * kRimCells)};
  }
};

/// Dark pieces along one side of the page. `acrossPage`: the side runs across it.
std::vector<Hole> darkPieces(const cv::Mat1b& dark, bool acrossPage, bool isFar) {
  const int side = acrossPage ? dark.cols : dark.rows, across = acrossPage ? dark.rows : dark.cols;
  const int depth = static_cast<int>(kDeepest * across), from = isFar ? across - depth : 0;
  const cv::Rect strip = acrossPage ? cv::Rect(0, from, side, depth) : cv::Rect(from, 0, depth, side);
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(dark(strip), labels, stats, centres, 8, CV_32S);
  std::vector<Hole> holes;
  for (int k = 1; k < count; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT) + strip.x, stats.at<int>(k, cv::CC_STAT_TOP) + strip.y,
                       stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const int innermost = acrossPage ? (isFar ? box.y - strip.y : strip.br().y - box.br().y)
                                     : (isFar ? box.x - strip.x : strip.br().x - box.br().x);
    const int length = acrossPage ? box.width : box.height;
    if (stats.at<int>(k, cv::CC_STAT_AREA) < kLeastFilled * box.area()) continue;
    if (innermost == 0 || length > kLongestHole * side) continue;  // goes on into the page, or along the side
    const double x = box.x + 0.5 * box.width, y = box.y + 0.5 * box.height;
    holes.push_back(
        {acrossPage ? x : y, acrossPage ? y : x, 1.0 * length, 1.0 * (acrossPage ? box.height : box.width), box});
  }
  return holes;
}

/// Those that are about as long as most. How much of them lies on the page varies.
void keepEqual(std::vector<Hole>& holes) {
  std::vector<double> lengths;
  lengths.reserve(holes.size());
  for (const Hole& hole : holes) lengths.push_back(hole.length);
  const double length = upperMedian(lengths);
  std::erase_if(holes, [&](const Hole& h) {
    return h.length < std::min(kLeastSize * length, length - kCellError) ||
           h.length > std::max(kMostSize * length, length + kCellError);
  });
}

/// Those that meet the straight line of most: the median slope of pairs far apart, and the median place.
void keepStraight(std::vector<Hole>& holes) {
  std::vector<double> slopes, places, depths;
  const std::ptrdiff_t half = std::ssize(holes) / 2;
  for (std::ptrdiff_t i = 0; i + half < std::ssize(holes); ++i) {
    const Hole &a = holes[i], &b = holes[i + half];
    if (b.along > a.along) slopes.push_back((b.deep - a.deep) / (b.along - a.along));
  }
  if (slopes.empty()) return;
  const double slope = upperMedian(slopes);
  for (const Hole& h : holes) {
    places.push_back(h.deep - slope * h.along);
    depths.push_back(h.depth);
  }
  const double place = upperMedian(std::vector<double>(places)), depth = upperMedian(depths);
  std::erase_if(holes, [&](const Hole& h) {
    return std::fabs(h.deep - slope * h.along - place) > std::max(kCellError, 0.5 * (depth + h.depth));
  });
}

bool isEvenRow(const std::vector<Hole>& holes, int side) {
  if (std::ssize(holes) < kFewestHoles || holes.back().along - holes.front().along < kLeastRowShare * side)
    return false;
  std::vector<double> distances, lengths;
  for (std::size_t i = 0; i + 1 < holes.size(); ++i) distances.push_back(holes[i + 1].along - holes[i].along);
  for (const Hole& h : holes) lengths.push_back(h.length);
  const double spacing = upperMedian(std::vector<double>(distances)), length = upperMedian(lengths);
  if (spacing < kLeastSpacing || length < kLeastOfSpacing * spacing || length > kMostOfSpacing * spacing) return false;
  const double error = std::max(kCellError, kSpacingError * spacing);
  const auto even = std::ranges::count_if(distances, [&](double d) {
    const double times = std::clamp(std::round(d / spacing), 1.0, 1.0 + kMostMissingHoles);
    return std::fabs(d - times * spacing) <= error;
  });
  return static_cast<double>(even) >= kLeastEven * static_cast<double>(distances.size());
}

/// Whether hardly anything but the holes is dark between them and in the margin behind, which is as wide as from one to
/// the next. A row or column of letters or words has others there.
bool isMarginEmpty(const cv::Mat1b& dark, const std::vector<Hole>& holes, bool acrossPage, bool isFar) {
  cv::Mat1b others = dark.clone();
  for (const Hole& hole : holes) others(hole.withRim() & cv::Rect({}, dark.size())).setTo(0);
  int own = 0, beside = 0;
  for (std::size_t i = 0; i + 1 < holes.size(); ++i) {
    const Hole &a = holes[i], &b = holes[i + 1];
    const double into = std::max(b.along - a.along, kMarginDepths * std::max(a.depth, b.depth));
    const double outer = std::min(a.deep - 0.5 * a.depth, b.deep - 0.5 * b.depth) - (isFar ? into : 0.0);
    const double inner = std::max(a.deep + 0.5 * a.depth, b.deep + 0.5 * b.depth) + (isFar ? 0.0 : into);
    const cv::Point2d from = acrossPage ? cv::Point2d(a.along, outer) : cv::Point2d(outer, a.along);
    const cv::Point2d to = acrossPage ? cv::Point2d(b.along, inner) : cv::Point2d(inner, b.along);
    beside += cv::countNonZero(others(cv::Rect(cv::Point(from), cv::Point(to)) & cv::Rect({}, dark.size())));
    own += cv::countNonZero(dark(a.box));
  }
  return beside <= kMostBeside * own;
}

struct HoleRow {
  std::vector<Hole> holes;
  cv::Rect edge;  ///< [cells] What lies along the side of the page beside the holes: the edge of the sheet.
};

std::vector<Hole> evenRow(const cv::Mat1b& dark, int side) {
  const bool acrossPage = side % 2 == 0;
  std::vector<Hole> holes = darkPieces(dark, acrossPage, side >= 2);
  if (std::ssize(holes) < kFewestHoles) return {};
  std::ranges::stable_sort(holes, {}, &Hole::along);
  keepEqual(holes);
  keepStraight(holes);
  if (!isEvenRow(holes, acrossPage ? dark.cols : dark.rows)) return {};
  return isMarginEmpty(dark, holes, acrossPage, side >= 2) ? holes : std::vector<Hole>();
}

int darkRuns(const cv::Mat1b& line) {
  int runs = 0;
  bool wasDark = false;
  for (const std::uint8_t cell : line) {
    runs += cell != 0 && !wasDark ? 1 : 0;
    wasDark = cell != 0;
  }
  return runs;
}

/// The row along one side of the page: 0 above, 1 on the left, 2 below, 3 on the right. Where the sheet ends in the
/// picture, its edge or the shadow along it joins the wires of the binding: as much along the side is left out as shows
/// the most of them.
HoleRow rowAlong(const cv::Mat1b& dark, int side) {
  const bool acrossPage = side % 2 == 0;
  const int across = acrossPage ? dark.rows : dark.cols, along = acrossPage ? dark.cols : dark.rows;
  cv::Mat1b inside = dark.clone();
  HoleRow most;
  int left = 0;
  for (int outer = 0; outer < static_cast<int>(kDeepest * across); ++outer) {
    const int at = side < 2 ? outer : across - 1 - outer;
    cv::Mat1b line = acrossPage ? inside.row(at) : inside.col(at);
    if (outer == 0 || darkRuns(line) >= kFewestHoles) {
      std::vector<Hole> holes = evenRow(inside, side);
      if (holes.size() > most.holes.size()) most.holes = std::move(holes), left = outer;
    }
    line.setTo(0);
  }
  if (most.holes.empty()) return most;
  const int from = static_cast<int>(most.holes.front().along), to = static_cast<int>(most.holes.back().along);
  const int spacing = (to - from) / static_cast<int>(std::ssize(most.holes) - 1);
  const int begin = std::max(0, from - spacing), length = std::min(along, to + spacing) - begin;
  const int at = side < 2 ? 0 : across - left;
  most.edge = acrossPage ? cv::Rect(begin, at, length, left) : cv::Rect(at, begin, left, length);
  return most;
}

void mark(const cv::Rect& box, BitImage& cells) {
  for (int j = std::max(0, box.y); j < std::min(cells.height, box.br().y); ++j) {
    for (int i = std::max(0, box.x); i < std::min(cells.width, box.br().x); ++i) cells.set(i, j, true);
  }
}

}  // namespace

std::optional<BindingHoles> findBindingHoles(const SheetCells& cells) {
  if (std::min(cells.columns, cells.rows) < kFewestSheetCells) return std::nullopt;
  std::vector<float> levels;
  for (const cv::Vec3f& cell : cells.colour) levels.push_back(cell[0]);
  const float limit = kDarkestPaper * upperMedian(levels);
  cv::Mat1b dark(cells.rows, cells.columns);
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) dark(j, i) = cells.dark(j, i) < limit ? 255 : 0;
  }
  HoleRow found;
  for (int side = 0; side < 4; ++side) {
    HoleRow row = rowAlong(dark, side);
    if (row.holes.empty()) continue;
    if (!found.holes.empty()) return std::nullopt;
    found = std::move(row);
  }
  if (found.holes.empty()) return std::nullopt;
  BindingHoles binding{.cellPx = cells.sizePx,
                       .cells = BitImage(cells.columns, cells.rows),
                       .count = static_cast<int>(found.holes.size())};
  mark(found.edge, binding.cells);
  for (const Hole& hole : found.holes) mark(hole.withRim(), binding.cells);
  return binding;
}

}  // namespace batten
