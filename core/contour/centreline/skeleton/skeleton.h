// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// A pixel of the page.
struct SkeletonPixel {
  int x = 0, y = 0;
  bool operator==(const SkeletonPixel&) const = default;
};

/// A run of skeleton pixels between two nodes (free ends or junctions), both included, or a ring (first not repeated).
struct SkeletonChain {
  std::vector<SkeletonPixel> pixels;
  bool closed = false;
  bool freeStart = false, freeEnd = false;  ///< The skeleton ends there; else a junction.
};

/// One pixel wide skeleton with the topology of the ink (Guo and Hall 1989, two sub-iterations). False when cancelled.
bool thinToSkeleton(BitImage& ink, const RunContext& context);

/// Chains of the pixel graph: 8-neighbours, a diagonal counts only if neither of the two shared 4-neighbours is set.
std::vector<SkeletonChain> skeletonChains(const BitImage& skeleton);

/// Distance [px] from the centre of an ink pixel to the nearest centre of a paper pixel (exact; outside the page is
/// paper). Cheap for strokes, so that no distance picture of the whole page is needed.
double inkRadius(const BitImage& ink, int x, int y);

}  // namespace batten
