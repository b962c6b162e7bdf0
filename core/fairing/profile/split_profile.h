// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/fairing/profile/target_profiles.h"

namespace batten {

struct SplitProfile {
  std::vector<ProfileNode> nodes;
  int coefficients = 0;  ///< Free ones.
};

/// A profile of several polynomials of one degree, one from split to split, that meet in the mean of what both sides
/// want there; monotone ones are so within each part. Parts with too few samples take a lower degree.
/// @param perimeter,kappa samples over 0..1, both ends included. @param splits ascending inside 0..1, at least one.
/// @param closed the last part goes on over the seam to the first split.
/// @return no nodes where a part cannot be fitted.
SplitProfile fitSplitProfile(std::span<const double> perimeter, std::span<const double> kappa,
                             std::span<const double> splits, int degree, bool monotone, bool closed);

/// The nodes of a profile whose last part goes on over the seam (f > 1), ascending from 0 to 1, with this node at it.
std::vector<ProfileNode> cutAtSeam(const std::vector<ProfileNode>& nodes, double value, double slope);

}  // namespace batten
