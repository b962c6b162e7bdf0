// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/grey_parts.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_surface.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

/// Border squared by 16 areas: 1 for a square, n / 4 for a stroke n times as long as wide.
constexpr double kLongestMesh = 2.0;
constexpr int kNoisePx = 4;  // [px] area: smaller pieces may be noise

std::int64_t piecesBeyondNoise(const BitImage& image, Connectivity connectivity, const RunContext& context) {
  const std::vector<std::int64_t> area = areasOfPieces(findPieces(image, connectivity, context));
  return std::count_if(area.begin(), area.end(), [](std::int64_t a) { return a >= kNoisePx; });
}

}  // namespace

GreyParts greyPartsOf(const GreyImage& image, const RegionThresholds& thresholds, const RunContext& context) {
  GreyParts parts;
  const Plane smoothed =
      smooth(shrinkGrey(image, 1, context), gaussianKernel(thresholds.smoothingPx * thresholds.smoothingPx), context);
  if (context.isCancelled()) return parts;
  BitImage bright(image.width, image.height), dark(image.width, image.height);
  const RegionSurface levels(thresholds.automatic, image.width, image.height, true);
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<float> level(image.width);
    for (int y = begin; y < end; ++y) {
      levels.fillRow(y, level.data());
      for (int x = 0; x < image.width; ++x) (smoothed.row(y)[x] < level[x] ? dark : bright).set(x, y, true);
    }
  });
  const std::int64_t meshes = piecesBeyondNoise(bright, Connectivity::Four, context);
  if (context.isCancelled()) return parts;
  parts.pieces = meshes + piecesBeyondNoise(dark, Connectivity::Eight, context);
  const auto area = static_cast<double>(bright.count());
  const double border = area - static_cast<double>(shrunken(bright, 1, context).count());
  parts.hasMeshes = meshes > 0 && border * border <= kLongestMesh * 16.0 * area * static_cast<double>(meshes);
  return parts;
}

bool variesMoreThanLines(const Plane& grey, const RegionValues& halfLevels) {
  constexpr double kMore = 1.5;  // times half the contrast, with which the smoothing before the thresholds has to do
  constexpr int kStep = 11;  // one pixel of a row in so many, so that no period of rows or of columns is met in step
  int more = 0;
  for (int r = 0; r < kRegions; ++r) {
    const RegionBounds b = regionBounds(grey.width, grey.height, r);
    double count = 0.0, sum = 0.0, squares = 0.0;
    for (int y = b.y0; y < b.y1; ++y) {
      const int first = b.x0 + ((2 * y - b.x0) % kStep + kStep) % kStep;
      for (int x = first; x < b.x1; x += kStep) {
        const auto level = static_cast<double>(grey.row(y)[x]);
        count += 1.0;
        sum += level;
        squares += level * level;
      }
    }
    if (count <= 0.0) continue;
    const double mean = sum / count, limit = kMore * halfLevels[r];
    more += squares / count - mean * mean > limit * limit ? 1 : 0;
  }
  return 2 * more >= kRegions;
}

}  // namespace batten
