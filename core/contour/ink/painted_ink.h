// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/run_context.h"
#include "core/contour/edge_choices.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Whether a place lies within the course and its radius.
bool isUnder(const PaintedInk&, const Vec2& px);

/// Moves the ink that the user has painted to the kind that he wants it to be.
/// @param strokes, shapes the ink of a page by kind; they share no pixel.
/// @return the ink that was painted. Unfinished when cancelled.
BitImage applyPaint(std::span<const PaintedInk> painted, BitImage& strokes, BitImage& shapes, const RunContext&);

}  // namespace batten
