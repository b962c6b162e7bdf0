// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/image/ruling/rulings.h"

namespace batten {

/// How many ruled lines run down the page, or across it; the margin of ruled paper is a family of its own.
inline int ruledLines(std::span<const RulingFamily> families, bool runsDown) {
  int count = 0;
  for (const RulingFamily& family : families)
    if (family.runsDown == runsDown) count += static_cast<int>(std::ssize(family.lines));
  return count;
}

}  // namespace batten
