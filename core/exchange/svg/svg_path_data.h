// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// A part of a path: what lies between two moves.
struct SvgSubpath {
  std::vector<NurbsCurve> segments;  ///< Lines (degree 1), cubics, arcs (rational quadratics), in order of travel.
  bool closed = false;
};
/// The path data of SVG 1.1, section 8.3, in its own units, y down. Nothing if it has an error; what comes before the
/// error is omitted, as its meaning is undefined.
std::optional<std::vector<SvgSubpath>> readSvgPath(std::string_view data);

/// An arc of an ellipse from `from` to `to` (SVG 1.1, appendix F.6). Nothing if it has no length.
struct SvgArc {
  Vec2 from, to, radii;
  double turnedRad = 0.0;                     ///< Of the ellipse's first axis.
  bool isLarge = false, isClockwise = false;  ///< As seen on the page, y down.
};
std::optional<NurbsCurve> svgArc(const SvgArc&);

/// A number at the begin of the text, blanks and a comma before it passed over; nothing if there is none.
std::optional<double> takeSvgNumber(std::string_view& text);

}  // namespace batten
