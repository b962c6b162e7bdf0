// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/binding_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/sheet/sheet_cells.h"
#include "core/image/sheet/straight_sides.h"

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
constexpr int kPaperAcross = 15;                                // paper shows within them, whatever is drawn
// Of the places between holes along the edge of a sheet, and along a side of the picture, which may be anything:
// drawings reach them here and there. Letters have others beside them all along.
constexpr double kLeastEmpty = 0.5, kLeastEmptyAlongPicture = 0.85;
constexpr int kRimCells = 1;  // of a hole: its blurred edge

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
/// @param leastEmpty the share of the places between two holes where that is asked.
bool isMarginEmpty(const cv::Mat1b& dark, const std::vector<Hole>& holes, bool acrossPage, bool isFar,
                   double leastEmpty) {
  cv::Mat1b others = dark.clone();
  for (const Hole& hole : holes) others(hole.withRim() & cv::Rect({}, dark.size())).setTo(0);
  struct Place {
    int own = 0, beside = 0;
    bool isLess(const Place& other) const {
      return std::int64_t{beside} * other.own < std::int64_t{other.beside} * own;
    }
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i + 1 < holes.size(); ++i) {
    const Hole &a = holes[i], &b = holes[i + 1];
    const double into = std::max(b.along - a.along, kMarginDepths * std::max(a.depth, b.depth));
    const double outer = std::min(a.deep - 0.5 * a.depth, b.deep - 0.5 * b.depth) - (isFar ? into : 0.0);
    const double inner = std::max(a.deep + 0.5 * a.depth, b.deep + 0.5 * b.depth) + (isFar ? 0.0 : into);
    const cv::Point2d from = acrossPage ? cv::Point2d(a.along, outer) : cv::Point2d(outer, a.along);
    const cv::Point2d to = acrossPage ? cv::Point2d(b.along, inner) : cv::Point2d(inner, b.along);
    places.push_back({cv::countNonZero(dark(a.box)),
                      cv::countNonZero(others(cv::Rect(cv::Point(from), cv::Point(to)) & cv::Rect({}, dark.size())))});
  }
  std::ranges::stable_sort(places, [](const Place& a, const Place& b) { return a.isLess(b); });
  places.resize(static_cast<std::size_t>(std::ceil(leastEmpty * static_cast<double>(places.size()))));
  Place sum;
  for (const Place& place : places) sum.own += place.own, sum.beside += place.beside;
  return sum.beside <= kMostBeside * sum.own;
}

struct HoleRow {
  std::vector<Hole> holes;
  cv::Rect edge;  ///< [cells] What lies along the side of the page beside the holes: the edge of the sheet.
};

std::vector<Hole> evenRow(const cv::Mat1b& dark, int side, double leastEmpty) {
  const bool acrossPage = side % 2 == 0;
  std::vector<Hole> holes = darkPieces(dark, acrossPage, side >= 2);
  if (std::ssize(holes) < kFewestHoles) return {};
  std::ranges::stable_sort(holes, {}, &Hole::along);
  keepEqual(holes);
  keepStraight(holes);
  if (!isEvenRow(holes, acrossPage ? dark.cols : dark.rows)) return {};
  return isMarginEmpty(dark, holes, acrossPage, side >= 2, leastEmpty) ? holes : std::vector<Hole>();
}

