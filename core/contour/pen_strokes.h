// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A line drawn by hand in the program, with a mouse or a tablet (004 section 3); pressure plays no part. Image frame.
struct PenStroke {
  std::vector<Vec2> points;  ///< [px] as drawn, in order; at any distance from each other.
  bool closed = false;       ///< The last point is followed by the first.
  bool operator==(const PenStroke& other) const { return closed == other.closed && points == other.points; }
};

/// A stroke needs two points at different places (closed: three); all finite, at most 100 000.
std::optional<Error> validate(const PenStroke&);

/// The stroke as a line of the drawing. Straight between the drawn points, about one point a pixel as in every contour;
/// `refined` is set at the points that were drawn. Points drawn twice in a row count once. @pre the stroke is valid.
Contour penContour(const PenStroke&);

/// `set` with the strokes behind its own lines, in the order in which they were drawn. @pre all strokes are valid.
ContourSet withPenStrokes(const ContourSet& set, std::span<const PenStroke> strokes);

}  // namespace batten
