// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/fairing/profile/drawn_profile.h"

namespace batten {

/// The curvature of a curve without its size: points at equal shares of its length with curvature times length, as a
/// profile that other curves can be made like. Empty for a curve without length.
std::vector<ProfilePoint> shapeOf(const NurbsCurve&);

/// Such a shape as a drawn profile for a curve: curvature over its length, laid so that it is most like the curve's own
/// (reversed, mirrored; on closed curves begun elsewhere; compareShapes). Empty where one of the two has no length.
std::vector<ProfilePoint> profileLike(std::span<const ProfilePoint> shape, const NurbsCurve&, bool closed);

}  // namespace batten
