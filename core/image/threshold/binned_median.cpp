// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/binned_median.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr int kBins = 1024;                                        // technical: of the table of counts
constexpr float kHalfOfBins = 0.5f * kBins, kBinsPerUnit = 64.0f;  // values beyond the range count in the last bin

/// Greater values lie in the same bin or in a later one.
int binOf(float value) {
  return static_cast<int>(std::clamp(value * kBinsPerUnit, -kHalfOfBins, kHalfOfBins - 1.0f) + kHalfOfBins);
}

}  // namespace

float binnedMedian(const std::vector<float>& values) {
  std::array<int, kBins> counts{};
  for (const float value : values) ++counts[binOf(value)];
  std::ptrdiff_t rank = std::ssize(values) / 2;
  int bin = 0;
  while (rank >= counts[bin]) rank -= counts[bin++];
  std::vector<float> within;
  std::copy_if(values.begin(), values.end(), std::back_inserter(within), [&](float v) { return binOf(v) == bin; });
  return elementOfRank(within, rank);
}

}  // namespace batten
