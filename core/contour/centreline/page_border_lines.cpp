// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/page_border_lines.h"

#include <algorithm>
#include <limits>

namespace batten {
namespace {

constexpr double kTouchPx = 2.0, kMostly = 0.7;  // from the stroke to the border of the page; of its points
// All of the shorter side of the page, but for the length, which is of the side that the line runs along.
constexpr double kNearBorder = 0.03;  // the edge of a sheet that fills the picture
constexpr double kStraight = 0.015;   // sheets lie and are scanned a little askew
constexpr double kLong = 0.3;
constexpr double kAlone = 0.015;  // of any other line: a frame, a table or the ground touches something

struct Page {
  double width, height;
  double shorter() const { return std::min(width, height); }
};

bool touchesBorder(const Contour& c, const Page& page, double pixelsPerPx) {
  int touching = 0;
  for (const ContourPoint& point : c.points) {
    const Vec2& p = point.at;
    const double toBorder = std::min({p.x(), p.y(), page.width - p.x(), page.height - p.y()});
    if (toBorder <= 0.5 * point.widthPx.value_or(0.0f) + kTouchPx * pixelsPerPx) ++touching;
  }
  return static_cast<double>(touching) >= kMostly * static_cast<double>(c.points.size());
}

/// A place as seen from one side of the page: along it, and inwards.
Vec2 seenFrom(int side, const Vec2& p, const Page& page) {
  switch (side) {
    case 0:
      return {p.x(), p.y()};
    case 1:
      return {p.x(), page.height - p.y()};
    case 2:
      return {p.y(), p.x()};
    default:
      return {p.y(), page.width - p.x()};
  }
}

struct Extent {
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity()), most = -least;
};
Extent extentFrom(int side, const Contour& c, const Page& page) {
  Extent extent;
  for (const ContourPoint& point : c.points) {
    const Vec2 p = seenFrom(side, point.at, page);
    extent.least = extent.least.cwiseMin(p), extent.most = extent.most.cwiseMax(p);
  }
  return extent;
}

bool isSheetEdge(int side, int index, const std::vector<Contour>& contours, const Page& page) {
  const Contour& line = contours[index];
  const Extent extent = extentFrom(side, line, page);
  const double along = side < 2 ? page.width : page.height;
  if (line.closed || extent.most.y() > kNearBorder * page.shorter() ||
      extent.most.x() - extent.least.x() < kLong * along)
    return false;
  if (extent.most.y() - extent.least.y() > kStraight * page.shorter()) return false;
  const double alone = kAlone * page.shorter();
  for (int k = 0; k < std::ssize(contours); ++k) {
    if (k == index) continue;
    for (const ContourPoint& point : contours[k].points) {
      const Vec2 p = seenFrom(side, point.at, page);
      const bool isBeside = p.x() > extent.least.x() - alone && p.x() < extent.most.x() + alone;
      if (isBeside && p.y() < extent.most.y() + alone) return false;
    }
  }
  return true;
}

}  // namespace

int dropPageBorderLines(std::vector<Contour>& contours, int pageWidth, int pageHeight, double pixelsPerPx) {
  const Page page{static_cast<double>(pageWidth), static_cast<double>(pageHeight)};
  int dropped =
      static_cast<int>(std::erase_if(contours, [&](const Contour& c) { return touchesBorder(c, page, pixelsPerPx); }));
  std::vector<bool> isEdge(contours.size(), false);
  for (int k = 0; k < std::ssize(contours); ++k)
    for (int side = 0; side < 4 && !isEdge[k]; ++side) isEdge[k] = isSheetEdge(side, k, contours, page);
  std::size_t k = 0;
  dropped += static_cast<int>(std::erase_if(contours, [&](const Contour&) { return isEdge[k++]; }));
  return dropped;
}

}  // namespace batten
