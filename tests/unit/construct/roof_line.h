// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "core/base/vec2.h"

namespace batten::test {

/// Two bumps, as of a bonnet and a roof, with inflections between them.
inline Vec2 roofLine(double x) {
  return {x, 60 * std::exp(-std::pow((x - 300) / 120, 2)) + 40 * std::exp(-std::pow((x - 650) / 90, 2))};
}

}  // namespace batten::test
