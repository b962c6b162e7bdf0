// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace batten {
namespace {

constexpr double kNoiseAlongPx = 80.0;  // Gaussian: as much as 280 px of equal weight
constexpr double kNoiseSurprise = 6.0;  // times the local mean; beyond, no noise
constexpr double kAdjacent = 1.6;       // block lengths between the means of neighbours
constexpr double kBlockFreedom = 0.51;  // of a block: second differences of neighbours are correlated
constexpr double kNoiseReach = 3.0;     // standard deviations of the mean along a line: beyond, weights are below 1 %
constexpr double kPriorWindows = 2.0;   // of equal noise
constexpr double kMostFactor = 36.0;    // of the usual variance, and its inverse: 6 times the standard deviation
constexpr double kLeastMean = 1e-6;     // of what is usual: blocks without any noise have a logarithm too

/// A block of a trace on its way to local noise.
struct NoiseBlock {
  double square = 0.0;  ///< Of the trace, outliers held back.
  double mean = 0.0;    ///< Gaussian mean of the squares about it …
  double blocks = 0.0;  ///< … and how many blocks it is as good as.
};

/// Sets the local means: Gaussian, at open ends over what there is. No smoothing of core/polyline also says of how many
/// blocks a mean is.
void averageLocally(const NoiseTrace& trace, std::vector<NoiseBlock>& values) {
  const double reach = std::min(kNoiseReach * kNoiseAlongPx, trace.closed ? 0.5 * trace.length : trace.length);
  const int steps = static_cast<int>(reach / trace.blockLength);
  std::vector<double> kernel;
  for (int k = 0; k <= steps; ++k) {
    const double x = k * trace.blockLength / kNoiseAlongPx;
    kernel.push_back(std::exp(-0.5 * x * x));
  }
  const int count = static_cast<int>(values.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0.0, weight = 0.0, square = 0.0;
    for (int k = -steps; k <= steps; ++k) {  // by order: gaps between blocks are rare and short
      int j = i + k;
      if (trace.closed) j = ((j % count) + count) % count;
      if (j < 0 || j >= count) continue;
      const double w = kernel[std::abs(k)];
      sum += w * values[j].square;
      weight += w;
      square += w * w;
    }
    values[i].mean = sum / weight;
    values[i].blocks = weight * weight / square;
  }
}

/// Of the squares, each over the factor of its place where factors are given.
double pooledMean(const std::vector<std::vector<NoiseBlock>>& traces, std::span<const LocalNoise> by = {}) {
  double sum = 0.0, count = 0.0;
  for (int t = 0; t < std::ssize(traces); ++t) {
    for (int i = 0; i < std::ssize(traces[t]); ++i) {
      sum += traces[t][i].square / (by.empty() ? 1.0 : by[t].places[i].factor);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// The squares of a trace and their local means.
std::vector<NoiseBlock> noiseBlocks(const NoiseTrace& trace) {
  std::vector<NoiseBlock> blocks;
  for (const NoiseTrace::Block& block : trace.blocks) blocks.push_back({block.square});
  averageLocally(trace, blocks);
  for (NoiseBlock& block : blocks) block.square = std::min(block.square, kNoiseSurprise * block.mean);
  averageLocally(trace, blocks);
  return blocks;
}

/// Logarithm of a local mean over what is usual.
double logExcess(const NoiseBlock& block, double usual) {
  return std::log(std::max(block.mean, kLeastMean * usual) / usual);
}

}  // namespace

NoiseTrace noiseTrace(const FairFrame& frame, const Eigen::VectorXd& c, double s0) {
  NoiseTrace trace;
  trace.closed = frame.base.knots().closed;
  trace.length = frame.base.knots().length;
  trace.blockLength = frame.blockLength;
  const int n = static_cast<int>(frame.blocks.size());
  std::vector<double> z;
  const double sigma = std::sqrt(s0 / frame.blockLength);
  for (const FairBlock& block : frame.blocks) {
    z.push_back((block.offset - dot(block.row, c)) * std::sqrt(block.weight) / sigma);
  }
  for (int i = 1; i + 1 < n; ++i) {
    const double before = frame.blocks[i].u - frame.blocks[i - 1].u, after = frame.blocks[i + 1].u - frame.blocks[i].u;
    if (std::max(before, after) > kAdjacent * frame.blockLength) continue;
    const double d = z[i - 1] - 2.0 * z[i] + z[i + 1];
    trace.blocks.push_back({frame.blocks[i].u, d * d / 6.0});
  }
  return trace;
}

double LocalNoise::at(double place) const {
  if (places.empty()) return 1.0;
  const auto next = std::ranges::upper_bound(places, place, {}, &Place::u);
  if (next == places.begin()) return places.front().factor;
  if (next == places.end()) return places.back().factor;
  const Place& last = *(next - 1);
  return std::lerp(last.factor, next->factor, (place - last.u) / (next->u - last.u));
}

std::vector<LocalNoise> localNoise(const std::vector<NoiseTrace>& traces) {
  std::vector<LocalNoise> noise(traces.size());
  std::vector<std::vector<NoiseBlock>> blocks;
  blocks.reserve(traces.size());
  for (const NoiseTrace& trace : traces) blocks.push_back(noiseBlocks(trace));
  const double usual = pooledMean(blocks);
  if (!(usual > 0.0)) return noise;
  // How much more the logarithms of the local means vary than those of equal noise would (variance 2 / freedom).
  double excess = 0.0, windows = 0.0;
  for (const auto& trace : blocks) {
    for (const NoiseBlock& block : trace) {
      const double x = logExcess(block, usual), share = 1.0 / block.blocks;
      excess += share * (x * x - 2.0 / (kBlockFreedom * block.blocks));
      windows += share;
    }
  }
  const double between = std::max(0.0, excess / (windows + kPriorWindows));
  for (int t = 0; t < std::ssize(traces); ++t) {
    for (int i = 0; i < std::ssize(blocks[t]); ++i) {
      const double share = between / (between + 2.0 / (kBlockFreedom * blocks[t][i].blocks));
      const double factor =
          std::clamp(std::exp(share * logExcess(blocks[t][i], usual)), 1.0 / kMostFactor, kMostFactor);
      noise[t].places.push_back({traces[t].blocks[i].u, factor});
    }
  }
  const double scale = pooledMean(blocks, noise) / usual;
  for (LocalNoise& n : noise) {
    for (LocalNoise::Place& place : n.places) place.factor *= scale;
  }
  return noise;
}

}  // namespace batten
