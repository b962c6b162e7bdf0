// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/conventions.h"

namespace batten {

/// Edge pixels that an estimate needs at least.
inline constexpr int kMinVotes = 15;

/// The half level of every region: the mean depth at the crests of its edges, weighted by their strength.
class RegionHalfLevels {
 public:
  /// @param weighted [grey * weight] the depth of a crest times its weight.
  void add(int region, double weighted, double weight);
  /// Whether it has crests enough.
  bool isMeasured(int region) const { return votes_[region] >= kMinVotes && weight_[region] > 0.0; }
  /// [grey] Of all regions; those that are not measured are filled from those around, 0 where none is.
  std::vector<float> filled() const;

 private:
  std::array<double, kRegions> sum_{}, weight_{};
  std::array<int, kRegions> votes_{};
};

}  // namespace batten
