// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/fairing/profile/radius_target.h"

namespace batten {

/// A profile of several polynomials of one degree, one from split to split, that meet in the mean of what both sides
/// want there; monotone ones are so within each part. Parts with too few samples take a lower degree.
/// @param perimeter,kappa samples over 0..1, both ends included. @param splits ascending inside 0..1, at least one.
/// @param closed the last part goes on over the seam to the first split.
/// @param coefficientCount receives the number of free coefficients.
std::vector<ProfileNode> fitSplitProfile(std::span<const double> perimeter, std::span<const double> kappa,
                                         std::span<const double> splits, int degree, bool monotone, bool closed,
                                         int& coefficientCount);

}  // namespace batten
