// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/plane.h"

namespace batten {

/// A small round dark mark, measured at half of its depth.
struct DotMark {
  Vec2 at{0.0, 0.0};  ///< [px] Middle, with 0.5 in the middle of the first pixel.
  double width = 0.0, height = 0.0, area = 0.0;
  double depth = 0.0;    ///< 0..1 of the paper's light that it takes, at its darkest.
  bool isAlone = false;  ///< Nothing as dark within about its own size around.
};

/// The small marks of a page and what else is narrow and dark on it.
struct DotMarks {
  int width = 0, height = 0;
  std::vector<DotMark> marks;
  std::vector<std::uint8_t> paper;  ///< Grey 0..255 without what is narrow.
  std::vector<std::uint8_t> dark;   ///< 1: darker than the paper there.
  double longestOther = 0.0;        ///< [px] The longest diagonal of a dark piece that is no mark.
  /// Whether something else may hide a mark within `reach` of a place: ink, or what is not the paper of `level`.
  bool isHidden(const Vec2& at, double reach, double level) const;
  double paperAt(const Vec2& at) const;
};

/// Empty when cancelled.
DotMarks findDotMarks(const Plane& grey, const RunContext&);

/// Whether marks that are alone lie all over the page, as seen in a few small parts of it. Fast.
bool hasMarksAllOver(const Plane& grey, const RunContext&);

}  // namespace batten
