// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/page_edge_lines.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace batten {
namespace {

// All of the shorter side of the page, but for the length, which is of the side that the line runs along.
constexpr double kNearBorder = 0.03;  // the edge of a sheet that fills the picture
constexpr double kLong = 0.3;         // shorter ones near the border are drawn
constexpr double kAlone = 0.015;      // of any other line: a frame, a table or the ground touches something

struct Page {
  double width, height;
  double shorter() const { return std::min(width, height); }
};

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
  if (line.traceMode || extent.most.y() > kNearBorder * page.shorter() ||
      extent.most.x() - extent.least.x() < kLong * along)
    return false;
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

void dropPageEdgeLines(ContourSet& set, int pageWidth, int pageHeight) {
  const Page page{static_cast<double>(pageWidth), static_cast<double>(pageHeight)};
  std::vector<bool> isEdge(set.contours.size(), false);
  for (int k = 0; k < std::ssize(set.contours); ++k)
    for (int side = 0; side < 4 && !isEdge[k]; ++side) isEdge[k] = isSheetEdge(side, k, set.contours, page);
  if (std::find(isEdge.begin(), isEdge.end(), false) == isEdge.end()) return;
  std::size_t index = 0;
  set.report.droppedMargins +=
      static_cast<int>(std::erase_if(set.contours, [&](const Contour&) { return isEdge[index++]; }));
}

}  // namespace batten
