// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/polygon/control_polygon.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/construct/stations/piece_stations.h"
#include "core/curve/knot_operations.h"
#include "core/polyline/polyline_tools.h"
#include "core/polyline/thinning.h"

namespace batten {

namespace {

/// The stretch from corner to corner with as many points as a curve of the degree needs: the inner ones are taken twice
/// or more, the middle ones first. The curve is drawn to them as to any others, only harder, and stays within the
/// polygon's corners. The corners themselves are never doubled, as the curve would have no direction there; where
/// nothing lies between them it is a straight line, and the missing points are spread along it.
std::vector<Vec2> doubled(const std::vector<Vec2>& stretch, int needed) {
  const int inner = static_cast<int>(stretch.size()) - 2, missing = needed - static_cast<int>(stretch.size());
  std::vector<Vec2> result = {stretch.front()};
  for (int i = 1; i <= missing && inner == 0; ++i) {
    result.emplace_back(stretch.front() +
                        (stretch.back() - stretch.front()) * (static_cast<double>(i) / (missing + 1)));
  }
  const int more = inner > 0 ? missing % inner : 0, firstMore = (inner - more) / 2;
  for (int i = 0; i < inner; ++i) {
    const int times = 1 + missing / inner + (i >= firstMore && i < firstMore + more ? 1 : 0);
    result.insert(result.end(), times, stretch[i + 1]);
  }
  result.push_back(stretch.back());
  return result;
}

Result<NurbsCurve> scaledToLength(int degree, std::vector<double> knots, std::vector<Vec2> points, double length) {
  auto curve = NurbsCurve::make(degree, std::move(knots), std::move(points));
  if (!curve) return curve;
  return reparametrized(*curve, 0.0, length);
}

Result<NurbsCurve> periodicPolygon(const std::vector<Vec2>& points, int degree) {
  std::vector<Vec2> around = points;
  for (int i = 0; i < degree; ++i) around.push_back(points[i % points.size()]);
  std::vector<double> knots;
  knots.reserve(around.size() + std::max(degree, 0) + 1);
  for (int i = 0; i < std::ssize(around) + degree + 1; ++i) knots.push_back(i - degree);
  const double length = polylineLength(points, true);
  auto curve = scaledToLength(degree, std::move(knots), std::move(around), length);
  if (!curve) return curve;
  const Vec2 seam = curve->point(curve->start());
  return clampedWithEnds(*curve, seam, seam);
}

/// The control points of a piece after removal.
struct ThinnedPiece {
  std::vector<Vec2> points;  ///< No two neighbours at one place; closed: the first is not repeated.
  int before = 0;
};

ThinnedPiece thinnedPiece(const ConstructPiece& piece, const ConstructParams& params) {
  std::vector<Vec2> all;
  const auto take = [&](const Vec2& p) {
    if (p.allFinite() && (all.empty() || p != all.back())) all.push_back(p);
  };
  for (const PiecePoint& p : piece.points) {
    if (p.refined || !piece.isDrawn) take(p.at);
  }
  // A stroke that a corner cuts ends there, drawn or not.
  if (piece.isDrawn && !piece.closed && !piece.points.empty()) take(piece.points.back().at);
  ThinnedPiece result;
  result.before = static_cast<int>(all.size());
  const std::vector<int> kept = params.removal == PointRemoval::Step
                                    ? thinnedByStep(all, {}, params.removalStepPx)
                                    : thinnedByTolerance(all, {}, params.removalTolerancePx);
  for (const int i : kept) result.points.push_back(all[i]);
  if (piece.closed && result.points.size() > 1 && result.points.front() == result.points.back()) {
    result.points.pop_back();
  }
  return result;
}

}  // namespace

std::vector<double> sharpKnotVector(int order, int controlPointCount, std::span<const int> sharp, SharpKnots kind) {
  std::vector<double> knots;
  const int total = controlPointCount + order;
  if (kind == SharpKnots::Uniform) {
    for (int i = 0; i < total; ++i) knots.push_back(i);
    return knots;
  }
  knots.assign(order, 0.0);
  double value = 1.0;
  // The knot of 1-based index i belongs to the sharp point i (as printed) or i - 1 (a corner without a gap).
  const int shift = kind == SharpKnots::Order ? 1 : 2;
  const int times = kind == SharpKnots::Order ? order : order - 1;
  while (static_cast<int>(knots.size()) < controlPointCount) {
    const int index = static_cast<int>(knots.size()) + 1;
    const bool isSharp = std::find(sharp.begin(), sharp.end(), index - shift) != sharp.end();
    const int room = controlPointCount - static_cast<int>(knots.size());
    knots.insert(knots.end(), isSharp ? std::min(times, room) : 1, value);
    value += 1.0;
  }
  knots.insert(knots.end(), order, value);
  return knots;
}

SharpPolygon withEnoughPoints(std::span<const Vec2> points, std::span<const int> sharp, int degree) {
  SharpPolygon result;
  if (points.empty()) return result;
  const std::vector<int> keep = pointsThatStay(static_cast<int>(std::ssize(points)), sharp);
  result.points = {points.front()};
  for (std::size_t k = 0; k + 1 < keep.size(); ++k) {
    std::vector<Vec2> stretch(points.begin() + keep[k], points.begin() + keep[k + 1] + 1);
    if (static_cast<int>(stretch.size()) < degree + 1) {
      result.added += degree + 1 - static_cast<int>(stretch.size());
      stretch = doubled(stretch, degree + 1);
    }
    result.points.insert(result.points.end(), stretch.begin() + 1, stretch.end());
    if (k + 2 < keep.size()) result.sharp.push_back(static_cast<int>(result.points.size()) - 1);
  }
  return result;
}

Result<PolygonCurve> controlPolygonCurve(std::span<const Vec2> points, std::span<const int> sharp, int degree,
                                         SharpKnots kind) {
  const double length = polylineLength(points, false);
  if (!(length > 0.0) || !std::isfinite(length) || degree < 1 || degree > 5) {
    return fail(ErrorCode::Numerical, "A control polygon needs at least two distinct points.");
  }
  // As printed and uniform: no points are added between corners, only as many as any curve of the degree needs.
  const bool spread = kind == SharpKnots::Degree;
  SharpPolygon polygon = withEnoughPoints(points, spread ? sharp : std::span<const int>{}, degree);
  if (!spread) polygon.sharp.assign(sharp.begin(), sharp.end());
  PolygonCurve result;
  result.knots = sharpKnotVector(degree + 1, static_cast<int>(polygon.points.size()), polygon.sharp, kind);
  result.points = polygon.points;
  result.sharp = polygon.sharp;
  result.added = polygon.added;
  auto curve = scaledToLength(degree, result.knots, std::move(polygon.points), length);
  if (!curve) return fail(curve.error());
  result.curve = std::move(*curve);
  if (kind == SharpKnots::Order && !sharp.empty()) {
    result.warning = "Knots of multiplicity = order break the curve just before each sharp point.";
  } else if (polygon.added > 0) {
    result.warning = "Between close sharp points " +
                     counted(polygon.added, "control point was doubled.", "control points were doubled.");
  }
  return result;
}

LinePolygon linePolygon(const ConstructContour& contour, const ConstructParams& params) {
  LinePolygon line;
  if (contour.pieces.empty()) return line;
  const ConstructPiece& first = contour.pieces.front();
  const ConstructPiece& last = contour.pieces.back();
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    ThinnedPiece piece = thinnedPiece(contour.pieces[i], params);
    if (piece.points.empty()) continue;
    line.before += piece.before;
    const bool meets = !line.points.empty() && line.points.back() == piece.points.front();
    if (meets) --line.before;
    if (!line.points.empty()) line.sharp.push_back(static_cast<int>(line.points.size()) - (meets ? 1 : 0));
    line.points.insert(line.points.end(), piece.points.begin() + (meets ? 1 : 0), piece.points.end());
  }
  line.closed = first.closed;
  const bool ringOfPieces = !first.closed && first.startIsCorner && last.endIsCorner && line.points.size() > 2 &&
                            line.points.front() == line.points.back();
  if (ringOfPieces) {
    line.closed = true;
    line.points.pop_back();
    --line.before;
    line.sharp.insert(line.sharp.begin(), 0);
  }
  return line;
}

