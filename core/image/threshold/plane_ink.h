// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_surface.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// A shrunken page, and the levels on it.
struct ShrunkenPage {
  const Plane& grey;
  const PaperBackground& paper;
  const RegionValues& contrasts;  ///< [grey] Of the 64 regions, added to the paper.
  int shrink;                     ///< Pixels of the page along one of the plane.
};

/// Where the smoothed plane is darker than the paper and the contrast there. Most of it is brighter than any level near
/// it, and is passed over.
BitImage inkOfPlane(const ShrunkenPage&, const std::vector<float>& kernel, const RunContext&);

}  // namespace batten
