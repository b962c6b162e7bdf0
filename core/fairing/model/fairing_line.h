// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// What is known of a line beside the curve that was made of it.
struct FairingLine {
  std::vector<Vec2>
      points;  ///< [mm] Measured, in order along the curve, without those that a corner falsifies. Empty: unknown.
  double pixelMm = 0.0;  ///< [mm] Size of a scan pixel.
};

}  // namespace batten
