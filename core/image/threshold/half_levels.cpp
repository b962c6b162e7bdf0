// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/half_levels.h"

#include "core/image/push_pull.h"

namespace batten {
namespace {

constexpr float kVotesOfConfidence = 60.0f;  // make a region half certain

}  // namespace

void RegionHalfLevels::add(int region, double weighted, double weight) {
  sum_[region] += weighted;
  weight_[region] += weight;
  ++votes_[region];
}

std::vector<float> RegionHalfLevels::filled() const {
  std::vector<float> value(kRegions, 0.0f), confidence(kRegions, 0.0f);
  for (int r = 0; r < kRegions; ++r) {
    if (!isMeasured(r)) continue;
    value[r] = static_cast<float>(sum_[r] / weight_[r]);
    confidence[r] = static_cast<float>(votes_[r]) / (static_cast<float>(votes_[r]) + kVotesOfConfidence);
  }
  return pushPull(value, confidence, kRegionsPerSide, kRegionsPerSide);
}

}  // namespace batten
