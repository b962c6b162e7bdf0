// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/ink_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/bits/packed_flags.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/threshold/binned_median.h"
#include "core/image/threshold/region_surface.h"
#include "core/image/threshold/region_thresholds.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

constexpr int kSampleStep = 3;        // the smoothed picture has no more to say than every third pixel
constexpr float kWeak = 3.0f;         // times the noise: an edge beside a certain one
constexpr float kCertain = 6.0f;      // times the noise
constexpr float kFloorShare = 0.06f;  // of the strong edges, where the paper has no noise to measure edges by
constexpr int kStrengthBins = 2048;   // 256 grey levels
constexpr float kBinsPerGrey = 8.0f;  // of the strengths of edges
// Of the certain edges 49 in 50 are weaker than the strong ones: 98 %, in whole numbers so that rounding has no say.
constexpr std::int64_t kWeakerEdges = 49, kOfEdges = 50;
/// [grey/px] Across a region light changes by no more than this, nor by more noises and a little: what is steeper was
/// drawn all over it.
constexpr double kLeastSlopeLimit = 0.5, kSlopeNoises = 3.0, kSlopeMore = 0.02;
constexpr double kLeastNoise = 0.15;                       // [grey/px] what rounding leaves where the scan has none
constexpr double kLowestNoise = 0.5, kHighestNoise = 1.5;  // of the median: a region full of ink tells no noise
constexpr float kTan22 = 0.4142f, kTan67 = 2.4142f;        // half way from one of four directions to the next

struct RegionNoise {
  RegionValues slopeX{}, slopeY{}, spread{};
};

float spreadAround(std::vector<float>& values, float centre) {
  for (float& value : values) value = std::fabs(value - centre);
  return static_cast<float>(kSigmaPerMad) * binnedMedian(values);
}

RegionNoise measureNoise(const Plane& u, const RunContext& context) {
  RegionNoise noise;
  parallelFor(context, kRegions, 1, [&](int region, int) {
    const RegionBounds b = regionBounds(u.width, u.height, region);
    std::vector<float> gx, gy;
    for (int y = std::max(b.y0, 1); y < std::min(b.y1, u.height - 1); y += kSampleStep) {
      for (int x = std::max(b.x0, 1); x < std::min(b.x1, u.width - 1); x += kSampleStep) {
        gx.push_back(0.5f * (u.row(y)[x + 1] - u.row(y)[x - 1]));
        gy.push_back(0.5f * (u.row(y + 1)[x] - u.row(y - 1)[x]));
      }
    }
    if (gx.empty()) return;
    const float mx = binnedMedian(gx), my = binnedMedian(gy);
    noise.slopeX[region] = mx;
    noise.slopeY[region] = my;
    noise.spread[region] = 0.5 * (spreadAround(gx, mx) + spreadAround(gy, my));
  });
  const double median = upperMedian(RegionValues(noise.spread));
  const double slopeLimit = std::max(kLeastSlopeLimit, kSlopeNoises * median + kSlopeMore);
  for (std::size_t r = 0; r < kRegions; ++r) {
    noise.spread[r] = std::max(kLeastNoise, std::clamp(noise.spread[r], kLowestNoise * median, kHighestNoise * median));
    noise.slopeX[r] = std::clamp(noise.slopeX[r], -slopeLimit, slopeLimit);
    noise.slopeY[r] = std::clamp(noise.slopeY[r], -slopeLimit, slopeLimit);
  }
  return noise;
}

/// A row with its neighbours, and the slopes of the paper there.
struct GradientRows {
  const float *up, *here, *down, *slopeX, *slopeY;
};

BATTEN_HOT_LOOP void gradientRow(const GradientRows& rows, float* __restrict out, int begin, int end) {
  const float *up = rows.up, *here = rows.here, *down = rows.down, *mx = rows.slopeX, *my = rows.slopeY;
  for (int i = begin; i < end; ++i) {
    const float gx = 0.5f * (here[i + 1] - here[i - 1]) - mx[i];
    const float gy = 0.5f * (down[i] - up[i]) - my[i];
    out[i] = gx * gx + gy * gy;
  }
}

