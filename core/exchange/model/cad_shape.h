// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

inline constexpr double kFullTurnRad = 2.0 * std::numbers::pi;  // a whole turn

/// What CAD files are made of: each alternative is an entity of DXF, IGES and STEP. Lengths in the unit of the file,
/// y up, angles counter-clockwise from x.
struct CadLine {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};
/// Run through counter-clockwise; a whole circle starts anywhere.
struct CadArc {
  Vec2 centre = Vec2::Zero();
  double radius = 1.0;    ///< > 0.
  double startRad = 0.0;  ///< Angle of the start.
  double sweepRad = 0.0;  ///< 0..2 pi; 2 pi: a circle.
};
/// Chords, or arcs where a vertex has a bulge: the tangent of a quarter of the angle of the arc to the next vertex,
/// positive for a turn to the left. A closed one goes on from its last vertex to its first.
struct CadVertex {
  Vec2 point = Vec2::Zero();
  double bulge = 0.0;
};
struct CadPolyline {
  std::vector<CadVertex> vertices;
  bool closed = false;
};
using CadShape = std::variant<CadLine, CadArc, CadPolyline, NurbsCurve>;

struct CadEntity {
  std::string name;   ///< UTF-8.
  std::string layer;  ///< UTF-8.
  CadShape shape;
};
struct CadDrawing {
  std::vector<CadEntity> entities;
  std::optional<double> mmPerUnit;  ///< Absent: the file does not say.
  int left = 0;                     ///< Entities of the file that are no curves of the plane and were left out.
};

/// Whether a sweep is that of a whole circle, but for rounding.
inline bool isCircle(const CadArc& arc) { return arc.sweepRad >= kFullTurnRad * (1.0 - 1e-9); }

inline Vec2 onCircle(const Vec2& centre, double radius, double angleRad) {
  return centre + radius * Vec2(std::cos(angleRad), std::sin(angleRad));
}

/// The place at a fraction 0..1 of the parameter of a shape: the angle of an arc, the domain of a curve, the count of
/// the vertices of a polyline.
Vec2 pointAt(const CadShape&, double fraction);
inline Vec2 pointAt(const CadArc& arc, double fraction) {
  return onCircle(arc.centre, arc.radius, arc.startRad + fraction * arc.sweepRad);
}

/// A line, arc or circle if the curve is one, whatever its degree and parameters: not farther off than 1e-10 of its
/// size, and never turning back. Absent for other curves.
std::optional<CadShape> simpleShape(const NurbsCurve&);

/// The shape as a curve; a polyline as a chain of lines, with arcs as rational quadratics. @pre not an empty polyline.
Result<NurbsCurve> curveOf(const CadShape&);

/// The lines and arcs of a polyline in its order and direction, arcs as rational quadratics; vertices that lie on the
/// one before are passed over, so there may be none.
Result<std::vector<NurbsCurve>> edgesOf(const CadPolyline&);

/// The part of a curve from one parameter to another that lies behind it; the whole curve where `to` is not behind
/// `from`. Ends nearer to those of the curve than `same` of its domain are those. Absent: the curve cannot be split.
std::optional<NurbsCurve> partBetween(const NurbsCurve&, double from, double to, double same);

/// Largest distance of two drawings' entities at 200 equal fractions of their parameters each, in mm; a place of an arc
/// is compared with the same place of the other, however far it was turned. CannotWrite if one drawing has other
/// entities than the other.
Result<double> largestDifference(const CadDrawing& written, const CadDrawing& readBack);

}  // namespace batten
