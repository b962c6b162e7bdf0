// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/fairing/profile/drawn_profile.h"

namespace batten {

/// Points whose drawn profile (drawnProfile) is a target, so that a curve which follows the target stays where it is
/// when one begins to draw. They lie at the ends, at the splits and where the target turns back; between them at most
/// 25 more, each where the profile is off most, until its curvature is within 1 % of the target's largest and the curve
/// would move by no more than `moveMm`.
/// @param splits shares of the arc length inside 0..1 at which the target's spans meet, in any order.
/// @param lengthMm [mm] of the curve, > 0. @param moveMm [mm] > 0.
/// @return empty where the target is not valid.
std::vector<ProfilePoint> pointsAlong(const TargetProfile& target, std::span<const double> splits, bool closed,
                                      double lengthMm, double moveMm);

}  // namespace batten
