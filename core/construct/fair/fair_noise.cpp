// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace batten {
namespace {

constexpr double kNoiseAlongPx = 80.0;  // Gaussian: as much as 280 px of equal weight
constexpr double kNoiseSurprise = 6.0;  // times the local mean; beyond, no noise
constexpr double kAdjacent = 1.6;       // block lengths between the means of neighbours
constexpr double kBlockFreedom = 0.51;  // of a block: second differences of neighbours are correlated
constexpr double kPriorWindows = 2.0;   // of equal noise
constexpr double kMostFactor = 36.0;

/// Gaussian means of values at the places of the trace; `weight` gets the blocks that each is as good as.
std::vector<double> localMeans(const NoiseTrace& trace, const std::vector<double>& values,
                               std::vector<double>* blocks) {
  const auto n = values.size();
  std::vector<double> means(n);
  if (blocks) blocks->resize(n);
  const double reach = std::min(3.0 * kNoiseAlongPx, trace.closed ? 0.5 * trace.length : trace.length);
  const int steps = static_cast<int>(reach / trace.blockLength);
  std::vector<double> kernel;
  for (int k = 0; k <= steps; ++k) {
    const double x = k * trace.blockLength / kNoiseAlongPx;
    kernel.push_back(std::exp(-0.5 * x * x));
  }
  const auto count = static_cast<int>(n);
  for (int i = 0; i < count; ++i) {
    double sum = 0.0, weight = 0.0, square = 0.0;
    for (int k = -steps; k <= steps; ++k) {  // by order: gaps between blocks are rare and short
      int j = i + k;
      if (trace.closed) j = ((j % count) + count) % count;
      if (j < 0 || j >= count) continue;
      const double w = kernel[std::abs(k)];
      sum += w * values[j];
      weight += w;
      square += w * w;
    }
    means[i] = sum / weight;
    if (blocks) (*blocks)[i] = weight * weight / square;
  }
  return means;
}

double pooledMean(const std::vector<NoiseTrace>& traces, const std::vector<std::vector<double>>& squares,
                  const std::vector<LocalNoise>* by) {
  double sum = 0.0, count = 0.0;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    for (std::size_t i = 0; i < squares[t].size(); ++i) {
      sum += squares[t][i] / (by ? (*by)[t].factor[i] : 1.0);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

NoiseTrace noiseTrace(const FairFrame& frame, const Eigen::VectorXd& c, double s0) {
  NoiseTrace trace;
  trace.closed = frame.base.knots().closed;
  trace.length = frame.base.knots().length;
  trace.blockLength = frame.blockLength;
  const auto n = frame.blocks.size();
  std::vector<double> z;
  const double sigma = std::sqrt(s0 / frame.blockLength);
  for (const FairBlock& block : frame.blocks) {
    z.push_back((block.offset - dot(block.row, c)) * std::sqrt(block.weight) / sigma);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = frame.blocks[i].u - frame.blocks[i - 1].u, after = frame.blocks[i + 1].u - frame.blocks[i].u;
    if (std::max(before, after) > kAdjacent * frame.blockLength) continue;
    const double d = z[i - 1] - 2.0 * z[i] + z[i + 1];
    trace.u.push_back(frame.blocks[i].u);
    trace.square.push_back(d * d / 6.0);
  }
  return trace;
}

double LocalNoise::at(double place) const {
  if (u.empty()) return 1.0;
  const auto next = std::upper_bound(u.begin(), u.end(), place);
  if (next == u.begin()) return factor.front();
  if (next == u.end()) return factor.back();
  const auto i = static_cast<std::size_t>(next - u.begin());
  return std::lerp(factor[i - 1], factor[i], (place - u[i - 1]) / (u[i] - u[i - 1]));
}

std::vector<LocalNoise> localNoise(const std::vector<NoiseTrace>& traces) {
  std::vector<LocalNoise> noise(traces.size());
  std::vector<std::vector<double>> squares(traces.size()), means(traces.size()), blocks(traces.size());
  for (std::size_t t = 0; t < traces.size(); ++t) {
    squares[t] = traces[t].square;
    if (squares[t].empty()) continue;
    for (int pass = 0; pass < 2; ++pass) {
      means[t] = localMeans(traces[t], squares[t], &blocks[t]);
      if (pass == 1) break;
      for (std::size_t i = 0; i < squares[t].size(); ++i) {
        squares[t][i] = std::min(squares[t][i], kNoiseSurprise * means[t][i]);
      }
    }
  }
  const double usual = pooledMean(traces, squares, nullptr);
  if (!(usual > 0.0)) return noise;
  // How much more the logarithms of the local means vary than those of equal noise would (variance 2 / freedom).
  double excess = 0.0, windows = 0.0;
  for (std::size_t t = 0; t < traces.size(); ++t) {
    for (std::size_t i = 0; i < means[t].size(); ++i) {
      const double x = std::log(std::max(means[t][i], 1e-6 * usual) / usual), share = 1.0 / blocks[t][i];
      excess += share * (x * x - 2.0 / (kBlockFreedom * blocks[t][i]));
      windows += share;
    }
  }
  const double between = std::max(0.0, excess / (windows + kPriorWindows));
  for (std::size_t t = 0; t < traces.size(); ++t) {
    noise[t].u = traces[t].u;
    for (std::size_t i = 0; i < means[t].size(); ++i) {
      const double x = std::log(std::max(means[t][i], 1e-6 * usual) / usual);
      const double share = between / (between + 2.0 / (kBlockFreedom * blocks[t][i]));
      noise[t].factor.push_back(std::clamp(std::exp(share * x), 1.0 / kMostFactor, kMostFactor));
    }
  }
  const double scale = pooledMean(traces, squares, &noise) / usual;
  for (LocalNoise& n : noise) {
    for (double& f : n.factor) f *= scale;
  }
  return noise;
}

}  // namespace batten
