// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/straight_sided_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/angle.h"
#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/image/grown_mask.h"
#include "core/image/sheet/shaded_paper.h"
#include "core/image/sheet/sheet_drawn_edge.h"
#include "core/image/sheet/straight_sides.h"

namespace batten {
namespace {

constexpr double kLeastEvenShare = 0.75;                    // of the quadrilateral: things lie on the sheet, too
constexpr double kLeastSeenOfSide = 0.3;                    // of a side's length; things hide the rest
constexpr double kLeastSeenOfAll = 0.6;                     // of all sides
constexpr double kLeastDarkerBeside = 0.8;                  // of the places that are seen
constexpr int kNearSideCells = 3, kBesideSideCells = 9;     // from a side: what is looked at on both
constexpr double kLeastCorner = 50.0, kMostCorner = 130.0;  // [degrees] a rectangle seen at an angle
constexpr double kLeastLean = 1.5;                          // [degrees] of a side against the picture's
constexpr float kAsBright = 0.85f;                          // of the sheet's brightness
constexpr double kMostAsBright = 0.1;                       // of the sheet: so much beside it is no glint
constexpr double kLeastToned = 0.3, kAllToned = 0.9;  // of what is beside the sheet: shapes drawn there take the rest
constexpr auto kGrain = static_cast<float>(kSameGrain);

std::optional<Vec2> crossing(const StraightSide& a, const StraightSide& b) {
  const double det = a.inward.x() * b.inward.y() - a.inward.y() * b.inward.x();
  if (std::fabs(det) < 1e-3) return std::nullopt;
  return Vec2((a.offset * b.inward.y() - b.offset * a.inward.y()) / det,
              (b.offset * a.inward.x() - a.offset * b.inward.x()) / det);
}

/// The corners where each side meets the next, the sides in order round the sheet. Empty: they are no quadrilateral
/// that a rectangle could look like, or it does not lie in the picture.
std::vector<Vec2> cornersBetween(std::vector<StraightSide>& sides, const cv::Size& size) {
  if (std::ssize(sides) != kMostSides) return {};
  std::ranges::sort(sides, {}, [](const StraightSide& s) { return std::atan2(s.inward.y(), s.inward.x()); });
  std::vector<Vec2> corners;
  for (int k = 0; k < kMostSides; ++k) {
    const StraightSide &a = sides[k], &b = sides[(k + 1) % kMostSides];
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
    std::vector<float> values = levelsAlong(cells, p, towards, {kNearSideCells, kBesideSideCells});
    if (values.empty()) return std::nullopt;
    return upperMedian(std::move(values));
  }
  bool isOutline(const Vec2& p, const Vec2& inward) const {
    const auto isEven = [&](double d) {
      const std::optional<cv::Point> at = cellAt(cells, p + d * inward);
      return at && even(*at) != 0;
    };
    return isEven(kNearSideCells) && !isEven(-kNearSideCells);
  }
  bool add(const StraightSide& side, const Vec2& from, const Vec2& to) {
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

/// Whether a good part of the ground about a bright panel is of the same paper, toned, with something drawn upon it.
bool isTonedPaper(const cv::Mat1b& sheet, const cv::Mat1b& beside, const PaperLook& paper, const SheetCells& cells) {
  const float grain = kGrain * std::max(paper.rough, static_cast<float>(kLeastGrain));
  const float darkest = static_cast<float>(kDarkestOnSheet) * paper.colour[0];
  int toned = 0;
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.cols; ++i) {
      if (beside(j, i) == 0 || cells.rough(j, i) > grain || cells.colour(j, i)[0] < darkest) continue;
      const cv::Vec3f apart = cells.colour(j, i) - paper.colour;
      toned += std::max(std::fabs(apart[1]), std::fabs(apart[2])) <= kMostSheetStep ? 1 : 0;
    }
  }
  const double share = toned / std::max(1.0, 1.0 * cv::countNonZero(beside));
  if (share < kLeastToned) return false;
  return share < kAllToned || ShadedPaper(sheet, cells).isDrawnOn(beside);
}

/// A camera in the hand is never quite square to the sheet; panels of a layout are.
bool isSquareToPicture(const std::vector<StraightSide>& sides) {
  return std::ranges::all_of(sides, [](const StraightSide& s) {
    return std::min(std::fabs(s.inward.x()), std::fabs(s.inward.y())) < std::sin(kLeastLean * kRadPerDeg);
  });
}

}  // namespace

std::optional<cv::Mat1b> straightSidedSheet(const cv::Mat1b& even, const SheetCells& cells) {
  cv::Mat1b open;
  cv::morphologyEx(even, open, cv::MORPH_OPEN, discOf(even.size(), kNeckShare), {-1, -1}, 1, cv::BORDER_REPLICATE);
  std::vector<StraightSide> sides = straightSides(open);
  const std::vector<Vec2> corners = cornersBetween(sides, even.size());
  if (corners.empty() || isSquareToPicture(sides)) return std::nullopt;
  std::vector<cv::Point> four;
  four.reserve(corners.size());
  for (const Vec2& p : corners) four.emplace_back(cvRound(p.x()), cvRound(p.y()));
  cv::Mat1b sheet(even.size(), static_cast<unsigned char>(0));
  cv::fillConvexPoly(sheet, four, 255);
  if (cv::countNonZero(even & sheet) < kLeastEvenShare * cv::countNonZero(sheet)) return std::nullopt;
  SeenSides seen{even, cells};
  bool areAllSeen = true;
  for (int k = 0; k < kMostSides; ++k)
    areAllSeen = seen.add(sides[k], corners[(k + kMostSides - 1) % kMostSides], corners[k]) && areAllSeen;
  if (!areAllSeen || seen.seen < kLeastSeenOfAll * seen.all || seen.darker < kLeastDarkerBeside * seen.seen)
    return std::nullopt;
  const cv::Mat1b beside = grownMask(sheet, kSheetEdgeCells) == 0;
  const PaperLook paper = paperLookOf(even & sheet, cells);
  if (isPaperBeside(sheet, beside, paper, cells) || isTonedPaper(sheet, beside, paper, cells)) return std::nullopt;
  return sheet;
}

}  // namespace batten
