// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/pixel_frame.h"

#include <utility>

namespace batten {
namespace {

/// The end of a curve in mm: the place of the piece that it is, if it is one.
Vec2 endInMillimetres(const Vec2& end, const ConstructPiece& px, const ConstructPiece& mm, bool last, double pixelMm) {
  const auto of = [last](const auto& places) -> const auto& { return last ? places.back() : places.front(); };
  if (!px.points.empty() && end == of(px.points).at) return of(mm.points).at;
  if (!px.stations.empty() && end == of(px.stations).point) return of(mm.stations).point;
  return end * pixelMm;
}

void toMillimetres(ConstructReport& report, double pixelMm) {
  for (ExtremumNote& note : report.extrema) {
    note.s *= pixelMm;
    note.kappa /= pixelMm;
    note.point *= pixelMm;
  }
  for (NoiseNote& note : report.noise) note = {note.s * pixelMm, note.sigma / pixelMm};
  for (SegmentNote& note : report.segments) {
    note.start *= pixelMm;
    note.length *= pixelMm;
    note.startKappa /= pixelMm;
    note.endKappa /= pixelMm;
  }
}

}  // namespace

ConstructContour inPixels(const ConstructContour& mm) {
  ConstructContour px = mm;
  px.pixelMm = 1.0;
  for (ConstructPiece& piece : px.pieces) {
    for (PiecePoint& p : piece.points) p.at /= mm.pixelMm;
    for (Station& station : piece.stations) {
      for (Vec2* p : {&station.point, &station.from, &station.to}) *p /= mm.pixelMm;
    }
    for (Vec2& p : piece.breakpoints) p /= mm.pixelMm;
    for (ExtremumConstraint& constraint : piece.constraints) constraint.point /= mm.pixelMm;
  }
  return px;
}

Result<ConstructedPiece> inMillimetres(ConstructedPiece made, const ConstructPiece& px, const ConstructPiece& mm,
                                       double pixelMm) {
  std::vector<double> knots(made.curve.knots().begin(), made.curve.knots().end());
  std::vector<Vec2> points(made.curve.controlPoints().begin(), made.curve.controlPoints().end());
  const Vec2 start = points.front(), end = points.back();
  for (double& k : knots) k *= pixelMm;
  for (Vec2& p : points) p *= pixelMm;
  points.front() = endInMillimetres(start, px, mm, false, pixelMm);
  points.back() = endInMillimetres(end, px, mm, true, pixelMm);
  if (start == end) points.back() = points.front();
  auto curve = NurbsCurve::make(made.curve.degree(), std::move(knots), std::move(points));
  if (!curve) return fail(curve.error());
  made.curve = std::move(*curve);
  toMillimetres(made.report, pixelMm);
  return made;
}

}  // namespace batten
