// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace batten {

/// The highest degree of a target polynomial: there is one target for every degree from 1 to this one.
inline constexpr int kMostTargetDegree = 6;

/// Whether a target can be a polynomial of this degree.
constexpr bool isTargetDegree(int degree) { return degree >= 1 && degree <= kMostTargetDegree; }

/// One entry for each target; that of a degree has the index degree - 1.
template <class T>
using PerTarget = std::array<T, kMostTargetDegree>;

}  // namespace batten
