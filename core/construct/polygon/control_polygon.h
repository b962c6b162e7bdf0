// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Knot vector of order k for N control points with sharp points at the given indices (0-based, increasing).
/// Order: 004 section 4.3 with its base mended: k zeros; then, for 1-based i = k+1..N, a sharp i has the next value k
/// times (and i moves on by k), any other once; k times the last. Degree: the value k - 1 times right behind a sharp
/// point. Uniform: 0, 1, 2, ... @pre Degree: for 1-based sharp indices p: k <= p <= N - k + 1, at least k - 1 apart.
std::vector<double> sharpKnotVector(int order, int controlPointCount, std::span<const int> sharp, SharpKnots kind);

/// A control polygon made ready for knots of multiplicity = degree.
struct SharpPolygon {
  std::vector<Vec2> points;
  std::vector<int> sharp;  ///< Indices of the inner sharp points in `points`.
  int added = 0;           ///< Control points doubled between sharp points that were too close.
};
/// Between two sharp points (or a sharp point and an end) lie at least degree + 1 control points, both included; where
/// there are fewer, inner ones are doubled as often as points are missing (004 section 4.3; algorithms: knot vector).
/// Sharp points with nothing between them are joined by a straight line, with points spread evenly along it.
SharpPolygon withEnoughPoints(std::span<const Vec2> points, std::span<const int> sharp, int degree);

struct PolygonCurve {
  NurbsCurve curve;           ///< Domain: length of the polygon.
  std::vector<double> knots;  ///< The knot vector as sharpKnotVector made it, in whole numbers.
  std::vector<Vec2> points;   ///< The control points that belong to it, with those that were added.
  std::vector<int> sharp;     ///< Indices of the inner sharp points in `points`.
  int added = 0;              ///< Control points doubled between sharp points that were too close.
  std::string warning;        ///< One line for the user, or empty.
};
/// B-spline of the control polygon; clamped but for Uniform. @param sharp 0-based, increasing; the ends need no
/// mention.
/// @return Numerical with fewer than two distinct points.
Result<PolygonCurve> controlPolygonCurve(std::span<const Vec2> points, std::span<const int> sharp, int degree,
                                         SharpKnots kind);

/// The control polygon of a whole line of the drawing: the points of all its pieces after removal, every corner once.
struct LinePolygon {
  std::vector<Vec2> points;  ///< Closed: the first is not repeated.
  std::vector<int> sharp;    ///< Corners, increasing, without the ends of an open line.
  bool closed = false;
  int before = 0;  ///< Points of the line before removal.
};
/// @param contour pieces in order of travel. Those that do not meet their neighbour (one in between is missing) are
/// joined all the same.
LinePolygon linePolygon(const ConstructContour& contour, const ConstructParams& params);
/// The line as one B-spline. A closed line with corners starts and ends at its first corner; without, or with Uniform,
/// it is periodic (`knots` then are 0, 1, 2, …, one period).
Result<PolygonCurve> polygonCurve(const LinePolygon&, int degree, SharpKnots kind);

/// The construction of 004 for one piece: its points (of a pen stroke: those that were drawn), thinned as the
/// parameters say, are the control polygon. Closed pieces give a periodic curve. Degree params.degree. Knots of
/// multiplicity = degree at the corners are what the pieces give when they are joined; with Order a piece ends one
/// point before its last corner, and the curve is broken there.
Result<ConstructedPiece> constructControlPolygon(const ConstructPiece&, const ConstructParams&, const RunContext&);

}  // namespace batten
