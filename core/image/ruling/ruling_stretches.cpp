// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/base/hot_loop.h"
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

BATTEN_HOT_LOOP void meansOfFive(const float* in, float* __restrict out, int count) {
  for (int i = 0; i < count; ++i) out[i] = (in[i] + in[i + 1] + in[i + 2] + in[i + 3] + in[i + 4]) / 5.0f;
}

/// Rows [first, past) of a plane averaged along x over 2 kAlong + 1 pixels. Made where they are needed: a whole plane
/// of them would be fresh memory, which costs more than the sums.
class AveragedRows {
 public:
  explicit AveragedRows(const Plane& grey) : grey_(grey), padded_(static_cast<std::size_t>(grey.width) + 2 * kAlong) {}

  void make(int first, int past) {
    static_assert(kAlong == 2);
    first_ = first;
    rows_.resize(static_cast<std::size_t>(grey_.width) * static_cast<std::size_t>(past - first));
    for (int y = first; y < past; ++y) {
      const float* in = grey_.row(y);
      std::copy_n(in, grey_.width, padded_.data() + kAlong);
      std::fill_n(padded_.data(), kAlong, in[0]);
      std::fill_n(padded_.data() + kAlong + grey_.width, kAlong, in[grey_.width - 1]);
      meansOfFive(padded_.data(), rows_.data() + std::ptrdiff_t{y - first} * grey_.width, grey_.width);
    }
  }
  const float* row(int y) const { return rows_.data() + std::ptrdiff_t{y - first_} * grey_.width; }
  int height() const { return grey_.height; }  ///< Of the plane.

 private:
  const Plane& grey_;
  int first_ = 0;
  std::vector<float> padded_, rows_;
};

double noiseAcross(const Plane& grey) {
  std::vector<float> steps;
  AveragedRows rows(grey);
  for (int y = 0; y + 1 < grey.height; y += kNoiseStride) {
    rows.make(y, y + 2);
    for (int x = y % kNoiseStride; x < grey.width; x += kNoiseStride)
      steps.push_back(rows.row(y + 1)[x] - rows.row(y)[x]);
  }
  return robustSigma(steps) / std::sqrt(2.0);
}

/// A row and those around it that it is compared with.
struct RowsAround {
  const float *above, *here, *below;
  std::array<const float*, kSides.size()> up, down;
};

/// Strip s holds columns from floor(s * width / kStrips) on.
int stripOf(int x, int width) {
  int strip = std::min(x * kStrips / width, kStrips - 1);
  while (strip + 1 < kStrips && (strip + 1) * width / kStrips <= x) ++strip;
  return strip;
}

/// Marks pixels that are the darkest of a column of three and darker by `least` than the paper on both sides. `up` and
/// `down` of a side that lies beyond the page are the row itself: it is not darker than that.
BATTEN_HOT_LOOP void markThinDark(const RowsAround& rows, float least, std::uint8_t* __restrict marks, int count) {
  const float *above = rows.above, *here = rows.here, *below = rows.below;
  const float *up0 = rows.up[0], *down0 = rows.down[0], *up1 = rows.up[1], *down1 = rows.down[1];
  for (int x = 0; x < count; ++x) {
    const float near = (down0[x] < up0[x] ? down0[x] : up0[x]) - here[x];
    const float far = (down1[x] < up1[x] ? down1[x] : up1[x]) - here[x];
    const float depth = near > far ? near : far;
    marks[x] = (here[x] <= above[x]) & (here[x] < below[x]) & (depth >= least);
  }
}

RowsAround rowsAround(const AveragedRows& averaged, int y) {
  RowsAround rows{averaged.row(y - 1), averaged.row(y), averaged.row(y + 1), {}, {}};
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const bool isOnPage = y >= kSides[i] && y + kSides[i] < averaged.height();
    rows.up[i] = isOnPage ? averaged.row(y - kSides[i]) : rows.here;
    rows.down[i] = isOnPage ? averaged.row(y + kSides[i]) : rows.here;
  }
  return rows;
}

/// Pixels in the middle of thin dark lines, strip by strip.
std::array<std::vector<LinePixel>, kStrips> linePixels(const Plane& grey, const RunContext& context) {
  static_assert(kSides.size() == 2);
  constexpr int kFarSide = kSides.back();
  std::array<std::vector<LinePixel>, kStrips> pixels;
  const float least = std::max(kLeastDepth, static_cast<float>(kDepthPerNoise * noiseAcross(grey)));
  const int blocks = (grey.height + kRowsPerBlock - 1) / kRowsPerBlock;
  std::vector<std::array<std::vector<LinePixel>, kStrips>> parts(blocks);
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<std::uint8_t> marks((static_cast<std::size_t>(grey.width) + 7) / 8 * 8, 0);
    AveragedRows averaged(grey);
    averaged.make(std::max(0, begin - kFarSide), std::min(grey.height, end + kFarSide));
    for (int y = std::max(1, begin); y < std::min(end, grey.height - 1); ++y) {
      const RowsAround rows = rowsAround(averaged, y);
      markThinDark(rows, least, marks.data(), grey.width);
      for (int x = 0; x < grey.width; ++x) {
        if (std::uint64_t eight = 0; x % 8 == 0) {
          std::memcpy(&eight, marks.data() + x, 8);
          if (eight == 0) {
            x += 7;
            continue;
          }
        }
        if (marks[x] == 0) continue;
        const float bend = rows.above[x] - 2.0f * rows.here[x] + rows.below[x];
        const float shift = bend > 0.0f ? 0.5f * (rows.above[x] - rows.below[x]) / bend : 0.0f;
        parts[begin / kRowsPerBlock][stripOf(x, grey.width)].push_back(
            {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f + shift});
      }
    }
  });
  for (const auto& part : parts) {
    for (std::size_t s = 0; s < kStrips; ++s) pixels[s].insert(pixels[s].end(), part[s].begin(), part[s].end());
  }
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
  const auto pixels = linePixels(grey, context);
  if (context.isCancelled()) return out;
  const double offset = kSteepest * out.width + 2.0;
  const double least = kLeastOfStrip * out.stripWidth;
  const int steps = static_cast<int>(std::ceil(kSteepest * out.stripWidth / 1.5));
  std::vector<double> scores(2 * steps + 1, 0.0);
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
