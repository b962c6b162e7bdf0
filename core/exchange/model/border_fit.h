// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/exchange/model/cubic_path.h"

namespace batten {

/// A place on the border of a stroke.
struct BorderPlace {
  Vec2 at = Vec2::Zero();
  Vec2 along = Vec2::UnitX();  ///< Unit direction.
  bool begins = false;         ///< The direction may jump here: cubics meet.
  std::ptrdiff_t middle = 0;   ///< Index of the place of the middle that it lies beside.
  bool isBackwards = false;    ///< It runs against the middle of its stroke: inside a turn tighter than half the width.
};

/// Cubics along the places, no farther from any of them than the tolerance, with their directions wherever two meet.
CubicRun fittedBorder(const std::vector<BorderPlace>&, double tolerance, CancelCheck check = {});

}  // namespace batten
