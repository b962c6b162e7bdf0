// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// A part of the page to trace: a polygon, closed implicitly, filled by the even-odd rule.
struct RegionOfInterest {
  std::vector<Vec2> cornersPx;  ///< [px] at least three.
  bool operator==(const RegionOfInterest& o) const { return cornersPx == o.cornersPx; }
};
/// The rectangle with these opposite corners.
RegionOfInterest rectangleRegion(const Vec2& a, const Vec2& b);
/// A region needs three corners or more, all finite, and an area.
std::optional<Error> validate(const RegionOfInterest&);

/// Whether a place lies in one of the regions.
bool isInside(std::span<const RegionOfInterest>, const Vec2& px);

/// The pieces of ink that reach into a region, complete. Lines are cut later and not the ink, so that the border of a
/// region is never traced.
BitImage inkTouching(const BitImage& ink, std::span<const RegionOfInterest>, const RunContext&);

/// The parts of lines inside the regions. A line that crosses a border ends there; a closed line becomes open. Parts
/// shorter than `minLengthPx` are dropped; longest first as before.
ContourSet keepInside(ContourSet, std::span<const RegionOfInterest>, double minLengthPx);

}  // namespace batten
