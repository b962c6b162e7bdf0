// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/construct/construct.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// What the knot vector does at a sharp point (004 section 4).
enum class SharpKnots {
  Degree,   ///< A knot of multiplicity = degree: the curve passes through the point with a corner (default).
  Order,    ///< Multiplicity = degree + 1, as in the paper: the curve is broken between the point and the one before.
  Uniform,  ///< Equal steps everywhere, ends included: the curve passes through no point (for comparison).
};

/// Knot vector of order k for N control points with sharp points at the given indices (0-based, increasing).
/// Order: 004 section 4.3 with its base mended: k zeros; then, for 1-based i = k+1..N, a sharp i has the next value k
/// times (and i moves on by k), any other once; k times the last. Degree: the value k - 1 times right behind a sharp
/// point. Uniform: 0, 1, 2, ... @pre Degree: for 1-based sharp indices p: k <= p <= N - k + 1, at least k - 1 apart.
std::vector<double> sharpKnotVector(int order, int controlPointCount, std::span<const int> sharp, SharpKnots kind);

/// A control polygon made ready for knots of multiplicity = degree.
struct SharpPolygon {
  std::vector<Vec2> points;
  std::vector<int> sharp;  ///< Indices of the inner sharp points in `points`.
  int added = 0;           ///< Control points added between sharp points that were too close.
};
/// Between two sharp points (or a sharp point and an end) lie at least degree + 1 control points, both included; where
/// there are fewer, the degree of the stretch is raised: the same shape with the points that were missing.
SharpPolygon withEnoughPoints(std::span<const Vec2> points, std::span<const int> sharp, int degree);

struct PolygonCurve {
  NurbsCurve curve;     ///< Domain: length of the polygon.
  std::string warning;  ///< One line for the user, or empty.
};
/// B-spline of the control polygon; clamped but for Uniform. @param sharp 0-based, increasing; the ends need no
/// mention.
/// @return Numerical with fewer than two distinct points.
Result<PolygonCurve> controlPolygonCurve(std::span<const Vec2> points, std::span<const int> sharp, int degree,
                                         SharpKnots kind);

/// Indices of the points to keep (004 section 3.1), first, last and sharp ones always. By arc length: points at least
/// `step` apart along the line, evenly between two points that must stay.
std::vector<int> thinnedByStep(std::span<const Vec2> points, std::span<const int> sharp, double step);
/// By tolerance: no removed point lies farther than `tolerance` from the chord that replaces it.
std::vector<int> thinnedByTolerance(std::span<const Vec2> points, std::span<const int> sharp, double tolerance);

/// The construction of 004 for one piece: its points, thinned to about 8 px, are the control polygon. Closed pieces
/// give a periodic curve. Degree params.degree.
Result<ConstructedPiece> constructControlPolygon(const ConstructPiece&, double pixelMm, const ConstructParams&,
                                                 const RunContext&);

}  // namespace batten
