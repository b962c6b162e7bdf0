// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// A place of a curvature profile that the user has drawn.
struct ProfilePoint {
  double fraction = 0.0;  ///< 0..1. Share of the arc length.
  double kappa = 0.0;     ///< [1/mm] signed curvature there.
  bool operator==(const ProfilePoint&) const = default;
};

inline constexpr std::size_t kMostProfilePoints = 200;  // limit of input

/// What makes a list no profile: fewer than two or too many points, fractions outside 0..1 or not ascending, numbers
/// that are not finite. An empty list is valid: nothing is drawn.
std::optional<Error> validateProfile(std::span<const ProfilePoint>);

/// The smooth curve through the points that turns back only where they do: cubics whose slopes are bounded as by F. N.
/// Fritsch and J. Butland (A method for constructing local monotone piecewise cubic interpolants, SIAM J. Sci. Stat.
/// Comput. 5, 1984). Constant before the first and after the last point.
/// @param closed the value at 1 is that at 0 (their mean where both are given), and the slope goes on over the seam.
TargetProfile drawnProfile(std::span<const ProfilePoint>, bool closed);

}  // namespace batten
