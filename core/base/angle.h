// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace batten {

/// Angles are in radians; degrees stand in parameters, files and on screen only.
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;  // its inverse

}  // namespace batten
