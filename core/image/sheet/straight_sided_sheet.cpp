// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/straight_sided_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/angle.h"
#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/image/grown_mask.h"
#include "core/image/sheet/shaded_paper.h"
#include "core/image/sheet/sheet_drawn_edge.h"

namespace batten {
namespace {

constexpr int kSides = 4;
constexpr double kOnSideCells = 1.5;      // of a side: its course in cells
constexpr double kLeastOfOutline = 0.06;  // of the outline of an even area: fewer of its cells make no side
constexpr double kMostBeyond = 0.06;   // of an even area may lie beyond one side: it goes on into something as bright
constexpr double kLeastFilled = 0.75;  // of the quadrilateral: things lie on the sheet, too
constexpr double kLeastSeenOfSide = 0.3;                    // of a side's length; things hide the rest
constexpr double kLeastSeen = 0.6;                          // of all sides
constexpr double kLeastDarkerBeside = 0.8;                  // of the places that are seen
constexpr int kNearSideCells = 3, kBesideSideCells = 9;     // from a side: what is looked at on both
constexpr double kLeastCorner = 50.0, kMostCorner = 130.0;  // [degrees] a rectangle seen at an angle
constexpr double kLeastLean = 1.5;                          // [degrees] of a side against the picture's
constexpr float kAsBright = 0.85f;                          // of the sheet's brightness
constexpr double kMostAsBright = 0.1;                       // of the sheet: so much beside it is no glint
constexpr auto kGrain = static_cast<float>(kSameGrain);

/// A line of cells; `inward` is a unit vector, inward.dot(p) >= offset on the side of the sheet.
struct Side {
  Vec2 inward{0.0, 0.0};
  double offset = 0.0;
  int count = 0;  ///< Cells of the outline on it.
  double depth(const Vec2& p) const { return inward.dot(p) - offset; }
};

std::vector<Vec2> outlineCells(const cv::Mat1b& even) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(even.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Vec2> places;
  const auto largest = std::max_element(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  if (largest == outlines.end()) return places;
  for (const cv::Point& p : *largest) {
    if (p.x > 1 && p.y > 1 && p.x < even.cols - 2 && p.y < even.rows - 2) places.emplace_back(p.x, p.y);
  }
  return places;
}

/// Every few cells of a mask.
std::vector<Vec2> sampledCells(const cv::Mat1b& even) {
  constexpr int kStep = 4;
  std::vector<Vec2> places;
  for (int j = 0; j < even.rows; j += kStep) {
    for (int i = 0; i < even.cols; i += kStep)
      if (even(j, i) != 0) places.emplace_back(i, j);
  }
  return places;
}

Side through(const Vec2& a, const Vec2& b) {
  const Vec2 along = (b - a).normalized();
  const Vec2 inward(-along.y(), along.x());
  return {inward, inward.dot(a), 0};
}

int countOn(const Side& side, const std::vector<Vec2>& places) {
  return static_cast<int>(
      std::ranges::count_if(places, [&](const Vec2& p) { return std::fabs(side.depth(p)) <= kOnSideCells; }));
}

/// The line through most places of the outline, with hardly any of the area beyond it.
std::optional<Side> bestSide(const std::vector<Vec2>& outline, const std::vector<Vec2>& area, int fewest) {
  constexpr int kTried = 240;
  const int n = static_cast<int>(outline.size()), step = std::max(1, n / kTried);
  std::vector<Side> sides;
  for (const int span : {n / 24, n / 10}) {
    for (int i = 0; span > 0 && i < n; i += step) {
      const Vec2 &a = outline[i], &b = outline[(i + span) % n];
      if ((b - a).norm() < 0.8 * span) continue;  // the outline bends between them
      Side side = through(a, b);
      side.count = countOn(side, outline);
      if (side.count >= fewest) sides.push_back(side);
    }
  }
  std::ranges::stable_sort(sides, [](const Side& a, const Side& b) { return a.count > b.count; });
  for (Side side : sides) {
    const auto beyond = std::ranges::count_if(area, [&](const Vec2& p) { return side.depth(p) < -kOnSideCells; });
    const auto within = std::ranges::count_if(area, [&](const Vec2& p) { return side.depth(p) > kOnSideCells; });
    if (static_cast<double>(std::min(beyond, within)) > kMostBeyond * static_cast<double>(area.size())) continue;
    if (beyond > within) side = {-side.inward, -side.offset, side.count};
    return side;
  }
  return std::nullopt;
}

/// Four sides of an even area; fewer if there are not so many.
std::vector<Side> sidesOf(const cv::Mat1b& even) {
  std::vector<Vec2> outline = outlineCells(even);
  const std::vector<Vec2> area = sampledCells(even);
  const int fewest = std::max(8, static_cast<int>(kLeastOfOutline * static_cast<double>(outline.size())));
  std::vector<Side> sides;
  while (std::ssize(sides) < kSides) {
    const std::optional<Side> side = bestSide(outline, area, fewest);
    if (!side) break;
    sides.push_back(*side);
    std::erase_if(outline, [&](const Vec2& p) { return std::fabs(side->depth(p)) <= 2.0 * kOnSideCells; });
  }
  return sides;
}

std::optional<Vec2> crossing(const Side& a, const Side& b) {
  const double det = a.inward.x() * b.inward.y() - a.inward.y() * b.inward.x();
  if (std::fabs(det) < 1e-3) return std::nullopt;
  return Vec2((a.offset * b.inward.y() - b.offset * a.inward.y()) / det,
              (b.offset * a.inward.x() - a.offset * b.inward.x()) / det);
}

/// The corners where each side meets the next, the sides in order round the sheet. Empty: they are no quadrilateral
/// that a rectangle could look like, or it does not lie in the picture.
std::vector<Vec2> cornersBetween(std::vector<Side>& sides, const cv::Size& size) {
  if (std::ssize(sides) != kSides) return {};
  std::ranges::sort(sides, {}, [](const Side& s) { return std::atan2(s.inward.y(), s.inward.x()); });
  std::vector<Vec2> corners;
  for (int k = 0; k < kSides; ++k) {
    const Side &a = sides[k], &b = sides[(k + 1) % kSides];
    const std::optional<Vec2> corner = crossing(a, b);
    const double turn = std::atan2(a.inward.x() * b.inward.y() - a.inward.y() * b.inward.x(), a.inward.dot(b.inward));
    const double angle = 180.0 - turn / kRadPerDeg;
    if (!corner || angle < kLeastCorner || angle > kMostCorner) return {};
    if (corner->x() < -1.0 || corner->y() < -1.0 || corner->x() > size.width || corner->y() > size.height) return {};
    corners.push_back(*corner);
  }
  return corners;
}

/// What of the sides is seen, and whether what is beside them there is darker.
struct SeenSides {
  const cv::Mat1b& even;
  const SheetCells& cells;
  int seen = 0, darker = 0, all = 0;

  /// The median brightness from near a place to far from it. Absent: outside the picture.
  std::optional<float> levelFrom(const Vec2& p, const Vec2& towards) const {
    std::vector<float> values;
    for (int d = kNearSideCells; d <= kBesideSideCells; ++d) {
      const Vec2 q = p + d * towards;
      const cv::Point at(cvRound(q.x()), cvRound(q.y()));
      if (at.x >= 0 && at.y >= 0 && at.x < even.cols && at.y < even.rows) values.push_back(cells.colour(at)[0]);
    }
    if (values.empty()) return std::nullopt;
    return upperMedian(values);
  }
  bool isOutline(const Vec2& p, const Vec2& inward) const {
    const auto isEven = [&](double d) {
      const Vec2 q = p + d * inward;
      const cv::Point at(cvRound(q.x()), cvRound(q.y()));
      return at.x >= 0 && at.y >= 0 && at.x < even.cols && at.y < even.rows && even(at) != 0;
    };
    return isEven(kNearSideCells) && !isEven(-kNearSideCells);
  }
  bool add(const Side& side, const Vec2& from, const Vec2& to) {
    const int length = std::max(1, static_cast<int>((to - from).norm()));
    int here = 0;
    for (int k = 0; k <= length; ++k) {
      const Vec2 p = from + (1.0 * k / length) * (to - from);
      ++all;
      if (!isOutline(p, side.inward)) continue;
      ++here;
      const std::optional<float> in = levelFrom(p, side.inward), out = levelFrom(p, -side.inward);
      if (in && (!out || *out < *in - kMostSheetStep)) ++darker;
    }
    seen += here;
    return here >= kLeastSeenOfSide * length;
  }
};

/// Whether so much beside the sheet is as bright and as even as it that it is paper.
bool isPaperBeside(const cv::Mat1b& sheet, const cv::Mat1b& beside, const PaperLook& paper, const SheetCells& cells) {
  const float grain = kGrain * std::max(paper.rough, static_cast<float>(kLeastGrain));
  int bright = 0;
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.cols; ++i)
      bright += beside(j, i) != 0 && cells.rough(j, i) <= grain && cells.colour(j, i)[0] >= kAsBright * paper.colour[0];
  }
  return bright >= kMostAsBright * cv::countNonZero(sheet);
}

/// Whether the ground about a bright panel is of the same paper, toned, and drawn upon.
bool isTonedPaper(const cv::Mat1b& sheet, const cv::Mat1b& beside, const PaperLook& paper, const SheetCells& cells) {
  const PaperLook ground = paperLookOf(beside, cells);
  if (ground.colour[0] < static_cast<float>(kDarkestOnSheet) * paper.colour[0]) return false;
  for (const int k : {1, 2})
    if (std::fabs(ground.colour[k] - paper.colour[k]) > kMostSheetStep) return false;
  if (ground.rough > kGrain * std::max(paper.rough, static_cast<float>(kLeastGrain))) return false;
  return ShadedPaper(sheet, cells).isDrawnOn(beside);
}

/// A camera in the hand is never quite square to the sheet; panels of a layout are.
bool isSquareToPicture(const std::vector<Side>& sides) {
  return std::ranges::all_of(sides, [](const Side& s) {
    return std::min(std::fabs(s.inward.x()), std::fabs(s.inward.y())) < std::sin(kLeastLean * kRadPerDeg);
  });
}

}  // namespace