Result<PolygonCurve> polygonCurve(const LinePolygon& line, int degree, SharpKnots kind) {
  if (!line.closed) return controlPolygonCurve(line.points, line.sharp, degree, kind);
  if (kind != SharpKnots::Uniform && !line.sharp.empty()) {
    const int shift = line.sharp.front();
    std::vector<Vec2> points = line.points;
    std::rotate(points.begin(), points.begin() + shift, points.end());
    points.push_back(points.front());
    std::vector<int> inner;
    for (std::size_t i = 1; i < line.sharp.size(); ++i) inner.push_back(line.sharp[i] - shift);
    return controlPolygonCurve(points, inner, degree, kind);
  }
  if (line.points.size() < 3 || degree < 1 || degree > 5) {
    return fail(ErrorCode::Numerical, "A closed control polygon needs at least three points.");
  }
  auto curve = periodicPolygon(line.points, degree);
  if (!curve) return fail(curve.error());
  PolygonCurve result;
  result.curve = std::move(*curve);
  result.points = line.points;
  for (std::size_t i = 0; i <= line.points.size(); ++i) result.knots.push_back(static_cast<double>(i));
  return result;
}

Result<ConstructedPiece> constructControlPolygon(const ConstructPiece& piece, const ConstructParams& params,
                                                 const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  ThinnedPiece thinned = thinnedPiece(piece, params);
  std::vector<Vec2>& points = thinned.points;
  ConstructedPiece result;
  PolygonNote& note = result.report.polygon.emplace();
  note.before = thinned.before;
  note.after = static_cast<int>(points.size());
  if (piece.closed && points.size() >= 3) {
    auto curve = periodicPolygon(points, params.degree);
    if (!curve) return fail(curve.error());
    result.curve = std::move(*curve);
  } else {
    const bool breaks = params.knots == SharpKnots::Order && piece.endIsCorner && points.size() > 2;
    if (breaks) points.pop_back();
    const bool isFree = params.knots == SharpKnots::Uniform;
    auto made = controlPolygonCurve(points, {}, params.degree, isFree ? SharpKnots::Uniform : SharpKnots::Degree);
    if (!made || piece.closed) return straightPiece(piece, "Too few points for a control polygon.");
    auto curve = isFree ? clamped(made->curve) : Result<NurbsCurve>(std::move(made->curve));
    if (!curve) return fail(curve.error());
    result.curve = std::move(*curve);
    note.added = made->added;
    if (made->added > 0) {
      result.report.note = "Too few points for this degree: " + counted(made->added, "was doubled.", "were doubled.");
    }
    if (isFree) result.report.note = "Uniform knots: the curve ends short of the ends of its line.";
    if (breaks) result.report.note = "Multiplicity = order: the curve is broken just before its last corner.";
  }
  result.report.why = Termination::Exact;
  return result;
}

}  // namespace batten
