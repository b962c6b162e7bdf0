// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/strips.h"

#include "core/polyline/polyline_tools.h"

namespace batten {

void setTangents(Strip& strip) {
  constexpr int kTangentReach = 2;
  strip.tangent = directions(strip.at, strip.closed, kTangentReach);
}

}  // namespace batten