std::optional<cv::Mat1b> straightSidedSheet(const cv::Mat1b& even, const SheetCells& cells) {
  cv::Mat1b open;
  cv::morphologyEx(even, open, cv::MORPH_OPEN, discOf(even.size(), kNeckShare), {-1, -1}, 1, cv::BORDER_REPLICATE);
  std::vector<Side> sides = sidesOf(open);
  const std::vector<Vec2> corners = cornersBetween(sides, even.size());
  if (corners.empty() || isSquareToPicture(sides)) return std::nullopt;
  std::vector<cv::Point> four;
  for (const Vec2& p : corners) four.emplace_back(cvRound(p.x()), cvRound(p.y()));
  cv::Mat1b sheet(even.size(), static_cast<unsigned char>(0));
  cv::fillConvexPoly(sheet, four, 255);
  if (cv::countNonZero(even & sheet) < kLeastFilled * cv::countNonZero(sheet)) return std::nullopt;
  SeenSides seen{even, cells};
  bool areAllSeen = true;
  for (int k = 0; k < kSides; ++k)
    areAllSeen = seen.add(sides[k], corners[(k + kSides - 1) % kSides], corners[k]) && areAllSeen;
  if (!areAllSeen || seen.seen < kLeastSeen * seen.all || seen.darker < kLeastDarkerBeside * seen.seen)
    return std::nullopt;
  const cv::Mat1b beside = grownMask(sheet, kSheetEdgeCells) == 0;
  const PaperLook paper = paperLookOf(even & sheet, cells);
  if (isPaperBeside(sheet, beside, paper, cells) || isTonedPaper(sheet, beside, paper, cells)) return std::nullopt;
  return sheet;
}

}  // namespace batten
