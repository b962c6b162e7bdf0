// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bit_image.h"

namespace batten {

/// A part of the page that the user wants traced: a polygon, closed by itself; crossing sides count even-odd.
struct RegionOfInterest {
  std::vector<Vec2> cornersPx;  ///< [px] at least three.
  bool operator==(const RegionOfInterest& o) const { return cornersPx == o.cornersPx; }
};
/// The rectangle with these opposite corners.
RegionOfInterest rectangleRegion(const Vec2& a, const Vec2& b);
std::optional<Error> validate(const RegionOfInterest&);

/// Whether a place lies in one of the regions.
bool isInside(std::span<const RegionOfInterest>, const Vec2& px);

/// The pieces of ink that reach into a region, whole: what is cut is the line, not the ink, so that no border of a
/// region is ever traced.
BitImage inkTouching(const BitImage& ink, std::span<const RegionOfInterest>, const RunContext&);

/// The parts of lines that lie inside: a line that crosses a border ends there, a closed one becomes open. Parts
/// shorter than `minLengthPx` are dropped; longest first as before.
ContourSet keepInside(ContourSet, std::span<const RegionOfInterest>, double minLengthPx);

}  // namespace batten