BATTEN_HOT_LOOP void flagAbove(const float* squares, const float* spread, float floor, float factor,
                               std::uint8_t* __restrict flags, int count) {
  for (int i = 0; i < count; ++i) {
    const float limit = factor * (spread[i] > floor ? spread[i] : floor);
    flags[i] = squares[i] > limit * limit ? 1 : 0;
  }
}

/// Squared lengths of the gradients beyond the regions' own slope, row by row where they are needed: a plane of them
/// would be fresh memory, which costs more than making them again.
class GradientSquares {
 public:
  GradientSquares(const Plane& u, const RegionNoise& noise)
      : u_(u),
        slopeX_(noise.slopeX, u.width, u.height, true),
        slopeY_(noise.slopeY, u.width, u.height, true),
        mx_(u.width),
        my_(u.width) {}

  /// Those of row y. The outermost rows and columns are flat.
  void fillRow(int y, float* row) {
    if (y == 0 || y == u_.height - 1) {
      std::fill_n(row, u_.width, 0.0f);
      return;
    }
    slopeX_.fillRow(y, mx_.data());
    slopeY_.fillRow(y, my_.data());
    gradientRow({u_.row(y - 1), u_.row(y), u_.row(y + 1), mx_.data(), my_.data()}, row, 1, u_.width - 1);
    row[0] = row[u_.width - 1] = 0.0f;
  }

 private:
  const Plane& u_;
  RegionSurface slopeX_, slopeY_;
  std::vector<float> mx_, my_;
};

using StrengthCounts = std::array<int, kStrengthBins>;

float strongOf(const std::vector<StrengthCounts>& counts) {
  std::int64_t total = 0, seen = 0;
  for (const auto& block : counts) {
    for (const int n : block) total += n;
  }
  for (std::size_t bin = 0; bin < kStrengthBins && total > 0; ++bin) {
    for (const auto& block : counts) seen += block[bin];
    if (seen * kOfEdges >= total * kWeakerEdges) return (static_cast<float>(bin) + 0.5f) / kBinsPerGrey;
  }
  return 0.0f;
}

/// 98 % of the certain gradients are smaller than this; 0 without any.
float strongGradient(const Plane& u, const RegionNoise& noise, const RegionSurface& spread, const RunContext& context) {
  std::vector<StrengthCounts> counts((u.height + kRowsPerBlock - 1) / kRowsPerBlock);
  parallelFor(context, u.height, kRowsPerBlock, [&](int begin, int end) {
    StrengthCounts& mine = counts[begin / kRowsPerBlock];
    mine.fill(0);
    GradientSquares squares(u, noise);
    std::vector<float> row(u.width), s(u.width);
    std::vector<std::uint8_t> flags(u.width);
    BitImage certain(u.width, 1);
    for (int y = begin; y < end; ++y) {
      squares.fillRow(y, row.data());
      spread.fillRow(y, s.data());
      flagAbove(row.data(), s.data(), 0.0f, kCertain, flags.data(), u.width);
      packFlags(flags.data(), u.width, certain.row(0));
      for (int i = 0; i < certain.wordsPerRow; ++i) {
        for (std::uint64_t bits = certain.row(0)[i]; bits != 0; bits &= bits - 1) {
          const int bin = static_cast<int>(std::sqrt(row[i * 64 + std::countr_zero(bits)]) * kBinsPerGrey);
          ++mine[std::min(bin, kStrengthBins - 1)];
        }
      }
    }
  });
  return strongOf(counts);
}

/// Three rows of squares, one below the other.
struct ThreeRows {
  const float *above, *here, *below;
  /// That of row 0, -1 or 1 from the middle one.
  const float* at(int dy) const { return dy == 0 ? here : dy < 0 ? above : below; }
};

