// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/colour/inks.h"
#include "core/image/colour/paper_colour.h"

namespace batten {

/// Tells which ink lies at a place of a colour scan. Measures the paper once; the pictures must outlive it.
class InkPicker {
 public:
  InkPicker(const GreyImage& grey, const ColourImage& colour, const RunContext&);
  /// The ink nearest to a place within reach, by the mean colour of 3 x 3 px as inks are dropped by; absent: there is
  /// paper alone, or the scan has no colours.
  std::optional<FoundInk> inkAt(const Vec2& px, double reachPx) const;

 private:
  const ColourImage& colour_;
  PaperColour paper_;
};

}  // namespace batten
