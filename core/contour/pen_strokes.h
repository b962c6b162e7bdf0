// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A line drawn in the program with a mouse or a tablet ([004] section 3). Pressure is ignored. Image frame.
struct PenStroke {
  std::vector<Vec2> points;  ///< [px] as drawn, in order, at any spacing.
  bool closed = false;       ///< The last point is followed by the first.
  bool operator==(const PenStroke& other) const { return closed == other.closed && points == other.points; }
};

/// A stroke needs two different points (closed: three), all finite, and at most 100 000.
std::optional<Error> validate(const PenStroke&);

/// The stroke as a contour: straight between the drawn points, with about one point a pixel. `refined` is set at the
/// drawn points. Repeated points count once. @pre the stroke is valid.
Contour penContour(const PenStroke&);

/// A page by its corners (0, 0) and (width, height). [px]
struct PageExtent {
  double widthPx = 0.0, heightPx = 0.0;
};

/// Largest number of contour points of all pen strokes of a drawing together, and [px] of their length: a stroke has
/// about one point a pixel, and takes the time of it also where its points lie farther apart. That is a page full of
/// lines.
inline constexpr int kMostPenPoints = 1'000'000;

/// Largest number of pen strokes of a drawing, as of the lines of an imported file: each becomes a curve, which takes
/// about 0.2 ms and 12 kB where it is short and straight.
inline constexpr int kMostPenStrokes = 20'000;

/// Appends the strokes to the lines of `set`, in the order drawn, one contour a stroke. A stroke that leaves the page
/// is cut to its longest part on the page. A stroke beside the page, and one that would exceed kMostPenPoints or
/// kMostPenStrokes, becomes a contour without points. The note of the report says which. @pre all strokes are valid.
/// @return NoCurve, with what to do, if no line is left.
Result<ContourSet> withPenStrokes(const ContourSet& set, std::span<const PenStroke> strokes, const PageExtent& page);

}  // namespace batten
