// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr int kStrips = 8;
constexpr int kLeastStretchSide = 160;         // [grid] smaller pictures hold no ruled page
constexpr double kSteepest = 0.2;              // of the lines
constexpr double kLeastOfStrip = 0.35;         // of the columns of a strip that must hold the line
constexpr std::array<int, 2> kSides = {2, 5};  // [grid] where the paper beside a thin line is looked for
constexpr int kAlong = 2;                      // [grid] half the length over which grey is averaged along the lines
constexpr float kLeastDepth = 2.0f;            // [grey]
constexpr double kDepthPerNoise = 2.5;
constexpr int kNoiseStride = 7;

struct LinePixel {
  float x, y;
};

/// The plane averaged along x over 2 kAlong + 1 pixels.
Plane averagedAlong(const Plane& grey, const RunContext& context) {
  Plane out(grey.width, grey.height);
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* in = grey.row(y);
      float* to = out.row(y);
      for (int x = 0; x < grey.width; ++x) {
        float sum = 0.0f;
        for (int i = -kAlong; i <= kAlong; ++i) sum += in[std::clamp(x + i, 0, grey.width - 1)];
        to[x] = sum / static_cast<float>(2 * kAlong + 1);
      }
    }
  });
  return out;
}

double noiseAcross(const Plane& grey) {
  std::vector<float> steps;
  for (int y = 0; y + 1 < grey.height; y += kNoiseStride) {
    for (int x = y % kNoiseStride; x < grey.width; x += kNoiseStride)
      steps.push_back(grey.row(y + 1)[x] - grey.row(y)[x]);
  }
  return robustSigma(steps) / std::sqrt(2.0);
}

/// How much darker a pixel is than the paper above and below it.
float depthAt(const Plane& grey, int x, int y) {
  const float here = grey.row(y)[x];
  float depth = 0.0f;
  for (const int side : kSides) {
    if (y < side || y + side >= grey.height) continue;
    depth = std::max(depth, std::min(grey.row(y - side)[x], grey.row(y + side)[x]) - here);
  }
  return depth;
}

/// Pixels in the middle of thin dark lines, strip by strip.
std::array<std::vector<LinePixel>, kStrips> linePixels(const Plane& grey, const RunContext& context) {
  std::array<std::vector<LinePixel>, kStrips> pixels;
  const float least = std::max(kLeastDepth, static_cast<float>(kDepthPerNoise * noiseAcross(grey)));
  parallelFor(context, kStrips, 1, [&](int begin, int end) {
    for (int s = begin; s < end; ++s) {
      const int x0 = s * grey.width / kStrips, x1 = (s + 1) * grey.width / kStrips;
      for (int y = 1; y + 1 < grey.height; ++y) {
        const float *above = grey.row(y - 1), *row = grey.row(y), *below = grey.row(y + 1);
        for (int x = x0; x < x1; ++x) {
          if (row[x] > above[x] || row[x] >= below[x] || depthAt(grey, x, y) < least) continue;
          const float bend = above[x] - 2.0f * row[x] + below[x];
          const float shift = bend > 0.0f ? 0.5f * (above[x] - below[x]) / bend : 0.0f;
          pixels[s].push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f + shift});
        }
      }
    }
  });
  return pixels;
}

/// Counts of y - slope x in bins of 1, the first at -offset.
void project(const std::vector<LinePixel>& pixels, double slope, double offset, std::vector<float>& bins) {
  std::fill(bins.begin(), bins.end(), 0.0f);
  const auto tilt = static_cast<float>(slope), shift = static_cast<float>(offset);
  for (const LinePixel& p : pixels) {
    const auto bin = static_cast<std::size_t>(p.y - tilt * p.x + shift);
    if (bin < bins.size()) bins[bin] += 1.0f;
  }
}

/// Places where three bins together hold enough pixels, each at their centre of mass.
std::vector<double> peaksOf(const std::vector<float>& bins, double least, double offset) {
  std::vector<double> places;
  const auto around = [&](std::size_t i) { return bins[i - 1] + bins[i] + bins[i + 1]; };
  for (std::size_t i = 2; i + 2 < bins.size(); ++i) {
    const float here = around(i);
    if (here < least || here < around(i - 1) || here <= around(i + 1)) continue;
    const double shift = (bins[i + 1] - bins[i - 1]) / here;
    const double place = static_cast<double>(i) + 0.5 + shift - offset;
    if (places.empty() || place - places.back() > 2.5) places.push_back(place);
  }
  return places;
}

}  // namespace

RulingStretches findRulingStretches(const Plane& grey, const RunContext& context) {
  RulingStretches out;
  out.width = grey.width;
  out.height = grey.height;
  out.stripWidth = out.width / kStrips;
  if (std::min(grey.width, grey.height) < kLeastStretchSide) return out;
  const auto pixels = linePixels(averagedAlong(grey, context), context);
  if (context.isCancelled()) return out;
  const double offset = kSteepest * out.width + 2.0;
  const double least = kLeastOfStrip * out.stripWidth;
  const int steps = static_cast<int>(std::ceil(kSteepest * out.stripWidth / 1.5));
  std::vector<double> scores(static_cast<std::size_t>(2 * steps + 1), 0.0);
  const auto slopeOf = [&](int step) { return kSteepest * (step - steps) / steps; };
  parallelFor(context, 2 * steps + 1, 1, [&](int begin, int end) {
    std::vector<float> bins(static_cast<std::size_t>(out.height + 2.0 * offset) + 2);
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      for (const auto& strip : pixels) {
        project(strip, slopeOf(i), offset, bins);
        for (const float count : bins) {
          if (2.0f * count > static_cast<float>(least)) scores[i] += static_cast<double>(count * count);
        }
      }
    }
  });
  if (context.isCancelled()) return out;
  const auto best = static_cast<int>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  if (scores[best] <= 0.0) return out;
  out.slope = slopeOf(best);
  std::vector<float> bins(static_cast<std::size_t>(out.height + 2.0 * offset) + 2);
  for (const auto& strip : pixels) {
    project(strip, out.slope, offset, bins);
    out.strips.push_back(peaksOf(bins, least, offset));
  }
  return out;
}

}  // namespace batten