/// Whether the gradient at (x, y) is at least as long as at both neighbours along its direction (4 directions).
bool isCrest(const Plane& u, const ThreeRows& squares, int x, int y) {
  const float gx = u.row(y)[x + 1] - u.row(y)[x - 1], gy = u.row(y + 1)[x] - u.row(y - 1)[x];
  const float ax = std::fabs(gx), ay = std::fabs(gy);
  int dx = 1, dy = 0;
  if (ay > kTan67 * ax) {
    dx = 0;
    dy = 1;
  } else if (ay > kTan22 * ax) {
    dy = (gx > 0) == (gy > 0) ? 1 : -1;
  }
  const float here = squares.here[x];
  return here >= squares.at(dy)[x + dx] && here > squares.at(-dy)[x - dx];
}

std::vector<EdgePoint> findCrests(const Plane& u, const RegionNoise& noise, const BitImage& area,
                                  const RunContext& context) {
  const int blocks = (u.height + kRowsPerBlock - 1) / kRowsPerBlock;
  std::vector<std::vector<EdgePoint>> parts(blocks);
  parallelFor(context, u.height, kRowsPerBlock, [&](int begin, int end) {
    auto& part = parts[begin / kRowsPerBlock];
    GradientSquares squares(u, noise);
    std::vector<float> made(std::ptrdiff_t{3} * u.width);
    const auto rowOf = [&](int y) { return made.data() + std::ptrdiff_t{y % 3} * u.width; };
    int past = 0;  // of the rows that are made
    for (int y = std::max(begin, 1); y < std::min(end, u.height - 1); ++y) {
      if (std::all_of(area.row(y), area.row(y) + area.wordsPerRow, [](std::uint64_t word) { return word == 0; }))
        continue;
      for (past = std::max(past, y - 1); past <= y + 1; ++past) squares.fillRow(past, rowOf(past));
      const ThreeRows around{rowOf(y - 1), rowOf(y), rowOf(y + 1)};
      for (int i = 0; i < area.wordsPerRow; ++i) {
        for (std::uint64_t bits = area.row(y)[i]; bits != 0; bits &= bits - 1) {
          const int x = i * 64 + std::countr_zero(bits);
          if (x < 1 || x >= u.width - 1 || !isCrest(u, around, x, y)) continue;
          part.push_back({x, y, std::sqrt(around.here[x])});
        }
      }
    }
  });
  std::vector<EdgePoint> crests;
  for (const auto& part : parts) crests.insert(crests.end(), part.begin(), part.end());
  return crests;
}

}  // namespace

InkEdges findInkEdges(const Plane& u, const RunContext& context) {
  InkEdges edges;
  edges.area = BitImage(u.width, u.height);
  if (u.width < 3 || u.height < 3) return edges;
  const RegionNoise noise = measureNoise(u, context);
  const RegionSurface spread(noise.spread, u.width, u.height, true);
  const float strong = strongGradient(u, noise, spread, context);
  if (context.isCancelled()) return edges;
  // On white-balanced scans the paper is clipped and has no noise: then the drawing's own edges set the scale.
  const float floor = kFloorShare * strong / kCertain;
  BitImage weak(u.width, u.height), certain(u.width, u.height);
  parallelFor(context, u.height, kRowsPerBlock, [&](int begin, int end) {
    GradientSquares squares(u, noise);
    std::vector<float> row(u.width), s(u.width);
    std::vector<std::uint8_t> flags(s.size());
    for (int y = begin; y < end; ++y) {
      squares.fillRow(y, row.data());
      spread.fillRow(y, s.data());
      flagAbove(row.data(), s.data(), floor, kWeak, flags.data(), u.width);
      packFlags(flags.data(), u.width, weak.row(y));
      flagAbove(row.data(), s.data(), floor, kCertain, flags.data(), u.width);
      packFlags(flags.data(), u.width, certain.row(y));
    }
  });
  edges.area = keepPieces(weak, {.minArea = 0, .minDiagonal = 0.0, .seeds = &certain}, context);
  edges.crests = findCrests(u, noise, edges.area, context);
  return edges;
}

}  // namespace batten
