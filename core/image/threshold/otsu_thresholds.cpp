// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/otsu_thresholds.h"

#include <algorithm>
#include <cstdlib>

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
/// Hatching is known by its direction, not by its greys: a wave of which a pixel shows a quarter leaves .667 between
/// the classes, noise of one grey .64, and its dark pixels may be three quarters of all.
constexpr double kMinHatchingSeparation = 0.65;
constexpr float kMostlyDarkHatching = 0.8f;

/// [px] So much leaves the gaps between hairlines that are 2 to 3 px from middle to middle.
constexpr double kHairSmoothingPx = 0.5;

using GreyCounts = std::array<int, 256>;

/// What parts a region into two greys.
struct SplitLimits {
  double minSeparation = kMinSeparation;
  float mostlyDark = kMostlyDark;
};

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
OtsuThresholds splitRegions(const CountsOf& countsOf, const SplitLimits& limits, double strength,
                            const RunContext& context) {
  std::vector<float> value(kRegions, 0.0f), weight(kRegions, 0.0f), darkShare(kRegions, 0.0f);
  std::vector<double> separation(kRegions, 0.0);
  parallelFor(context, kRegions, 1, [&](int region, int) {
    const Split split = otsu(countsOf(region));
    if (split.gap <= kMinClassGap || split.separation <= limits.minSeparation) return;
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
    if (darkShare[r] > limits.mostlyDark) ++regions.mostlyDark;
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
  OtsuThresholds found = splitRegions(countsOf, {}, strength, context);
  found.thresholds.smoothingPx = smoothingPx;
  return found;
}

namespace {

/// The grey of a region.
Plane partOf(const GreyImage& image, const RegionBounds& b) {
  Plane part(b.x1 - b.x0, b.y1 - b.y0);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) part.row(y)[x] = static_cast<float>(image.level(b.x0 + x, b.y0 + y));
  }
  return part;
}

/// How much pixels differ that lie so far apart, of what two that know nothing of each other do: about 1 for these, 0
/// along a line.
double differenceOver(const Plane& part, int right, int down, double variance) {
  constexpr int kStep = 2;  // of the rows that are looked at
  const int first = std::max(0, -right), last = std::min(part.width, part.width - right);
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y + down < part.height; y += kStep) {
    const float *row = part.row(y), *other = part.row(y + down);
    for (int x = first; x < last; ++x, ++count) {
      const auto difference = static_cast<double>(row[x] - other[x + right]);
      sum += difference * difference;
    }
  }
  return count > 0 ? sum / (2.0 * count * variance) : 1.0;
}

/// Whether the grey stays along one direction and changes across it within a few pixels.
bool isHatching(const Plane& part) {
  constexpr int kReach = 7, kNear = 4;  // [px] far enough to tell directions apart; less says nothing of lines
  constexpr double kMostAlong = 0.3, kLeastAcross = 0.7;
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const double grey = part.row(y)[x];
      sum += grey;
      squares += grey * grey;
    }
  }
  const double count = static_cast<double>(part.width) * part.height;
  if (std::min(part.width, part.height) <= 2 * kReach) return false;
  const double variance = squares / count - (sum / count) * (sum / count);
  if (!(variance > 0.0)) return false;
  double least = 1.0, most = 0.0;
  for (int down = 0; down <= kReach; ++down) {
    for (int right = -kReach; right <= kReach; ++right) {
      if (std::max(std::abs(right), down) < kNear || (down == 0 && right < 0)) continue;
      const double difference = differenceOver(part, right, down, variance);
      least = std::min(least, difference);
      most = std::max(most, difference);
    }
  }
  return least <= kMostAlong && most >= kLeastAcross;
}

/// @param mayCount whether the grey of a region counts.
template <class MayCount>
OtsuThresholds fineThresholds(const GreyImage& image, double smoothingPx, const SplitLimits& limits, double strength,
                              const MayCount& mayCount, const RunContext& context) {
  const std::vector<float> kernel = gaussianKernel(smoothingPx * smoothingPx);
  const auto countsOf = [&](int region) {
    const RegionBounds b = regionBounds(image.width, image.height, region);
    GreyCounts counts{};
    if (b.x0 == b.x1 || b.y0 == b.y1) return counts;
    const Plane part = partOf(image, b);
    if (!mayCount(part)) return counts;
    RunContext alone = context;  // regions run in parallel already
    alone.threads = 1;
    addCounts(smooth(part, kernel, alone), {0, 0, part.width, part.height}, counts);
    return counts;
  };
  OtsuThresholds found = splitRegions(countsOf, limits, strength, context);
  found.thresholds.smoothingPx = smoothingPx;
  return found;
}

}  // namespace

OtsuThresholds fineOtsuThresholds(const GreyImage& image, double strength, const RunContext& context) {
  return fineThresholds(
      image, kFineSmoothingPx, {.minSeparation = kMinFineSeparation}, strength, [](const Plane&) { return true; },
      context);
}

OtsuThresholds hatchingThresholds(const GreyImage& image, double strength, const RunContext& context) {
  return fineThresholds(image, kHairSmoothingPx, {kMinHatchingSeparation, kMostlyDarkHatching}, strength, isHatching,
                        context);
}

}  // namespace batten
