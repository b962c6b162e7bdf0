// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/otsu_thresholds.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/image/push_pull.h"
#include "core/image/region_values.h"

namespace batten {
namespace {

constexpr double kMinClassGap = 35.0;   // [grey]
constexpr double kMinSeparation = 0.7;  // share of the variance that lies between the classes

struct Split {
  double level = 0.0, bright = 0.0, gap = 0.0, separation = 0.0;
};

Split otsu(const std::array<int, 256>& counts) {
  double total = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t g = 0; g < 256; ++g) {
    const auto grey = static_cast<double>(g);
    total += counts[g];
    sum += counts[g] * grey;
    squares += counts[g] * grey * grey;
  }
  Split best;
  const double variance = total > 0.0 ? squares / total - (sum / total) * (sum / total) : 0.0;
  if (!(variance > 0.0)) return best;
  double below = 0.0, belowSum = 0.0, largest = 0.0;
  for (std::size_t g = 0; g + 1 < 256; ++g) {
    below += counts[g];
    belowSum += counts[g] * static_cast<double>(g);
    if (below <= 0.0 || below >= total) continue;
    const double dark = belowSum / below, bright = (sum - belowSum) / (total - below);
    const double between = below * (total - below) / (total * total) * (bright - dark) * (bright - dark);
    if (between <= largest) continue;
    largest = between;
    // Halfway between the means: an empty gap of the histogram leaves the cut itself undecided.
    best = {0.5 * (dark + bright), bright, bright - dark, between / variance};
  }
  return best;
}

}  // namespace

void otsuThresholds(const Plane& smoothed, double strength, RegionThresholds& out, const RunContext& context) {
  std::vector<float> value(kRegions, 0.0f), weight(kRegions, 0.0f);
  parallelFor(context, kRegions, 1, [&](int region, int) {
    const RegionBounds b = regionBounds(smoothed.width, smoothed.height, region);
    std::array<int, 256> counts{};
    for (int y = b.y0; y < b.y1; ++y) {
      for (int x = b.x0; x < b.x1; ++x) {
        ++counts[std::clamp(smoothed.row(y)[x] + 0.5f, 0.0f, 255.0f)];
      }
    }
    const Split split = otsu(counts);
    if (split.gap <= kMinClassGap || split.separation <= kMinSeparation) return;
    value[region] = static_cast<float>(split.bright - strength * (split.bright - split.level));
    weight[region] = 1.0f;
  });
  const std::vector<float> filled = pushPull(value, weight, kRegionsPerSide, kRegionsPerSide);
  out.foundLine = false;
  for (std::size_t r = 0; r < kRegions; ++r) {
    out.measured[r] = weight[r] > 0.0f;
    out.foundLine = out.foundLine || out.measured[r];
    out.automatic[r] = std::clamp(static_cast<double>(filled[r]), 0.0, 255.0);
  }
}

}  // namespace batten
