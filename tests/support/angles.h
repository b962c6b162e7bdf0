// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace batten::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDeg = kPi / 180.0;  ///< [rad] One degree.

}  // namespace batten::test
