// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// A clamped knot vector repeats its first and last knot degree + 1 times.

/// Inserts u `times` times without changing the shape (Boehm). Multiplicity may not exceed the degree (degree + 1 at
/// ends).
Result<NurbsCurve> insertKnot(const NurbsCurve&, double u, int times);
/// The same shape with clamped ends over the same domain (a uniform, unclamped curve becomes one that CAD takes).
Result<NurbsCurve> clamped(const NurbsCurve&);
/// Cuts at u into two clamped curves. @pre u strictly inside the domain.
struct SplitCurve {
  NurbsCurve left, right;
};
Result<SplitCurve> split(const NurbsCurve&, double u);
/// Cuts at all places at once, in ascending order: one curve more than there are places. About linear time.
Result<std::vector<NurbsCurve>> splitAtAll(const NurbsCurve&, std::span<const double> places);
/// Joins clamped curves of one degree end to start into one B-spline; at every joint a knot of multiplicity = degree
/// (C0, exact), the joint's control point once. Ends may differ by at most `tolerance` (the mean is taken).
Result<NurbsCurve> joinAtCorners(std::span<const NurbsCurve> pieces, double tolerance);
/// A knot of a knot vector: the index of the last of its run, and how often it is repeated.
struct KnotRun {
  int last = 0, multiplicity = 0;
};
/// Takes one knot of a run out of a curve without weights that does not need it (Piegl & Tiller, The NURBS Book, A5.8
/// without its test).
void removeExactKnot(int degree, std::vector<double>& knots, std::vector<Vec2>& points, KnotRun run);
/// Raises the degree by one or more without changing the shape.
Result<NurbsCurve> elevated(const NurbsCurve&, int degree);
/// The curve run through backwards over the same domain.
NurbsCurve reversed(const NurbsCurve&);
/// Linear change of the parameter to the domain [start, end].
Result<NurbsCurve> reparametrized(const NurbsCurve&, double start, double end);
/// The Bezier pieces of a curve (degree + 1 control points each) with their domains.
struct BezierPiece {
  double start, end;
  std::vector<Vec2> controlPoints;
};
Result<std::vector<BezierPiece>> bezierPieces(const NurbsCurve&);

}  // namespace batten
