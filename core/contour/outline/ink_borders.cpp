// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/ink_borders.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/contour/outline/crack_contours.h"
#include "core/image/bits/bit_disc.h"

namespace batten {
namespace {

// [px] What a line has to be long, by the width of the pen.
double shortestPx(const ContourParams& params, double penPx) {
  return std::max(params.minLengthPx, params.minWidths * penPx);
}

// [px] A pen width for ink that is followed along its borders alone: that of its borders in the middle, where twice
// the area by the border is the width of a line; never more than a small mark may be wide.
double penOfBorders(const ContourSet& borders) {
  constexpr double kMostPenPx = 40.0 / 3.0;  // of whose usual least length, three widths, a small mark has 40 px
  std::vector<std::pair<double, double>> widths;
  double all = 0.0, sum = 0.0;
  for (const Contour& c : borders.contours) {
    if (c.hole) continue;
    widths.emplace_back(2.0 * c.areaPx / std::max(1.0, c.lengthPx), c.lengthPx);
    all += c.lengthPx;
  }
  std::sort(widths.begin(), widths.end());
  for (const auto& [width, length] : widths) {
    sum += length;
    if (2.0 * sum >= all) return std::min(width, kMostPenPx);
  }
  return 0.0;
}

}  // namespace

Result<ContourSet> bordersOf(const BitImage& ink, bool holes, const ContourParams& params, std::optional<double> penPx,
                             const BitImage* pencil, const RunContext& context) {
  // Of a line's least length: a dot half as wide as the pen, and the eye of an e.
  constexpr double kLeastDot = 0.5, kLeastHole = 1.0 / 3.0;
  constexpr double kGrain = 4.0;  // of it: specks and holes of a pencil are smaller
  Result<ContourSet> set = crackContours(ink, holes, params.minLengthPx, context);
  if (!set) return set;
  const double shortest = shortestPx(params, penPx ? *penPx : penOfBorders(*set));
  const auto isGrainy = [&](const Contour& c) {
    return pencil != nullptr && anyInDisc(*pencil, c.points.front().unrefined, 1.0);
  };
  const auto dropped = std::erase_if(set->contours, [&](const Contour& c) {
    const bool isShort = c.lengthPx < shortest * (isGrainy(c) ? kGrain : c.hole ? kLeastHole : kLeastDot);
    if (isShort && c.hole) set->report.droppedHolesPx += c.areaPx;
    return isShort;
  });
  set->report.droppedShort += static_cast<int>(dropped);
  return set;
}

void notePencil(ContourSet& borders, const BitImage& pencil, double pencilPx) {
  constexpr std::size_t kStep = 4;  // points, of which the neighbours lie in the same ink
  constexpr double kNear = 1.0;     // px: the border runs between ink and paper
  for (Contour& c : borders.contours) {
    int drawn = 0, seen = 0;
    for (std::size_t i = 0; i < c.points.size(); i += kStep) {
      ++seen;
      if (anyInDisc(pencil, c.points[i].unrefined, kNear)) ++drawn;
    }
    if (2 * drawn > seen) c.pencilPx = pencilPx;
  }
}

}  // namespace batten
