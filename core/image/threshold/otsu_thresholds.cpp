// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/otsu_thresholds.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/image/push_pull.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

constexpr double kMinClassGap = 35.0;  // [grey]
// Share of the variance that lies between the classes.
constexpr double kMinSeparation = 0.7;
/// Hardly smoothed, noise of a sensor reaches .69, black and white pixels at random .722, a net of hairlines 4 px apart
/// has .735 and more, dense hatching .8.
constexpr double kMinFineSeparation = 0.73;
/// Of the pixels of a region: lines that are brighter than their paper leave it more of them. Of hatching whose lines
/// are as wide as their gaps, pixels that are part of both can make up to two thirds dark.
constexpr float kMostlyDark = 0.7f;

using GreyCounts = std::array<int, 256>;

struct Split {
  double level = 0.0, bright = 0.0, gap = 0.0, separation = 0.0, darkShare = 0.0;
};

Split otsu(const GreyCounts& counts) {
  double total = 0.0, sum = 0.0, squares = 0.0;
  for (int grey = 0; grey < 256; ++grey) {
    const double weight = counts[grey];
    total += weight;
    sum += weight * grey;
    squares += weight * grey * grey;
  }
  Split best;
  const double variance = total > 0.0 ? squares / total - (sum / total) * (sum / total) : 0.0;
  if (!(variance > 0.0)) return best;
  double below = 0.0, belowSum = 0.0, largest = 0.0;
  for (int grey = 0; grey < 255; ++grey) {
    const double weight = counts[grey];
    below += weight;
    belowSum += weight * grey;
    if (below <= 0.0 || below >= total) continue;
    const double dark = belowSum / below, bright = (sum - belowSum) / (total - below);
    const double between = below * (total - below) / (total * total) * (bright - dark) * (bright - dark);
    if (between <= largest) continue;
    largest = between;
    // Halfway between the means: an empty gap of the histogram leaves the cut itself undecided.
    best = {0.5 * (dark + bright), bright, bright - dark, between / variance, below / total};
  }
  return best;
}

void addCounts(const Plane& plane, const RegionBounds& b, GreyCounts& counts) {
  for (int y = b.y0; y < b.y1; ++y) {
    for (int x = b.x0; x < b.x1; ++x) ++counts[std::clamp(plane.row(y)[x] + 0.5f, 0.0f, 255.0f)];
  }
}

/// @param countsOf the greys of a region
template <class CountsOf>
OtsuThresholds splitRegions(const CountsOf& countsOf, double minSeparation, double strength,
                            const RunContext& context) {
  std::vector<float> value(kRegions, 0.0f), weight(kRegions, 0.0f), darkShare(kRegions, 0.0f);
  std::vector<double> separation(kRegions, 0.0);
  parallelFor(context, kRegions, 1, [&](int region, int) {
    const Split split = otsu(countsOf(region));
    if (split.gap <= kMinClassGap || split.separation <= minSeparation) return;
    value[region] = static_cast<float>(split.bright - strength * (split.bright - split.level));
    weight[region] = 1.0f;
    darkShare[region] = static_cast<float>(split.darkShare);
    separation[region] = split.separation;
  });
  const std::vector<float> filled = pushPull(value, weight, kRegionsPerSide, kRegionsPerSide);
  OtsuThresholds regions;
  RegionThresholds& out = regions.thresholds;
  for (int r = 0; r < kRegions; ++r) {
    out.measured[r] = weight[r] > 0.0f;
    if (out.measured[r]) ++regions.split;
    regions.separation += separation[r];
    if (darkShare[r] > kMostlyDark) ++regions.mostlyDark;
    out.automatic[r] = std::clamp(static_cast<double>(filled[r]), 0.0, 255.0);
  }
  if (regions.split > 0) regions.separation /= regions.split;
  out.foundLine = regions.split > 0;
  return regions;
}

}  // namespace

OtsuThresholds otsuThresholds(const Plane& smoothed, double smoothingPx, double strength, const RunContext& context) {
  const auto countsOf = [&](int region) {
    GreyCounts counts{};
    addCounts(smoothed, regionBounds(smoothed.width, smoothed.height, region), counts);
    return counts;
  };
  OtsuThresholds found = splitRegions(countsOf, kMinSeparation, strength, context);
  found.thresholds.smoothingPx = smoothingPx;
  return found;
}

OtsuThresholds fineOtsuThresholds(const GreyImage& image, double strength, const RunContext& context) {
  const std::vector<float> kernel = gaussianKernel(kFineSmoothingPx * kFineSmoothingPx);
  const auto countsOf = [&](int region) {
    const RegionBounds b = regionBounds(image.width, image.height, region);
    GreyCounts counts{};
    if (b.x0 == b.x1 || b.y0 == b.y1) return counts;
    Plane part(b.x1 - b.x0, b.y1 - b.y0);
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) part.row(y)[x] = static_cast<float>(image.level(b.x0 + x, b.y0 + y));
    }
    RunContext alone = context;  // regions run in parallel already
    alone.threads = 1;
    addCounts(smooth(part, kernel, alone), {0, 0, part.width, part.height}, counts);
    return counts;
  };
  OtsuThresholds found = splitRegions(countsOf, kMinFineSeparation, strength, context);
  found.thresholds.smoothingPx = kFineSmoothingPx;
  return found;
}

}  // namespace batten