/// The row with the holes that something is joined to, as a drawn line or the edge of the sheet: at the same distances
/// between the others and beyond the ends.
std::vector<Hole> withJoinedHoles(const std::vector<Hole>& holes, const cv::Mat1b& dark, bool acrossPage) {
  std::vector<double> distances, lengths, depths;
  for (std::size_t i = 0; i + 1 < holes.size(); ++i) distances.push_back(holes[i + 1].along - holes[i].along);
  for (const Hole& h : holes) lengths.push_back(h.length), depths.push_back(h.depth);
  const double spacing = upperMedian(distances), length = upperMedian(lengths), depth = upperMedian(depths);
  std::vector<Hole> all;
  const auto addIfDark = [&](double along, double deep) {
    const double left = along - 0.5 * length, top = deep - 0.5 * depth;
    const cv::Rect box(acrossPage ? cv::Rect2d(left, top, length, depth) : cv::Rect2d(top, left, depth, length));
    const cv::Rect seen = box & cv::Rect({}, dark.size());
    if (!seen.empty() && cv::countNonZero(dark(seen)) >= kLeastFilled * seen.area())
      all.push_back({along, deep, length, depth, seen});
  };
  const double slope = (holes.back().deep - holes.front().deep) / (holes.back().along - holes.front().along);
  for (int k = kMostMissingHoles; k > 0; --k)
    addIfDark(holes.front().along - k * spacing, holes.front().deep - k * spacing * slope);
  for (std::size_t i = 0; i < holes.size(); ++i) {
    all.push_back(holes[i]);
    if (i + 1 == holes.size()) break;
    const Hole &a = holes[i], &b = holes[i + 1];
    const int times = std::min(static_cast<int>(std::lround((b.along - a.along) / spacing)), 1 + kMostMissingHoles);
    for (int k = 1; k < times; ++k) {
      const double t = static_cast<double>(k) / times;
      addIfDark(std::lerp(a.along, b.along, t), std::lerp(a.deep, b.deep, t));
    }
  }
  for (int k = 1; k <= kMostMissingHoles; ++k)
    addIfDark(holes.back().along + k * spacing, holes.back().deep + k * spacing * slope);
  return all;
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
HoleRow rowAlong(const cv::Mat1b& dark, int side, double leastEmpty) {
  const bool acrossPage = side % 2 == 0;
  const int across = acrossPage ? dark.rows : dark.cols, along = acrossPage ? dark.cols : dark.rows;
  cv::Mat1b inside = dark.clone();
  HoleRow most;
  int left = 0;
  for (int outer = 0; outer < static_cast<int>(kDeepest * across); ++outer) {
    const int at = side < 2 ? outer : across - 1 - outer;
    cv::Mat1b line = acrossPage ? inside.row(at) : inside.col(at);
    if (outer == 0 || darkRuns(line) >= kFewestHoles) {
      std::vector<Hole> holes = evenRow(inside, side, leastEmpty);
      if (holes.size() > most.holes.size()) most.holes = std::move(holes), left = outer;
    }
    line.setTo(0);
  }
  if (most.holes.empty()) return most;
  most.holes = withJoinedHoles(most.holes, dark, acrossPage);
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

/// What is darker than the paper around it on a sheet. What lies beside the sheet does not count.
cv::Mat1b darkOnSheet(const SheetCells& cells, const cv::Mat1b& sheet) {
  cv::Mat1f grey, paper;
  cv::extractChannel(cells.colour, grey, 0);
  cv::morphologyEx(grey, paper, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {kPaperAcross, kPaperAcross}));
  cv::Mat1b dark(cells.rows, cells.columns, static_cast<std::uint8_t>(0));
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i)
      dark(j, i) = sheet(j, i) != 0 && cells.dark(j, i) < kDarkestPaper * paper(j, i) ? 255 : 0;
  }
  return dark;
}

/// A sheet as seen with one of its sides above, level.
struct SideFrame {
  Vec2 corner, along, inward;
  cv::Size size{0, 0};

  SideFrame(const StraightSide& side, const cv::Mat1b& sheet) : inward(side.inward) {
    along = {inward.y(), -inward.x()};
    double first = 0.0, last = 0.0, deepest = 0.0;
    bool isAny = false;
    for (int j = 0; j < sheet.rows; ++j) {
      for (int i = 0; i < sheet.cols; ++i) {
        if (sheet(j, i) == 0) continue;
        const double a = along.dot(Vec2(i, j));
        first = isAny ? std::min(first, a) : a;
        last = isAny ? std::max(last, a) : a;
        deepest = std::max(deepest, side.depth(Vec2(i, j)));
        isAny = true;
      }
    }
    corner = first * along + side.offset * inward;
    size = {static_cast<int>(last - first) + 1, static_cast<int>(deepest) + 1};
  }
  cv::Point toPicture(int i, int j) const {
    const Vec2 p = corner + i * along + j * inward;
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  }
  cv::Mat1b of(const cv::Mat1b& mask) const {
    cv::Mat1b out(size, static_cast<std::uint8_t>(0));
    const cv::Rect whole({}, mask.size());
    for (int j = 0; j < size.height; ++j) {
      for (int i = 0; i < size.width; ++i) {
        const cv::Point at = toPicture(i, j);
        if (whole.contains(at)) out(j, i) = mask(at);
      }
    }
    return out;
  }
  /// Neighbours of a cell in this frame may lie two cells apart in the picture.
  void markIn(const cv::Rect& box, BitImage& cells) const {
    for (int j = box.y; j < box.br().y; ++j) {
      for (int i = box.x; i < box.br().x; ++i) mark({toPicture(i, j), cv::Size(2, 2)}, cells);
    }
  }
};

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
    HoleRow row = rowAlong(dark, side, kLeastEmptyAlongPicture);
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

std::optional<BindingHoles> findBindingHoles(const SheetCells& cells, const BitImage& sheet) {
  cv::Mat1b inside(cells.rows, cells.columns, static_cast<std::uint8_t>(0));
  for (int j = 0; j < std::min(inside.rows, sheet.height); ++j) {
    for (int i = 0; i < std::min(inside.cols, sheet.width); ++i) inside(j, i) = sheet.at(i, j) ? 255 : 0;
  }
  const cv::Mat1b dark = darkOnSheet(cells, inside);
  std::optional<BindingHoles> binding;
  for (const StraightSide& side : straightSides(inside)) {
    const SideFrame frame(side, inside);
    if (std::min(frame.size.width, frame.size.height) < kFewestSheetCells) continue;
    const HoleRow row = rowAlong(frame.of(dark), 0, kLeastEmpty);
    if (row.holes.empty()) continue;
    if (binding) return std::nullopt;
    binding = BindingHoles{.cellPx = cells.sizePx,
                           .cells = BitImage(cells.columns, cells.rows),
                           .count = static_cast<int>(row.holes.size())};
    frame.markIn(row.edge, binding->cells);
    for (const Hole& hole : row.holes) frame.markIn(hole.withRim(), binding->cells);
  }
  return binding;
}

}  // namespace batten
