// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "core/base/conventions.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// Bounds [x0, x1) x [y0, y1) of a region in px: floor(i * size / 8).
struct RegionBounds {
  int x0, y0, x1, y1;
};
RegionBounds regionBounds(int width, int height, int region);
/// [px] Of a region.
Vec2 regionCentre(int width, int height, int region);

/// Histogram of the grey levels of one region, 256 bins, for the inspector. @pre 0 <= region < 64.
std::array<std::uint32_t, 256> regionHistogram(const GreyImage&, int region);

}  // namespace batten
