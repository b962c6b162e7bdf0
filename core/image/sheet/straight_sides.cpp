// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/straight_sides.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/image/sheet/mask_outline.h"

namespace batten {
namespace {

constexpr std::size_t kOutlinePlaces = 400;
constexpr double kOnSideCells = 1.5;      // of a side: its course in cells
constexpr double kLeastDirect = 0.98;     // of the way along the outline by its middle
constexpr double kLeastOfOutline = 0.06;  // of the outline of an even area: fewer of its cells make no side
constexpr double kMostBeyondSide =
    0.06;  // of an even area may lie beyond one side: it goes on into something as bright

/// Places of the outline of the largest part, at equal distances; not at the border of the picture.
std::vector<Vec2> outlineCells(const cv::Mat1b& even) {
  const std::vector<cv::Point> outline = largestOutline(even);
  std::vector<Vec2> places;
  const std::size_t step = std::max<std::size_t>(1, outline.size() / kOutlinePlaces);
  for (std::size_t k = 0; k < outline.size(); k += step) {
    const cv::Point& p = outline[k];
    if (p.x > 1 && p.y > 1 && p.x < even.cols - 2 && p.y < even.rows - 2) places.emplace_back(p.x, p.y);
  }
  return places;
}

/// Every few cells of a mask.
std::vector<Vec2> sampledCells(const cv::Mat1b& even) {
  constexpr int kStep = 6;
  std::vector<Vec2> places;
  for (int j = 0; j < even.rows; j += kStep) {
    for (int i = 0; i < even.cols; i += kStep)
      if (even(j, i) != 0) places.emplace_back(i, j);
  }
  return places;
}

StraightSide through(const Vec2& a, const Vec2& b) {
  const Vec2 along = (b - a).normalized();
  const Vec2 inward(-along.y(), along.x());
  return {inward, inward.dot(a), 0};
}

int countOn(const StraightSide& side, const std::vector<Vec2>& places) {
  return static_cast<int>(
      std::ranges::count_if(places, [&](const Vec2& p) { return std::fabs(side.depth(p)) <= kOnSideCells; }));
}

/// The line through most places of the outline, with hardly any of the area beyond it.
std::optional<StraightSide> bestSide(const std::vector<Vec2>& outline, const std::vector<Vec2>& area, int fewest) {
  constexpr int kTried = 120;
  constexpr std::size_t kAsked = 40;  // whether the area lies on one side of them
  const int n = static_cast<int>(outline.size()), step = std::max(1, n / kTried);
  std::vector<StraightSide> sides;
  for (const int span : {n / 24, n / 10}) {
    for (int i = 0; span > 0 && i < n; i += step) {
      const Vec2 &a = outline[i], &b = outline[(i + span) % n];
      if (const Vec2& middle = outline[(i + span / 2) % n];  // the outline bends between them
          (b - a).norm() < kLeastDirect * ((middle - a).norm() + (b - middle).norm()))
        continue;
      StraightSide side = through(a, b);
      side.count = countOn(side, outline);
      if (side.count >= fewest) sides.push_back(side);
    }
  }
  std::ranges::stable_sort(sides, [](const StraightSide& a, const StraightSide& b) { return a.count > b.count; });
  if (sides.size() > kAsked) sides.resize(kAsked);
  for (StraightSide side : sides) {
    const auto beyond = std::ranges::count_if(area, [&](const Vec2& p) { return side.depth(p) < -kOnSideCells; });
    const auto within = std::ranges::count_if(area, [&](const Vec2& p) { return side.depth(p) > kOnSideCells; });
    if (static_cast<double>(std::min(beyond, within)) > kMostBeyondSide * static_cast<double>(area.size())) continue;
    if (beyond > within) side = {-side.inward, -side.offset, side.count};
    return side;
  }
  return std::nullopt;
}

}  // namespace

std::vector<StraightSide> straightSides(const cv::Mat1b& area) {
  std::vector<Vec2> outline = outlineCells(area);
  const std::vector<Vec2> cells = sampledCells(area);
  const int fewest = std::max(8, static_cast<int>(kLeastOfOutline * static_cast<double>(outline.size())));
  std::vector<StraightSide> sides;
  while (std::ssize(sides) < kMostSides) {
    const std::optional<StraightSide> side = bestSide(outline, cells, fewest);
    if (!side) break;
    sides.push_back(*side);
    std::erase_if(outline, [&](const Vec2& p) { return std::fabs(side->depth(p)) <= 2.0 * kOnSideCells; });
  }
  return sides;
}

}  // namespace batten
