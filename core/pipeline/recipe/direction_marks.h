// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vec2.h"

namespace batten {

/// Which way a curve is to run in what is exported, and so where it begins: at this place of the drawing it goes
/// towards another. Attached by position: it belongs to the piece nearest to it (within 24 px), whichever way that was
/// traced.
struct DirectionMark {
  Vec2 positionPx = Vec2::Zero();
  Vec2 towardsPx = Vec2::UnitX();  ///< [px] not the same place.
  bool operator==(const DirectionMark& o) const { return positionPx == o.positionPx && towardsPx == o.towardsPx; }
};

/// Where a closed line is to begin in what is exported: a smooth one at the nearest place of the curve, one with
/// corners at the nearest corner. Belongs to the closed line nearest to it (within 24 px).
struct StartMark {
  Vec2 positionPx = Vec2::Zero();
  bool operator==(const StartMark& o) const { return positionPx == o.positionPx; }
};

}  // namespace batten
