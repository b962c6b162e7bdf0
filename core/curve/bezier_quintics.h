// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Bezier points of one quintic piece.
using Quintic = std::array<Vec2, 6>;

/// Place and derivatives at parameter t in 0..1, by de Casteljau.
struct QuinticPoint {
  Vec2 point, first, second;

  double curvature() const {
    const double speed = first.norm();
    return cross(first, second) / (speed * speed * speed);
  }
};
QuinticPoint evaluate(const Quintic& q, double t);

/// A piece of lower degree as a quintic, the same shape (001 section 5). Its ends are exactly those given.
/// @pre 2 to 6 Bezier points
Quintic elevatedToQuintic(std::span<const Vec2> points);
Quintic elevatedLine(const Vec2& q0, const Vec2& q1);
Quintic elevatedQuadratic(const Vec2& q0, const Vec2& q1, const Vec2& q2);
Quintic elevatedCubic(const Vec2& q0, const Vec2& q1, const Vec2& q2, const Vec2& q3);

/// Curvature at the ends (001 Eq 9, 10), positive to the left: 4/5 of the distance of the third point from the end
/// tangent over the square of the end edge. Absent where the end edge has no length.
std::optional<double> startCurvature(const Quintic& q);
std::optional<double> endCurvature(const Quintic& q);
/// Moves Q2 (Q3) along the normal so that the curvature at the start (end) is the given one. Position and tangent stay.
void setStartCurvature(Quintic& q, double curvature);
void setEndCurvature(Quintic& q, double curvature);
/// Gives both sides of a joint the mean of their curvatures. @return that mean; absent (and nothing changed) where an
/// edge has no length.
std::optional<double> equaliseJoint(Quintic& before, Quintic& after);

/// A place, a direction and a curvature: what two pieces with G2 contact share.
struct Joint {
  Vec2 point = Vec2::Zero();
  Vec2 tangent = Vec2::UnitX();  ///< Unit.
  double kappa = 0.0;            ///< [1/mm]
};
/// The quintic from joint to joint whose first derivative has the given length at both ends and whose second derivative
/// is kappa length^2 along the normal: over a knot interval of this length two such pieces meet with C2.
Quintic quinticHermite(const Joint& from, const Joint& to, double length);

/// Where the tangents at two points meet (001 section 4), if that is a vertex of a good quadratic: .05 to .95 of the
/// chord from both ends and an angle above .25 degrees.
std::optional<Vec2> tangentVertex(const Vec2& p, const Vec2& direction, const Vec2& q, const Vec2& directionAtQ);

/// The chain of Hermite quintics through the joints as one B-spline of degree 5: knots of multiplicity 3 at the
/// lengths, C2 everywhere. @param lengths one per piece. Closed: the last joint must repeat the first.
Result<NurbsCurve> hermiteChain(std::span<const Joint> joints, std::span<const double> lengths);

/// Quintics end to start with a common direction at every joint, as one B-spline: intervals such that the first
/// derivatives agree, so that a joint needs a knot of multiplicity 4 and no control point of its own. The curve is as
/// continuous as the quintics are (G2 stays G2). @param speed length of the first derivative at the start.
Result<NurbsCurve> joinedQuintics(std::span<const Quintic> path, double speed);

}  // namespace batten
