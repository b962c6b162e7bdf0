// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

/// [px] Which points of a side count, by their distance from the corner along the line.
struct SideZone {
  double inner = 0.0, outer = 0.0;
};

/// Hands the points of a line on one side (1: ahead, -1: behind) of a place to `take(point, arc)`, in their order away
/// from it; arc is their distance along the line [px]. Of closed lines half at most.
template <class Take>
void forPointsAside(const Contour& contour, int index, int side, const SideZone& zone, const Take& take) {
  const int n = static_cast<int>(contour.points.size()), most = contour.closed ? n / 2 : n;
  const auto place = [&](int k) { return contour.closed ? wrapIndex(index + side * k, n) : index + side * k; };
  double arc = 0.0;
  for (int k = 0; k < most; ++k) {
    const int i = place(k);
    if (i < 0 || i >= n) break;
    const ContourPoint& p = contour.points[i];
    if (k > 0) arc += (p.at - contour.points[place(k - 1)].at).norm();
    if (arc > zone.outer) break;
    if (arc >= zone.inner) take(p, arc);
  }
}

}  // namespace batten
